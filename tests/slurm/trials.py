# SPDX-License-Identifier: BSD-3-Clause
"""Trials of a study on a real Slurm that is struck at random moments, by hand: POLHODE_BIN_DIR=… trials.py [TRIALS [SEED]].

In each trial the time limit of a minute strikes, one task is killed, one is requeued, and the daemon of a node is killed,
in every other trial with all that it has started, until Slurm counts the node as lost. The files must be those of one process: runs.csv, tables, figures, report.
A line for each trial says what struck. Exit status: 0 if all trials gave the same bytes, else 1.
"""
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "experiments"))

from cluster import Cluster, why_not  # noqa: E402
from programs import BIN, call  # noqa: E402
from shards_test import files  # noqa: E402

STUDY = ["--scenario", "free_symmetric_top", "--integrator", "rk4,explicit_midpoint", "--dt", "1e-5,2e-5", "--t-end", "30",
         "--vary", "body.0.angular_velocity.1=1:5:320", "--out", "out"]  # 1280 runs, 96 s of one core of an AMD EPYC
JOBS = "shards=3 time=1 warning=50 rounds=12"
STRIKES_WITHIN = 25  # s
PATIENCE = 900  # s


class Trial:
    def __init__(self, number, seed, folder):
        self.chance = random.Random(f"{seed} {number}")
        self.with_tasks = number % 2 == 1
        self.folder = folder
        self.struck = []
        (folder / "jobs").mkdir(parents=True)
        self.cluster = Cluster(folder / "cluster")

    def note(self, what):
        self.struck.append(f"{time.monotonic() - self.began:.1f} s {what}")

    def any_task(self):
        """A task that runs; None if all jobs end before there is one."""
        while self.cluster.jobs():
            if tasks := self.cluster.tasks():
                return self.chance.choice(tasks)
            time.sleep(0.1)
        return None

    def kill_a_task(self):
        if task := self.any_task():
            try:
                os.kill(task.process, signal.SIGKILL)
                self.note(f"task {task.job} killed")
            except ProcessLookupError:
                self.kill_a_task()

    def requeue_a_task(self):
        while task := self.any_task():
            if not self.cluster.call("scontrol", "requeue", task.job).stderr:
                return self.note(f"task {task.job} requeued")
            time.sleep(0.5)  # it has just ended

    def kill_a_daemon(self):
        if task := self.any_task():
            self.cluster.kill_node(task.node, self.with_tasks)
            if self.with_tasks:
                self.cluster.wait_for_loss(task.node)
            time.sleep(self.chance.uniform(0.5, 8))
            self.cluster.start_node(task.node)
            self.note(f"{task.node} lost and back" if self.with_tasks else f"daemon of {task.node} killed and back")

    def carry_out(self, whole):
        """Returns what is wrong; empty if nothing is."""
        done = subprocess.run([str(BIN / "energy_drift"), *STUDY, "--slurm", JOBS, "--submit"], cwd=self.folder / "jobs",
                              env=self.cluster.environment, capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            return done.stderr
        self.cluster.wait_for_task()
        self.began = time.monotonic()
        strikes = [(self.chance.uniform(0, STRIKES_WITHIN), strike)
                   for strike in (self.kill_a_task, self.requeue_a_task, self.kill_a_daemon)]
        for moment, strike in sorted(strikes, key=lambda pair: pair[0]):
            time.sleep(max(0.0, self.began + moment - time.monotonic()))
            strike()
        self.cluster.wait_for_jobs(PATIENCE)
        said = "".join(path.read_text(errors="replace") for path in sorted((self.folder / "jobs/out/slurm").glob("array-*.log")))
        self.note("end")
        warned = said.count("energy_drift: interrupted; ")
        self.struck.append(f"{warned} tasks warned before the time limit")
        merges = (self.folder / "jobs/out/slurm/merge.log").read_text(errors="replace")
        self.struck.append(f"{merges.count('runs are missing')} further rounds")
        found = {name: text for name, text in files(self.folder / "jobs/out").items() if not name.startswith("slurm/")}
        if sorted(found) != sorted(whole):
            return f"other files: {sorted(set(found) ^ set(whole))[:10]}\n{merges[-800:]}\n{said[-800:]}"
        if other := [name for name in whole if found[name] != whole[name]]:
            return f"other bytes: {other}"
        return "" if warned and len(self.struck) == 6 else "not everything struck; make the study longer"


def main(trials=20, seed=1):
    if reason := why_not():
        print(f"skipped, because no Slurm can be started here: {reason}")
        return 0
    good = 0
    with tempfile.TemporaryDirectory(prefix="polhode_trials_") as place:
        folder = pathlib.Path(place)
        (folder / "whole").mkdir()
        call("energy_drift", *STUDY, folder=folder / "whole")
        whole = files(folder / "whole/out")
        for number in range(1, trials + 1):
            trial = Trial(number, seed, folder / f"trial{number}")
            try:
                wrong = trial.carry_out(whole)
            except AssertionError as error:
                wrong = str(error)
            finally:
                trial.cluster.stop()
            good += not wrong
            print(f"trial {number} of {trials}, seed {seed}: {wrong or 'the same bytes'}; " + ", ".join(trial.struck), flush=True)
            if not wrong:
                shutil.rmtree(trial.folder)
    print(f"{good} of {trials} trials gave the bytes of one process")
    return 0 if good == trials else 1


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
