"""The page's tables, in Markdown, from the reports of esi-eval."""

import statistics

from . import plan as plans
from . import tuning
from .tools import rows_of

PHASES = ["straight", "turning", "landing", "total"]
# Dong et al. 2025: detected frames of 6200 and their share; FEDI made 124 frames
PAPER = {"esi": "5046 (81.39 %)", "accumulator": "2871 (46.31 %)", "complementary": "2693 (43.44 %)",
         "edi": "18 (14.52 % of 124)", "e2vid": "5495 (88.63 %)", "firenet": "5748 (92.71 %)"}
PAPER_PHASES = {"esi": (2626, 1252, 711, 4589), "edi": (51, 14, 8, 73), "accumulator": (444, 493, 154, 1091),
                "complementary": (2208, 706, 659, 3573)}
PAPER_COST = {"e2vid": "62 s took 428.79 s on an RTX 4070", "firenet": "62 s took 255.73 s on an RTX 4070",
              "esi": "a little slower than the plugin", "edi": "slower than ESI; 2 frames/s",
              "complementary": "slower than ESI"}


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|---" + "|---:" * (len(header) - 1) + "|"]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]) + "\n"


def percent(values):
    """Mean over the seeds, lowest and highest."""
    values = [100 * value for value in values]
    if not values:
        return "-"
    mean = f"{statistics.mean(values):.1f} %"
    return mean if len(values) == 1 else f"{mean} ({min(values):.1f}..{max(values):.1f})"


class Scores:
    """Rows of table.csv by method and phase, one for each seed."""

    def __init__(self, reports):
        self.rows = {}
        for report in reports:
            for row in rows_of(report):
                self.rows.setdefault((row["method"], row["phase"]), []).append(row)

    def rates(self, method, phase="total"):
        return [float(row["rate"]) for row in self.rows.get((method, phase), []) if row["rate"]]

    def sum(self, method, column, phase="total"):
        return sum(int(row[column]) for row in self.rows.get((method, phase), []))

    def false(self, method):
        return sum(self.sum(method, f"false_{kind}") for kind in ("foreign", "misplaced", "duplicate"))

    def corner_error(self, method):
        errors = [float(row["corner_error_median_px"]) for row in self.rows.get((method, "total"), [])
                  if row["corner_error_median_px"]]
        return f"{statistics.mean(errors):.2f}" if errors else "-"


def reports_of(run, folder, seeds, labels):
    folders = [run.report(folder, f"seed{seed}-{label}") for seed in seeds for label in labels]
    return [report for report in folders if (report / "run.json").exists()]


def scoring(run):
    labels = [*plans.METHODS, *(f"{method}-tuned" for method in tuning.METHODS)]
    return Scores(reports_of(run, "score", run.plan.scoring, labels))


def counts(run):
    scores = scoring(run)
    rows = []
    for method in plans.METHODS:
        tuned = method + "-tuned"
        rows.append([method, scores.sum(method, "detected"), scores.sum(method, "frames"),
                     percent(scores.rates(method)), percent(scores.rates(tuned)), scores.corner_error(method),
                     scores.corner_error(tuned), f"{scores.false(method)}, {scores.false(tuned)}",
                     PAPER.get(method, "-")])
    rows.append(["e2vid", *["no weights"] * 2, *["-"] * 5, PAPER["e2vid"]])
    header = ["method", "detected", "frames", "defaults", "tuned", "corner error, px", "tuned, px",
              "false tags, defaults and tuned", "paper"]
    return markdown(header, rows)


def phases(run):
    scores = scoring(run)
    rows = []
    for method in plans.METHODS:
        paper = PAPER_PHASES.get(method)
        for label in (method, method + "-tuned"):
            if not scores.rates(label):
                continue
            cells = [percent(scores.rates(label, phase)) for phase in PHASES]
            rows.append([label, *cells, ", ".join(map(str, paper)) if paper and label == method else "-"])
    return markdown(["method", *PHASES, "paper, detected frames: straight, turning, landing, total"], rows)


def cost_rows(reports):
    found = {}
    for report in reports:
        for row in rows_of(report, "cost.csv"):
            found.setdefault(row["method"], []).append(row)
    return found


def median(rows, column):
    return statistics.median(float(row[column]) for row in rows)


def costs(run):
    found = cost_rows(reports_of(run, "cost", run.plan.scoring, plans.METHODS))
    rows = []
    for method in plans.METHODS:
        own = found[method]
        frames = "one per intensity frame" if method in plans.AT_FRAMES else "100"
        rows.append([method, f"{median(own, 'mev_s'):.1f}", f"{median(own, 'reconstruction_ms_mean'):.2f}",
                     f"{median(own, 'times_real_time'):.1f}", f"{median(own, 'detection_ms_mean'):.1f}", frames,
                     PAPER_COST.get(method, "-")])
    for name, own in cost_rows(network_reports(run)).items():
        rows.append([name, f"{median(own, 'mev_s'):.3f}", f"{median(own, 'reconstruction_ms_mean'):.0f}",
                     f"{median(own, 'times_real_time'):.3f}", f"{median(own, 'detection_ms_mean'):.1f}", "100",
                     PAPER_COST.get(name, "-")])
    rows.append(["e2vid", "no weights", *["-"] * 4, PAPER_COST["e2vid"]])
    header = ["method", "Mev/s", "ms a frame, its events included", "times real time", "detection, ms a frame",
              "frames/s", "paper"]
    return markdown(header, rows)


def network_reports(run):
    return sorted(path.parent for path in run.report("networks").glob("*/run.json")) if run.models else []


def networks(run):
    """The networks beside the other methods on the same parts, those at their own frames."""
    reports = network_reports(run)
    if not reports:
        return "Not run here.\n"
    scores = Scores(reports)
    rows = []
    for name in run.models:
        cells = [percent(scores.rates(name, phase)) for phase in PHASES[:3]]
        all_rates = [rate for phase in PHASES[:3] for rate in scores.rates(name, phase)]
        rows.append([name, *cells, percent(all_rates), sum(scores.sum(name, "frames", phase) for phase in PHASES[:3])])
    parts = [(begin_s, end_s) for _, begin_s, end_s in run.plan.network_parts]
    for method in ("esi", "esi-tuned", "esi-adaptive", "esi-flow", "accumulator-tuned"):
        rows.append([method, *on_parts(run, method, parts)])
    return markdown(["method", *PHASES[:3], "all parts", "judged"], rows)


def on_parts(run, method, parts):
    rates, frames = [], 0
    for begin_s, end_s in parts:
        of_seeds = []
        for seed in run.plan.scoring:
            own = [int(row["detected"]) for row in rows_of(run.report("score", f"seed{seed}-{method}"), "frames.csv")
                   if row["method"] == method and begin_s <= int(row["t_us"]) * 1e-6 < end_s]
            of_seeds.append(sum(own) / len(own))
            frames += len(own)
        rates.append(of_seeds)
    return [*map(percent, rates), percent(sum(rates, [])), frames]


def dark(run):
    labels = ["esi", "esi-clamp-3", "esi-tuned", "esi-flow", "esi-flow-tuned", "esi-adaptive-tuned", *plans.ABLATION]
    scores = Scores(reports_of(run, "dark", run.plan.dark, labels))
    rows = [[label, percent(scores.rates(label, "straight")), scores.corner_error(label), scores.false(label)]
            for label in labels]
    return markdown(["method", "detected, straight phase", "corner error, px", "false tags"], rows)


def board(run):
    if run.board is None or not (run.report("board", "methods") / "run.json").exists():
        return "Not run here.\n"
    rows = []
    for report in (run.report("board", name) for name in ("methods", *run.models)):
        if not (report / "run.json").exists():
            continue
        scores, cost = Scores([report]), cost_rows([report])
        for label in cost:
            found, chances = scores.sum(label, "tags_found"), scores.sum(label, "tag_chances")
            rows.append([label, f"{found} of {chances}", f"{100 * found / chances:.1f} %", scores.false(label),
                         f"{median(cost[label], 'mev_s'):.2f}"])
    return markdown(["method", "tags", "rate", "false tags", "Mev/s, frames included"], rows)


def chosen(run, where="tuned"):
    rows = []
    for method in tuning.METHODS:
        log = run.out / where / f"{method}.csv"
        if log.exists():
            best = tuning.best_cell(log)
            cells = {row["cell"]: row for row in rows_of(log.parent, log.name)}
            plain = tuning.best_cell(log, "_filter-plain")
            rows.append([method, *(text for cell in (best, plain)
                                   for text in (f"`{cell}`", percent([tuned_rate(cells[cell], where)])))])
    return markdown(["method", "best cell", "its rate there", "best without filter", "its rate there"], rows)


def tuned_rate(row, where):
    """Of frames on the flights, of tags on the board."""
    return float(row["rate"]) if where == "tuned" else int(row["tags_found"]) / int(row["tag_chances"])
