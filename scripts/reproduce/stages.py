"""The stages of the reproduction. Each makes folders of results, and skips those that are finished."""

import dataclasses
import json
import pathlib
import shutil

from . import plan as plans
from . import tuning
from .tools import Tools, write_json

BOARD_S = 1.01
BOARD_TUNING_STRIDE = 2
BOARD_OPTIONS = ["--size", "346x260", "--time-zero", "first-event"]


@dataclasses.dataclass
class Run:
    plan: plans.Plan
    tools: Tools
    out: pathlib.Path
    board: pathlib.Path | None  # the real tag board's recording
    models: dict

    def recording(self, light, seed):
        return self.out / "flights" / plans.flight(self.plan, light, seed)[0] / "events.aedat4"

    def report(self, *names):
        return self.out.joinpath("reports", *names)

    def default(self, method):
        return plans.CONFIGS / f"{method}.json"

    def tuned(self, method, where="tuned"):
        return self.out / where / f"{method}-{where}.json"

    def methods_tuned(self):
        """All, unless the stage was interrupted or left out."""
        return [method for method in tuning.METHODS if self.tuned(method).exists()]

    def simulate(self, light, seeds):
        flights = [plans.flight(self.plan, light, seed) for seed in seeds]
        self.tools.run_all([(self.out / "flights" / name, "esi-sim", arguments) for name, arguments in flights])

    def evaluate_all(self, calls):
        self.tools.run_all([self.tools.evaluate(*call) for call in calls])


def tune(run):
    """Each method's grid on the tuning flights; the best cell becomes tuned/METHOD-tuned.json."""
    run.simulate("dim", run.plan.tuning)
    flights = [run.recording("dim", seed) for seed in run.plan.tuning]
    begin_s, end_s, fps = run.plan.tuning_part
    choose(run, tuning.METHODS, "tuned", flights, ["--start", begin_s, "--end", end_s, "--fps", fps], ())


def choose(run, methods, where, recordings, options, truths):
    """Each method's choice and log are written as soon as its own grid is done."""
    cells = {method: tuning.write_cells(run.out / "cells", method, run.plan.every_cell) for method in methods}
    parts = {method: tuning.parts_of(list(cells[method].values())) for method in methods}
    calls = {method: [run.tools.evaluate(run.report(where, method, f"part{i}"), recordings, part,
                                         tuning.options_of(method, options), truths)
                      for i, part in enumerate(parts[method])] for method in methods}
    for method, reports in run.tools.run_groups(calls):
        log = run.out / where / f"{method}.csv"
        tuning.write_log(log, reports, [path.parent.name for path in recordings])
        shutil.copyfile(cells[method][tuning.best_cell(log)], run.tuned(method, where))


def score(run):
    """Every method with its authors' defaults on the scoring flights."""
    run.simulate("dim", run.plan.scoring)
    judge_each(run, "score", "dim", run.plan.scoring, {method: run.default(method) for method in plans.METHODS},
               ["--fps", run.plan.scoring_fps])


def score_tuned(run):
    tuned = {f"{method}-tuned": run.tuned(method) for method in run.methods_tuned()}
    judge_each(run, "score", "dim", run.plan.scoring, tuned, ["--fps", run.plan.scoring_fps])


def judge_each(run, folder, light, seeds, methods, at_fps, at_frames=()):
    """A call for each flight and method, so that one that changes leaves the others' results. Methods that make their
    frames when intensity frames come have options of their own."""
    run.evaluate_all([(run.report(folder, f"seed{seed}-{label}"), [run.recording(light, seed)], [path],
                       at_frames if label.removesuffix("-tuned") in plans.AT_FRAMES else at_fps)
                      for label, path in methods.items() for seed in seeds])


def cost(run):
    """What the authors' defaults cost at 100 FPS, on a part of each scoring flight; few frames are judged."""
    begin_s, end_s = run.plan.cost_part
    part = ["--start", begin_s, "--end", end_s]
    judge_each(run, "cost", "dim", run.plan.scoring, {method: run.default(method) for method in plans.METHODS},
               [*part, "--stride", 10], part)


def dark(run):
    """ESI and what came after it at 2 lux, straight ahead, and what each block of its adaptive form brings."""
    run.simulate("dark", run.plan.dark)
    default = json.loads(run.default("esi-adaptive").read_text(encoding="utf-8"))
    methods = {method: run.default(method) for method in ("esi", "esi-flow")}
    methods |= {f"{method}-tuned": run.tuned(method) for method in ("esi", "esi-adaptive", "esi-flow")}
    for label, changes in plans.ABLATION.items():
        config = {"method": default["method"], "set": default["set"] | changes}
        methods[label] = write_json(run.out / "cells/ablation" / f"{label}.json", config)
    methods["esi-clamp-3"] = write_json(run.out / "cells/ablation/esi-clamp-3.json",
                                        {"method": "esi", "set": {"e_min": -3, "e_max": 3}})
    judge_each(run, "dark", "dark", run.plan.dark, methods, ["--fps", run.plan.dark_fps])


def board(run):
    """The real tag board: authors' defaults, tuned on the simulated flights, tuned on the board itself."""
    if run.board is None:
        return
    truth = write_json(run.out / "board_truth.json", {
        "phases": [{"name": "board", "start_s": 0.0, "end_s": BOARD_S}],
        "tags": {"family": "tag36h11", "ids": list(range(12))}})
    names = plans.WITHOUT_FRAMES
    choose(run, names, "tuned-on-board", [run.board], [*BOARD_OPTIONS, "--stride", BOARD_TUNING_STRIDE], [truth])
    defaults = [run.default(name) for name in plans.AT_FPS if name not in ("complementary", "edi-propagated")]
    methods = defaults + [run.tuned(name, where) for where in ("tuned", "tuned-on-board") for name in names]
    run.evaluate_all([(run.report("board", "methods"), [run.board], methods, BOARD_OPTIONS, [truth])])
    run.evaluate_all([(run.report("board", name), [run.board],
                       [network_config(run, name, f"{name}-10ms", {"window": "time", "window_us": 10000})],
                       BOARD_OPTIONS, [truth], [model]) for name, model in run.models.items()])


def network_config(run, name, label, settings):
    config = json.loads(run.default(name).read_text(encoding="utf-8"))
    config["set"] |= {"model": str(run.models[name])} | settings
    return write_json(run.out / "cells/networks" / f"{label}.json", config)


def networks(run):
    """The networks on parts of the scoring flights; each part begins earlier than it is judged."""
    calls = []
    for seed in run.plan.scoring:
        recording = run.recording("dim", seed)
        for begin_s, judged_s, end_s in run.plan.network_parts:
            truth = part_of_truth(recording.parent, judged_s, end_s)
            for name, model in run.models.items():
                config = network_config(run, name, name, {})
                output = run.report("networks", f"{name}-seed{seed}-{judged_s:g}s")
                calls.append((output, [recording], [config], ["--start", begin_s, "--end", end_s], [truth], [model]))
    run.evaluate_all(calls)


def part_of_truth(flight, begin_s, end_s):
    truth = json.loads((flight / "ground_truth.json").read_text(encoding="utf-8"))
    phase = next(phase for phase in truth["phases"] if phase["start_s"] <= begin_s < phase["end_s"])
    truth["phases"] = [{"name": phase["name"], "start_s": begin_s, "end_s": end_s}]
    return write_json(flight / f"ground_truth-{begin_s:g}s.json", truth)


ALL = {"tune": tune, "score": score, "score-tuned": score_tuned, "cost": cost, "dark": dark, "board": board,
       "networks": networks, "page": lambda run: None}
