"""Chooses each method's parameters on the tuning flights: the cell that detects the board most often."""

import csv
import itertools
import json
import pathlib

from .tools import rows_of, write_json

GRIDS = json.loads((pathlib.Path(__file__).parent / "tuning_grids.json").read_text(encoding="utf-8"))
METHODS = list(GRIDS["methods"])


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


def best_cell(report):
    """Of the pooled totals: most detected frames (or tags, where one frame has many), then smaller corner error."""
    totals = [row for row in rows_of(report) if row["phase"] == "total"]
    pooled = [row for row in totals if row["input"] == "all"] or totals

    def rank(row):
        found = int(row["detected"]), int(row["tags_found"])
        return found[::-1] if not row["corner_error_mean_px"] else found, -float(row["corner_error_mean_px"] or 0)

    return max(pooled, key=rank)["method"]


def write_log(path, report, flights):
    """A line per cell: rate on each flight and on all, corner error, false tags."""
    totals = [row for row in rows_of(report) if row["phase"] == "total"]
    cells = {}
    for row in totals:
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
