"""Chooses each method's parameters on the tuning flights: the cell that detects the board most often."""

import csv
import itertools
import json
import pathlib

from .tools import rows_of, write_json

GRIDS = json.loads((pathlib.Path(__file__).parent / "tuning_grids.json").read_text(encoding="utf-8"))
METHODS = list(GRIDS["methods"])
CELLS_A_CALL = 8


def needs_frames(method):
    return GRIDS["methods"][method].get("needs_frames", False)


def cells_of(method, every=1):
    """Configs of a method's grid by their names; of every so many cells, which still varies all axes."""
    grid = GRIDS["methods"][method]
    axes = list(grid["axes"].items()) + [("filter", GRIDS["filters"])]
    cells = {}
    for choice in itertools.product(*(axis.items() for _, axis in axes)):
        label = "_".join(f"{name}-{value}" for (name, _), (value, _) in zip(axes, choice))
        settings = dict(grid.get("base", {}))
        for _, values in choice[:-1]:
            settings.update(values)
        config = {"method": grid["method"], "set": settings}
        (settings if grid.get("filters_are_its_own") else config).update(choice[-1][1])
        if grid.get("at_frames"):
            config["at_frames"] = True
        cells[label] = config
    return dict(itertools.islice(cells.items(), 0, None, every))


def write_cells(folder, method, every):
    return {label: write_json(folder / method / f"{label}.json", config)
            for label, config in cells_of(method, every).items()}


def parts_of(cells):
    """Cells of one call: a method keeps images and events, `edi` some 170 MB."""
    return [cells[i:i + CELLS_A_CALL] for i in range(0, len(cells), CELLS_A_CALL)]


def options_of(method, options):
    """A method that makes its frames when intensity frames come has no rate."""
    if not GRIDS["methods"][method].get("at_frames"):
        return options
    at = options.index("--fps")
    return options[:at] + options[at + 2:]


def best_cell(log, ending=""):
    """Of cells whose name ends so: most detected frames, then most tags (the other way round where truth has no corners and a frame many tags),
    then the smaller corner error."""
    def rank(row):
        found = int(row["detected"]), int(row["tags_found"])
        return found[::-1] if not row["corner_error_mean_px"] else found, -float(row["corner_error_mean_px"] or 0)

    return max((row for row in rows_of(log.parent, log.name) if row["cell"].endswith(ending)), key=rank)["cell"]


def write_log(path, reports, flights):
    """A line per cell: rate on each flight and on all, corner error, false tags."""
    cells = {}
    for row in (row for report in reports for row in rows_of(report) if row["phase"] == "total"):
        cells.setdefault(row["method"], {})[row["input"]] = row
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        columns = ["detected", "frames", "rate", "tags_found", "tag_chances", "corner_error_mean_px"]
        writer.writerow(["cell", *(f"rate_{name}" for name in flights), *columns, "false_tags"])
        for label, rows in cells.items():
            each = [row["rate"] for name, row in rows.items() if name != "all"]
            whole = rows.get("all") or next(iter(rows.values()))
            false = sum(int(whole[f"false_{kind}"]) for kind in ("foreign", "misplaced", "duplicate"))
            writer.writerow([label, *each, *(whole[column] for column in columns), false])
