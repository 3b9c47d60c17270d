# SPDX-License-Identifier: BSD-3-Clause
"""Studies by job scripts, on a real Slurm and by GNU parallel: the files are those of one process, whatever strikes."""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "experiments"))

from cluster import Cluster, why_not  # noqa: E402
from programs import BIN, PATIENCE, call, temporary_folder  # noqa: E402
from shards_test import files  # noqa: E402

STUDY = ["--integrator", "rk4,explicit_midpoint", "--dt", "1e-4", "--vary", "body.0.angular_velocity.1=1:5:20",
         "--no-figures", "--out", "out"]  # 40 runs
LONG = ["--scenario", "free_symmetric_top", "--integrator", "rk4", "--dt", "4e-7", "--t-end", "10", "--vary",
        "body.0.angular_velocity.1=1:5:8", "--no-figures", "--out", "out"]  # 8 runs in lanes, 3.5 s


class Jobs(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)
        for place in ("whole", "jobs"):
            (self.folder / place).mkdir()

    @classmethod
    def setUpClass(cls):
        cls.made = {}

    def whole(self, study):
        """The files of the study in one process."""
        if str(study) not in self.made:
            call("energy_drift", *study, folder=self.folder / "whole")
            self.made[str(study)] = files(self.folder / "whole/out")
        return self.made[str(study)]

    def write(self, study, jobs, *further):
        return call("energy_drift", *study, "--slurm", jobs, *further, folder=self.folder / "jobs")

    def log(self):
        return "".join(path.read_text(errors="replace")[-500:] for path in sorted((self.folder / "jobs/out/slurm").glob("*.log")))

    def assert_same(self, whole):
        found = files(self.folder / "jobs/out")
        made = {name: text for name, text in found.items() if not name.startswith("slurm/")}
        self.assertEqual(sorted(made), sorted(whole), self.log())
        self.assertEqual([name for name in made if made[name] != whole[name]], [], self.log())


class Scripts(Jobs):
    def test_gnu_parallel_carries_out_the_study(self):
        if not shutil.which("parallel"):
            self.skipTest("skipped, because GNU parallel is not installed")
        self.write(STUDY, "shards=3")
        done = subprocess.run([self.folder / "jobs/out/slurm/parallel.sh"], cwd=self.folder, capture_output=True, text=True,
                              timeout=PATIENCE, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same(self.whole(STUDY))

    def test_the_file_of_hosts_is_that_of_the_folder_of_the_call(self):
        (self.folder / "hosts").mkdir()
        stand_in = self.folder / "hosts/parallel"  # prints the file that it is given
        stand_in.write_text('#!/bin/bash\nwhile [ "$1" != --sshloginfile ]; do shift; done\ncat "$2"\n')
        stand_in.chmod(0o755)
        (self.folder / "hosts/hosts.txt").write_text("a host of mine\n")
        self.write(STUDY, "shards=3")
        done = subprocess.run([self.folder / "jobs/out/slurm/parallel.sh", "hosts.txt"], cwd=self.folder / "hosts",
                              env={**os.environ, "PATH": f"{self.folder / 'hosts'}:{os.environ['PATH']}"},
                              capture_output=True, text=True, timeout=PATIENCE, stdin=subprocess.DEVNULL)
        self.assertIn("a host of mine", done.stdout)
        self.assertEqual(done.returncode, 75, done.stderr)  # no run was carried out

    def test_without_gnu_parallel_its_script_says_so(self):
        self.write(STUDY, "shards=3")
        done = subprocess.run(["/bin/bash", self.folder / "jobs/out/slurm/parallel.sh"], cwd=self.folder, env={"PATH": ""},
                              capture_output=True, text=True, timeout=PATIENCE, stdin=subprocess.DEVNULL)
        self.assertIn("there is no GNU parallel", done.stderr)
        self.assertEqual(done.returncode, 127)

    def test_options_pass_through(self):
        self.write(STUDY, "shards=4 cpus=2 time=2:00:00 mem=2G account=tops partition=long warning=90 rounds=5 option=--qos=low")
        script = (self.folder / "jobs/out/slurm/array.sh").read_text()
        for line in ("--time=2:00:00", "--mem=2G", "--account=tops", "--partition=long", "--array=1-4", "--cpus-per-task=2",
                     "--signal=B:USR1@90", "--qos=low"):
            self.assertIn(f"\n#SBATCH {line}\n", script)
        self.assertIn("\nexec /", script)
        self.assertIn("--jobs 2\n", script)

    def test_what_makes_no_sense_is_refused(self):
        for jobs, reason in [("shard=4", "--slurm shard: no such key; did you mean 'shards'?"),
                             ("shards=x", "--slurm shards: 'x' is no positive whole number"),
                             ("shards=1000000", "MaxArraySize"), ("shards=2 shards=3", "--slurm shards: it is given twice"),
                             ("mem=lots", "--slurm mem: 'lots' is no memory"), ("time=soon", "--slurm time: 'soon' is no time limit"),
                             ("time=0:50", "--slurm warning: 60 s before the end is all of time=0:50"),
                             ("time=1", "--slurm warning: 60 s before the end is all of time=1")]:
            for further in ([], ["--dry-run"]):
                done = call("energy_drift", *STUDY, "--slurm", jobs, *further, folder=self.folder / "jobs", status=2)
                self.assertIn(reason, done.stderr)
        for further in (["--shard", "1/2"], ["--merge"]):
            done = call("energy_drift", *STUDY, "--slurm", "shards=2", *further, folder=self.folder / "jobs", status=2)
            self.assertIn("leave --shard and --merge out", done.stderr)
        for time in ("2", "0", "1-0", "1-2:30", "1-2:30:15", "90:30", "1:00:30", "infinite"):
            call("energy_drift", *STUDY, "--slurm", f"time={time}", "--dry-run", folder=self.folder / "jobs")
        done = call("energy_drift", *STUDY, "--submit", folder=self.folder / "jobs", status=2)
        self.assertIn("--submit: there is nothing to submit", done.stderr)
        self.assertFalse((self.folder / "jobs/out").exists())


@unittest.skipIf(why_not(), f"skipped, because no Slurm can be started here: {why_not()}")
class Slurm(Jobs):
    def setUp(self):
        super().setUp()
        self.cluster = Cluster(self.folder / "cluster")
        self.addCleanup(self.cluster.stop)

    def submit(self, study, jobs):
        done = subprocess.run([str(BIN / "energy_drift"), *study, "--slurm", jobs, "--submit"], cwd=self.folder / "jobs",
                              env=self.cluster.environment, capture_output=True, text=True, timeout=PATIENCE, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"submitted: array \d+, merge \d+")

    def test_an_array_and_its_merge(self):
        self.submit(STUDY, "shards=4")
        self.cluster.wait_for_jobs()
        self.assert_same(self.whole(STUDY))

    def test_a_task_that_is_killed(self):
        self.submit(LONG, "shards=4")
        time.sleep(0.5)
        os.kill(self.cluster.wait_for_task().process, signal.SIGKILL)
        self.cluster.wait_for_jobs(2 * PATIENCE)
        self.assert_same(self.whole(LONG))

    def test_a_warning_before_the_time_limit(self):
        self.submit(LONG, "shards=2")
        time.sleep(0.5)
        os.kill(self.cluster.wait_for_task().process, signal.SIGUSR1)
        self.cluster.wait_for_jobs(2 * PATIENCE)
        self.assert_same(self.whole(LONG))

    def test_a_task_that_is_requeued(self):
        self.submit(LONG, "shards=2")
        task = self.cluster.wait_for_task()
        time.sleep(0.5)
        self.assertEqual(self.cluster.call("scontrol", "requeue", task.job).stderr, "")
        self.cluster.wait_for_jobs(3 * PATIENCE)
        self.assert_same(self.whole(LONG))

    def test_a_node_whose_daemon_is_killed(self):
        self.submit(LONG, "shards=2")
        node = self.cluster.wait_for_task().node
        time.sleep(0.5)
        self.cluster.kill_node(node)
        time.sleep(1)
        self.cluster.start_node(node)
        self.cluster.wait_for_jobs(3 * PATIENCE)
        self.assert_same(self.whole(LONG))

    def test_the_limit_of_arrays_is_that_of_the_site(self):
        done = subprocess.run([str(BIN / "energy_drift"), *STUDY, "--slurm", "shards=101"], cwd=self.folder / "jobs",
                              env=self.cluster.environment, capture_output=True, text=True, timeout=PATIENCE, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 2)
        self.assertIn("101 are more than the 100 that the site's MaxArraySize allows", done.stderr)


if __name__ == "__main__":
    unittest.main()
