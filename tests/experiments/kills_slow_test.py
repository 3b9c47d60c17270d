# SPDX-License-Identifier: BSD-3-Clause
"""Studies that are killed (SIGKILL) at random moments: the same command then makes the bytes of an undisturbed study, and
no run is lost or made twice. Slow, because each kind of study is killed 20 times.

    kills_slow_test.py [NAME OF A TEST]...      POLHODE_KILLS: kills of each kind, POLHODE_SEED: seed of the moments
"""
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
import unittest
from contextlib import closing

from programs import BIN, PATIENCE, call, stored, temporary_folder
from shards_test import files

KILLS = int(os.environ.get("POLHODE_KILLS", "20"))
SEED = os.environ.get("POLHODE_SEED", "1")
RUNS = ["--integrator", "rk4,explicit_midpoint", "--vary", "body.0.angular_velocity.1=1:5:4", "--jobs", "2"]


def made(folder, scratch):
    """The runs in the store of a folder whose program may be killed, with what tells one making of a run from another."""
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir()
    for path in folder.glob("results.sqlite*"):  # a copy: reading a store that was left behind would change it
        shutil.copy(path, scratch)
    if not (scratch / "results.sqlite").exists():
        return {}
    with closing(sqlite3.connect(scratch / "results.sqlite")) as store:
        try:
            rows = store.execute("SELECT id, wall_s FROM runs JOIN timings USING (number)").fetchall()
        except sqlite3.OperationalError:
            return {}  # its tables are not made yet
    assert len({row[0] for row in rows}) == len(rows), "a run is there twice"
    return dict(rows)


class Kills(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)
        for place in ("whole", "killed"):
            (self.folder / place).mkdir()
        self.out = self.folder / "killed/out"

    def start(self, program, study, place="killed"):
        process = subprocess.Popen([str(BIN / program), *study, "--out", "out"], cwd=self.folder / place,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for_runs(self, process, out, runs):
        end = time.monotonic() + PATIENCE
        while stored(out) < runs and process.poll() is None:
            self.assertLess(time.monotonic(), end, "the runs do not come to an end")
            time.sleep(0.002)

    def try_kills(self, program, study, after=0):
        """Kills the study KILLS times, at moments between its beginning, or the one at which `after` runs are stored, and
        its end."""
        chance = random.Random(f"{SEED} {self.id()}")
        process = self.start(program, study, "whole")
        self.wait_for_runs(process, self.folder / "whole/out", after)
        began = time.monotonic()
        self.assertEqual(process.wait(PATIENCE), 0)
        lasts = time.monotonic() - began
        whole = files(self.folder / "whole/out")
        runs = made(self.folder / "whole/out", self.folder / "scratch")
        self.assertGreater(len(runs), 0)
        kills = ended = half_way = 0
        while kills < KILLS:
            with self.subTest(kill=kills):
                process = self.start(program, study)
                self.wait_for_runs(process, self.out, after)
                time.sleep(chance.random() * lasts)
                process.kill()
                if process.wait(PATIENCE) == 0:
                    ended += 1
                    self.assertLess(ended, 10 * KILLS, "it is always done before it is killed")
                    shutil.rmtree(self.out)
                    continue
                kills += 1
                before = made(self.out, self.folder / "scratch")
                half_way += 0 < len(before) < len(runs)
                if chance.random() < 0.25 and kills < KILLS:
                    continue  # the next one is killed on what this one has left
                call(program, *study, "--out", "out", folder=self.folder / "killed")
                after_it = made(self.out, self.folder / "scratch")
                self.assertEqual(sorted(after_it), sorted(runs))
                self.assertEqual({run: after_it[run] for run in before}, before, "a run that was stored was made again")
                found = files(self.out)
                self.assertEqual(sorted(found), sorted(whole))
                self.assertEqual([name for name in whole if found[name] != whole[name]], [])
                shutil.rmtree(self.out)
        print(f"{self.id()}: {kills} kills, {half_way} with some runs stored, {ended} studies that had ended by themselves",
              file=sys.stderr)

    def test_trajectories_in_csv(self):
        self.try_kills("energy_drift", [*RUNS, "--dt", "2e-4", "--trajectory", "csv", "--no-figures"])

    def test_trajectories_in_hdf5(self):
        self.try_kills("energy_drift", [*RUNS, "--dt", "2e-4", "--trajectory", "hdf5", "--no-figures"])

    def test_references(self):
        self.try_kills("energy_drift", ["--scenario", "spring_box,two_bodies", "--integrator", "rk4,heun", "--dt", "1e-3,2e-3",
                                        "--t-end", "1", "--reference", "--no-figures"])

    def test_a_study_that_refines(self):
        self.try_kills("stability", ["--scenario", "oscillator", "--integrator", "rk4,velocity_verlet", "--dt", "0.2:4:5:log",
                                     "--t-end", "10", "--no-figures"])

    def test_figures_and_report(self):
        self.try_kills("energy_drift", ["--integrator", "rk4,explicit_midpoint", "--dt", "1e-2,2e-2", "--t-end", "2"], after=4)


if __name__ == "__main__":
    unittest.main()
