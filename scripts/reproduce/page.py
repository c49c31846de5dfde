"""Writes the page: our tables beside the paper's."""

import datetime
import os
import pathlib
import platform

from . import chart, tables
from .plan import AT_FPS

DISCUSSION = pathlib.Path(__file__).parent / "discussion.md"  # written by hand, about the full run that is committed


def write(run):
    plan = run.plan
    chart.write(run, run.out / "detection.svg")
    page = run.out / "README.md"
    text = f"""# The paper's tables, on simulated flights

Dong et al. 2025 (arXiv 2508.02238) judge reconstructions by the AprilTags that are found in them. This page does the
same with flights of our simulator, and sets its numbers beside the paper's. Made by `scripts/reproduce_paper{
" --quick" if plan.name == "quick" else ""} -o DIR` on {datetime.date.today()}.

{setting(plan)}

## Detection count and rate

Detected frames are those at the authors' defaults, of all flights together; rates are the mean over the flights, lowest
and highest in brackets. `edi` makes one image per intensity frame and is counted on its own frames.

{tables.counts(run)}
![Detection rates](detection.svg)

## Detection by phase

The paper's phases are not of our lengths, and it gives counts only; read down a column, not across.

{tables.phases(run)}
## Cost

{machine()}, one thread per tool. Times are CPU times of the reconstruction alone, at the authors' defaults and 100 FPS,
medians over the flights ({plan.cost_part[0]} to {plan.cost_part[1]} s of each; the networks over the parts below); 1 Mev/s is a million events a second. The paper's throughputs are not in the material we have.

{tables.costs(run)}
## Networks

{networks_text(plan)}

{tables.networks(run)}
## In the dark

2 lux, configs/sim/flight-dark.json, the first {plan.dark_s} s of a flight (all straight), seeds {listed(plan.dark)}, of which no method was
tuned on any; {plan.dark_fps} frames a second. Below `esi-adaptive`: its blocks, each taken away, replaced or added.
"-tuned" was tuned on the dim flights.

{tables.dark(run)}
## The real tag board

One second of a DAVIS346 before a board with 12 tags, 100 frames at 100 FPS: 1200 tags to be found. Networks with
windows of 10 ms. "-tuned" was tuned on the simulated flights. **"-tuned-on-board" was tuned on these very frames**, so
its rate is an upper bound and no result. `edi` and `complementary` need intensity frames, which it has not.

{tables.board(run)}
## Tuning

Every method got {-(-64 // plan.every_cell)} cells, the same flights (dim, {plan.tuning_s} s, seeds {listed(plan.tuning)}; of each {tuning_part(plan)}) and the same filters: none, a
median of 3x3, a Gaussian of 0.7 px, and that with background filter and polarity balance (scripts/reproduce/tuning_grids.json;
`esi-adaptive` has the balance in all of its cells, since that is what it is; `reference` changes nothing for `edi-propagated`,
half of whose cells are alike). The best cell detects most frames of both
flights; at a tie the one that finds most tags, then the one with the smaller mean corner error. The logs are {logs("tuned")}.

{tables.chosen(run)}
{board_tuning(run)}"""
    if plan.name == "full" and DISCUSSION.exists():
        text = text.replace("## Detection count", DISCUSSION.read_text(encoding="utf-8") + "\n## Detection count", 1)
    page.write_text(text, encoding="utf-8")
    return page


def setting(plan):
    options = " ".join(map(str, plan.options))
    return f"""Flights: configs/sim/flight-dim.json (10 lux on the scene), {plan.duration_s} s{", with " + options if options else ""}; \
`--seed` and `--scene-seed` {listed(plan.scoring)} for scoring, {listed(plan.tuning)} for tuning.
{plan.scoring_fps} frames a second are judged ({plan.scoring_fps * plan.duration_s - 1} a flight; the paper judges 100 a second, but those 10 ms apart are
alike), those of `edi` all. Detector: esi-eval's defaults (tag36h11,
ids 0 and 1, at most one corrected bit, `quad_decimate` 1), a corner error of at most 5 px. "Defaults" are configs/recon, with
the values of each method's authors, ESI's our own, since the paper gives none. Configs: {", ".join(f"`{name}`" for name in AT_FPS)}, `edi`."""


def networks_text(plan):
    parts = ", ".join(f"{begin:g} to {end:g} s" for _, begin, end in plan.network_parts) or "none in the quick run"
    return f"""With their authors' windows (0.35 events a pixel) and a frame every 10 ms that shows the last window's image. They are
slow, so they run on parts of the scoring flights only: {parts}; reconstruction begins a quarter of a second earlier.
"judged" is how many frames there are of each; a network that was stopped has fewer.
The other methods' rates are on the same parts, at {plan.scoring_fps} frames a second, and had the whole flight before."""


def board_tuning(run):
    if run.board is None:
        return ""
    return f"On the board itself (one frame of 2, tags found of 600), logs {logs('tuned-on-board')}:\n\n{tables.chosen(run, 'tuned-on-board')}"


def logs(where):
    return f"[{where}/]({where}/)"


def tuning_part(plan):
    begin_s, end_s, fps = plan.tuning_part
    return f"{begin_s} to {end_s} s, {fps} frames a second, {(end_s - begin_s) * fps - 1} frames; `edi` has one per intensity frame"


def listed(seeds):
    return ", ".join(map(str, seeds))


def machine():
    model = platform.machine()
    for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    return f"{model}, {os.cpu_count()} cores"
