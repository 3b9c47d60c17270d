# SPDX-License-Identifier: BSD-3-Clause
"""Studies in shards: every run once, whatever is killed or done twice, and the files of a study in one process."""
import signal
import subprocess
import time
import unittest

from programs import BIN, PATIENCE, call, stored, temporary_folder

STUDY = ["--integrator", "rk4,dmv,cvode_adams", "--dt", "1e-3,2e-3", "--tolerance", "1e-6", "--vary",
         "body.0.angular_velocity.1=1:5:12", "--t-end", "1", "--no-figures"]  # 60 runs
LONG = ["--integrator", "rk4,explicit_midpoint", "--dt", "2e-5", "--vary", "body.0.angular_velocity.1=1:5:60", "--no-figures",
        "--jobs", "1"]  # 120 runs


def files(folder):
    """The bytes of all files that do not depend on wall times, by name."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder)
        if path.is_file() and name.parts[0] not in ("shards", "timings") and "results." not in path.name and path.name != "timings.csv":
            found[str(name)] = path.read_bytes()
    return found


class Shards(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def run_in(self, place, *arguments, program="energy_drift", status=0):
        """Calls the program in a folder of its own, so that the same words name the same results."""
        (self.folder / place).mkdir(exist_ok=True)
        return call(program, *arguments, "--out", "out", folder=self.folder / place, status=status)

    def whole(self, *study, **settings):
        self.run_in("whole", *study, **settings)
        return files(self.folder / "whole/out")

    def shards(self, *study, count, place="parts", **settings):
        return [self.run_in(place, *study, "--shard", f"{k}/{count}", **settings) for k in range(1, count + 1)]

    def stores(self, place="parts"):
        return {path.parent.name: stored(path.parent) for path in (self.folder / place / "out/shards").glob("*/results.sqlite")}

    def test_a_dry_run_counts_the_runs_of_all_stores(self):
        study = [*LONG[:2], "--dt", "1e-3", *LONG[4:], "--t-end", "1"]
        self.run_in("parts", *study, "--shard", "1/2")
        for further, said in (([], "60 of 120 runs are there already"),
                              (["--shard", "1/2"], "shard 1/2: 60 runs, of which 60 are there already"),
                              (["--shard", "2/2"], "shard 2/2: 60 runs, of which 0 are there already"),
                              (["--merge"], "60 of 120 runs are there already")):
            with self.subTest(further):
                self.assertIn(said, self.run_in("parts", *study, *further, "--dry-run").stdout)
        done = self.run_in("parts", *study, "--shard", "1/2", "--dry-run").stdout
        self.assertIn("about 0.01 s with", done)

    def test_shards_make_the_bytes_of_one_process(self):
        whole = self.whole(*STUDY)
        said = self.shards(*STUDY, count=3)
        self.assertIn("shard 3/3 is done: 60 of 60 runs of the study are there", said[-1].stdout)
        self.assertEqual(sum(self.stores().values()), 60)
        self.assertGreater(min(self.stores().values()), 5)
        self.run_in("parts", *STUDY, "--merge")
        self.assertEqual(files(self.folder / "parts/out"), whole)

    def test_figures_and_trajectories_are_the_same(self):
        study = ["--integrator", "rk4,heun", "--dt", "0.01,0.02", "--t-end", "1", "--trajectory", "csv"]
        whole = self.whole(*study)
        self.shards(*study, count=2)
        self.run_in("parts", *study, "--merge")
        self.assertEqual(files(self.folder / "parts/out"), whole)
        self.assertTrue([name for name in whole if name.startswith("figures/")])
        self.assertEqual(len([name for name in whole if name.endswith("trajectory.csv")]), 4)

    def test_a_merge_says_what_is_missing_and_carries_out_nothing(self):
        whole = self.whole(*STUDY)
        self.run_in("parts", *STUDY, "--shard", "2/3")
        done = self.run_in("parts", *STUDY, "--merge", status=75)
        self.assertRegex(done.stderr, r"(\d+) of 60 runs are missing in out and its shards")
        self.assertFalse((self.folder / "parts/out/runs.csv").exists())
        self.run_in("parts", *STUDY)  # goes on where the shard ended
        self.assertEqual(files(self.folder / "parts/out"), whole)

    def test_another_number_of_shards_goes_on(self):
        whole = self.whole(*STUDY)
        self.run_in("parts", *STUDY, "--shard", "1/2")
        self.shards(*STUDY, count=4)
        self.assertEqual(sum(self.stores().values()), 60, "a run was carried out twice, or never")
        self.run_in("parts", *STUDY, "--merge")
        self.assertEqual(files(self.folder / "parts/out"), whole)

    def test_a_killed_shard_goes_on(self):
        whole = self.whole(*LONG)
        (self.folder / "parts").mkdir()
        for moment in (1, 20, 40):
            program = subprocess.Popen([str(BIN / "energy_drift"), *LONG, "--shard", "1/2", "--out", "out"], cwd=self.folder / "parts",
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.addCleanup(program.kill)
            end = time.monotonic() + PATIENCE
            while stored(self.folder / "parts/out/shards/1_of_2") < moment and program.poll() is None and time.monotonic() < end:
                time.sleep(0.005)
            program.send_signal(signal.SIGKILL)
            self.assertEqual(program.wait(PATIENCE), -signal.SIGKILL, "it was not stopped half-way; make the study longer")
        self.shards(*LONG, count=2)
        self.assertEqual(sum(self.stores().values()), 120)
        self.run_in("parts", *LONG, "--merge")
        self.assertEqual(files(self.folder / "parts/out"), whole)

    def test_a_study_that_refines_is_finished_by_further_rounds(self):
        study = ["--scenario", "oscillator", "--integrator", "rk4,velocity_verlet", "--dt", "0.2:4:5:log", "--t-end", "10", "--no-figures"]
        whole = self.whole(*study, program="stability")
        for _ in range(60):
            self.shards(*study, count=2, program="stability")
            done = subprocess.run([str(BIN / "stability"), *study, "--merge", "--out", "out"], cwd=self.folder / "parts",
                                  capture_output=True, text=True, timeout=PATIENCE, stdin=subprocess.DEVNULL)
            if done.returncode != 75:
                break
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(files(self.folder / "parts/out"), whole)

    def test_two_programs_do_not_share_a_shard(self):
        program = subprocess.Popen([str(BIN / "energy_drift"), *LONG, "--shard", "1/2", "--out", "parts/out"], cwd=self.folder,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(program.wait)
        self.addCleanup(program.kill)
        end = time.monotonic() + PATIENCE
        while stored(self.folder / "parts/out/shards/1_of_2") == 0 and time.monotonic() < end:
            time.sleep(0.005)
        done = self.run_in("parts", *LONG, "--shard", "1/2", status=2)
        self.assertIn("another program is writing into out/shards/1_of_2", done.stderr)
        self.run_in("parts", *LONG, "--shard", "2/2")  # another shard may

    def test_what_makes_no_sense_is_refused(self):
        self.run_in("parts", "--integrator", "heun", "--dt", "0.01", "--no-figures")
        for arguments, reason in [(["--shard", "1/2"], "holds the results of a different study"),
                                  (["--shard", "3/2"], "--shard: 3/2: the number must be from 1"),
                                  (["--shard", "2"], "give its number and the number of shards: 3/16"),
                                  (["--shard", "1/2", "--merge"], "a shard carries out runs, --merge does not")]:
            with self.subTest(arguments):
                done = self.run_in("parts", *STUDY, *arguments, status=2)
                self.assertIn(reason, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1)
        self.assertFalse((self.folder / "parts/out/shards").exists())


if __name__ == "__main__":
    unittest.main()
