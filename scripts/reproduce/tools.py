"""Runs the tools, each result once: a folder with run.json and the same command beside it is finished."""

import concurrent.futures
import csv
import hashlib
import json
import pathlib
import subprocess
import sys
import time

DONE, DONE_WITH_LOSSES = 0, 3


class Tools:
    def __init__(self, folder, jobs):
        self.folder = folder
        self.jobs = jobs

    def run(self, output, tool, arguments, files=()):
        """One call of a tool that writes run.json last. files: those whose contents belong to the command."""
        digests = [hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest() for file in files]
        command = [tool, *map(str, arguments)]
        mark = output.with_name(output.name + ".command.json")
        now = {"command": command, "digests": digests}
        if (output / "run.json").exists() and mark.exists() and json.loads(mark.read_text()) == now:
            return output
        output.parent.mkdir(parents=True, exist_ok=True)
        mark.unlink(missing_ok=True)
        begin_s = time.monotonic()
        done = subprocess.run(
            [self.folder / tool, *command[1:], "--force", "--quiet", "-o", output],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode not in (DONE, DONE_WITH_LOSSES):
            sys.exit(f"reproduce_paper: {tool} for {output}: {done.stderr.strip()}")
        mark.write_text(json.dumps(now, indent=1) + "\n")
        print(f"{time.strftime('%H:%M:%S')} {output} in {time.monotonic() - begin_s:.0f} s", flush=True)
        return output

    def run_all(self, calls):
        """Calls of run(), as many at once as there are jobs; each tool has one thread."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            return [job.result() for job in [pool.submit(self.run, *call) for call in calls]]

    def run_groups(self, groups):
        """Calls by names, as in run_all(); each name and its outputs as soon as they are all there, in order."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            jobs = {name: [pool.submit(self.run, *call) for call in calls] for name, calls in groups.items()}
            for name, of_group in jobs.items():
                yield name, [job.result() for job in of_group]

    def evaluate(self, output, recordings, methods, options, truths=(), models=()):
        """The call of run() for esi-eval. truths: one per recording, where they aren't beside them."""
        given = [part for method in methods for part in ("--method", method)]
        given += [part for truth in truths for part in ("-g", truth)]
        files = [*methods, *truths, *models]
        return output, "esi-eval", [*recordings, *given, "--threads", 1, "--no-tracking", *options], files


def rows_of(report, table="table.csv"):
    with open(report / table, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write_json(path, value):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(value, indent=2) + "\n", encoding="utf-8")
    return path
