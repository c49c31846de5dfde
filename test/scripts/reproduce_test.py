#!/usr/bin/python3
"""Tests of scripts/reproduce: that tuning is fair, picks the best cell, and that finished work isn't done again."""

import json
import pathlib
import stat
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from reproduce import plan, stages, tables, tuning
from reproduce.tools import Tools

HEADER = "input,method,phase,detected,frames,rate,tags_found,tag_chances,corner_error_mean_px," \
         "false_foreign,false_misplaced,false_duplicate\n"
TOOL = """#!/bin/sh
for last; do :; done
mkdir -p "$last"; echo once >> "$last/calls"; echo '{}' > "$last/run.json"
"""

EVALUATION = """#!/usr/bin/python3
import pathlib, sys
arguments, output = sys.argv[1:], pathlib.Path(sys.argv[-1])
if "highpass" in str(output):
    sys.exit("fails")
output.mkdir(parents=True)
methods = [pathlib.Path(b).stem for a, b in zip(arguments, arguments[1:]) if a == "--method"]
rows = [f"f,{name},total,{i},9,0.{i},{i},9,1,0,0,0" for i, name in enumerate(methods)]
(output / "table.csv").write_text("%s" + "\\n".join(rows) + "\\n")
(output / "run.json").write_text("{}")
""" % HEADER.replace("\n", "\\n")


class Grids(unittest.TestCase):
    def test_every_method_has_64_different_cells(self):
        for method in tuning.METHODS:
            cells = tuning.cells_of(method)
            self.assertEqual(len(cells), 64, method)
            self.assertEqual(len({json.dumps(cell, sort_keys=True) for cell in cells.values()}), 64, method)

    def test_every_method_is_offered_the_same_filters(self):
        for method in tuning.METHODS:
            cells = tuning.cells_of(method).values()
            own = tuning.GRIDS["methods"][method].get("filters_are_its_own", False)
            for filters in tuning.GRIDS["filters"].values():
                using = [cell for cell in cells if filters.items() <= (cell["set"] if own else cell).items()]
                self.assertGreaterEqual(len(using), 16, method)

    def test_few_cells_still_vary_every_axis(self):
        for method in tuning.METHODS:
            cells = [label.split("_filter-") for label in tuning.cells_of(method, plan.QUICK.every_cell)]
            self.assertEqual(len(cells), 8)
            self.assertEqual(len({filters for _, filters in cells}), 4, method)
            self.assertGreaterEqual(len({rest for rest, _ in cells}), 6, method)

    def test_scoring_and_tuning_share_no_seed(self):
        for each in (plan.FULL, plan.QUICK):
            self.assertFalse(set(each.tuning) & (set(each.scoring) | set(each.dark)))
        self.assertGreaterEqual(len(plan.FULL.scoring), 3)


class Reports(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def report(self, *rows, name="report"):
        (self.path / name).mkdir()
        (self.path / name / "table.csv").write_text(HEADER + "".join(row + "\n" for row in rows))
        return self.path / name

    def best_of(self, *reports, flights=("f",)):
        tuning.write_log(self.path / "log.csv", reports, flights)
        return tuning.best_cell(self.path / "log.csv")

    def test_best_cell_is_that_of_all_flights(self):
        report = self.report("f1,a,total,9,10,0.9,9,10,1,0,0,0", "f2,a,total,1,10,0.1,1,10,1,0,0,0",
                             "f1,b,total,6,10,0.6,6,10,1,0,0,0", "f2,b,total,6,10,0.6,6,10,1,0,0,0",
                             "all,a,total,10,20,0.5,10,20,1,0,0,0", "all,b,total,12,20,0.6,12,20,1,0,0,0",
                             "all,a,landing,20,20,1,20,20,1,0,0,0")
        self.assertEqual(self.best_of(report, flights=("f1", "f2")), "b")

    def test_a_tie_goes_to_the_smaller_corner_error(self):
        report = self.report("f,a,total,9,10,0.9,9,10,1.5,0,0,0", "f,b,total,9,10,0.9,9,10,0.5,0,0,0",
                             "f,c,total,9,10,0.9,9,10,0.7,0,0,0")
        self.assertEqual(self.best_of(report), "b")

    def test_without_corners_tags_count_before_frames(self):
        report = self.report("f,a,total,9,10,0.9,20,120,,0,0,0", "f,b,total,8,10,0.8,30,120,,0,0,0")
        self.assertEqual(self.best_of(report), "b")

    def test_the_best_cell_may_be_of_any_call_of_the_grid(self):
        parts = [self.report(f"f,{cell},total,{count},10,0.{count},9,10,1,0,0,0", name=cell)
                 for cell, count in (("a", 3), ("b", 7), ("c", 5))]
        self.assertEqual(self.best_of(*parts), "b")
        self.assertEqual([part for whole in (tuning.parts_of(list(range(20))),) for part in whole],
                         [list(range(8)), list(range(8, 16)), list(range(16, 20))])

    def test_methods_at_intensity_frames_get_no_rate(self):
        options = ["--start", 0, "--fps", 7, "--end", 9]
        self.assertEqual(tuning.options_of("edi", options), ["--start", 0, "--end", 9])
        self.assertEqual(tuning.options_of("esi", options), options)

    def test_the_log_has_a_rate_for_each_flight(self):
        report = self.report("f1,a,total,9,10,0.9,9,10,1,0,0,0", "f2,a,total,1,10,0.1,1,10,1,0,0,0",
                             "all,a,total,10,20,0.5,10,20,1,1,2,3")
        tuning.write_log(self.path / "log.csv", [report], ["f1", "f2"])
        lines = (self.path / "log.csv").read_text().splitlines()
        self.assertTrue(lines[0].startswith("cell,rate_f1,rate_f2,"))
        self.assertEqual(lines[1], "a,0.9,0.1,10,20,0.5,10,20,1,6")

    def test_rates_are_shown_with_their_spread(self):
        self.assertEqual(tables.percent([0.5, 0.7]), "60.0 % (50.0..70.0)")
        self.assertEqual(tables.percent([0.5]), "50.0 %")
        self.assertEqual(tables.percent([]), "-")

    def test_what_was_chosen_before_a_failure_is_kept(self):
        tool = self.path / "esi-eval"
        tool.write_text(EVALUATION)
        tool.chmod(tool.stat().st_mode | stat.S_IXUSR)
        run = stages.Run(plan.QUICK, Tools(self.path, 1), self.path, None, {})
        with self.assertRaises(SystemExit):
            stages.choose(run, ["esi", "edi", "highpass", "accumulator"], "tuned", [self.path / "f/events"],
                          ["--fps", 7], ())
        last = list(tuning.cells_of("esi", plan.QUICK.every_cell).values())[-1]
        self.assertEqual(json.loads(run.tuned("esi").read_text()), last)
        self.assertEqual(run.methods_tuned(), ["esi", "edi"])
        commands = {method: run.report("tuned", method, "part0.command.json").read_text() for method in ("esi", "edi")}
        self.assertIn("--fps", commands["esi"])
        self.assertNotIn("--fps", commands["edi"])

    def test_finished_work_is_not_done_again_unless_the_command_changed(self):
        tool = self.path / "tool"
        tool.write_text(TOOL)
        tool.chmod(tool.stat().st_mode | stat.S_IXUSR)
        method = self.path / "method.json"
        method.write_text("{}")
        tools, output = Tools(self.path, 1), self.path / "out"
        calls = [["x"], ["x"], ["y"]]
        for arguments in calls:
            tools.run(output, "tool", arguments, [method])
        self.assertEqual((output / "calls").read_text().count("once"), 2)
        method.write_text('{"other": 1}')
        tools.run(output, "tool", ["y"], [method])
        self.assertEqual((output / "calls").read_text().count("once"), 3)
        (output / "run.json").unlink()
        tools.run(output, "tool", ["y"], [method])
        self.assertEqual((output / "calls").read_text().count("once"), 4)


if __name__ == "__main__":
    unittest.main()
