# SPDX-License-Identifier: BSD-3-Clause
"""Every program whose standard output, or whose file, is on a full disk says so: a line on stderr and exit status 3."""
import os
import pathlib
import subprocess
import unittest

from programs import BIN, PATIENCE, temporary_folder

EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "experiments"
PROGRAMS = sorted(main.parent.name for main in EXPERIMENTS.glob("*/main.cpp") if (BIN / main.parent.name).exists())
NO_STUDIES = ("archive", "broad_phase", "explain", "figures", "judge", "narrow_phase", "plot", "replay", "rerun", "results",
              "viewer")
STUDIES = [name for name in PROGRAMS if name not in NO_STUDIES]
PAIRS = ("id,class,ahx,ahy,ahz,apx,apy,apz,aqw,aqx,aqy,aqz,bhx,bhy,bhz,bpx,bpy,bpz,bqw,bqx,bqy,bqz\n"
         "7,kissing,1,1,1,0,0,0,1,0,0,0,1,1,1,3,0,0,2,0,0,0\n")
BOXES = "step,id,hx,hy,hz,px,py,pz\n0,1,1,1,1,0,0,0\n0,2,1,1,1,1,0,0\n"


@unittest.skipUnless(os.path.exists("/dev/full"), "skipped, because there is no /dev/full")
class FullDisk(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def refused(self, program, *arguments):
        """Runs it with a standard output that takes nothing."""
        with open("/dev/full", "w") as full:
            done = subprocess.run([str(BIN / program), *map(str, arguments)], cwd=self.folder, stdout=full, stderr=subprocess.PIPE,
                                  text=True, timeout=PATIENCE, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 3, (program, arguments, done.stderr))
        self.assertRegex(done.stderr, rf"\A{program}: standard output cannot be written(: [^\n]+)?\n\Z", arguments)

    def test_help_lists_and_plans(self):
        self.assertIn("energy_drift", STUDIES)
        for program in PROGRAMS:
            with self.subTest(program):
                self.refused(program, "--help")
                if program not in ("archive", "explain", "figures", "judge", "rerun", "results"):
                    self.refused(program, "--list")
                    self.refused(program, "--list", "shapes")
        for program in STUDIES:
            with self.subTest(program):
                self.refused(program, "--scenario", "peters_hsu", "--integrator", "rk4", "--dt", "0.1", "--dry-run")

    def test_results(self):
        (self.folder / "pairs.csv").write_text(PAIRS)
        self.refused("narrow_phase", "--pairs", "pairs.csv")
        (self.folder / "boxes.csv").write_text(BOXES)
        self.refused("broad_phase", "--boxes", "boxes.csv", "--broad-phase", "all_pairs", "--out", "found.csv")
        self.refused("simulate", "--dt", "0.1", "--t-end", "1", "--no-figures", "--out", "run")
        self.refused("judge", "--scenario", "peters_hsu", "run/trajectory.csv", "--no-figures", "--out", "judged")
        self.refused("archive", "check", "run")
        self.refused("results", "run")
        self.refused("results", "run", "--format", "csv")
        self.refused("rerun", "--all", "run")
        self.assertTrue((self.folder / "run/runs.csv").exists(), "what was made is kept all the same")

    def test_files(self):
        """By way of a link, lest a program that went wrong replaced the device by a file."""
        (self.folder / "pairs.csv").write_text(PAIRS)
        (self.folder / "boxes.csv").write_text(BOXES)
        for arguments in (["narrow_phase", "--pairs", "pairs.csv"], ["broad_phase", "--boxes", "boxes.csv", "--broad-phase", "all_pairs"]):
            with self.subTest(arguments[0]):
                (self.folder / "full").unlink(missing_ok=True)
                (self.folder / "full").symlink_to("/dev/full")
                done = subprocess.run([str(BIN / arguments[0]), *arguments[1:], "--out", "full"], cwd=self.folder,
                                      capture_output=True, text=True, timeout=PATIENCE)
                self.assertEqual((done.returncode, done.stdout), (3, ""))
                self.assertRegex(done.stderr, rf"\A{arguments[0]}: cannot write full: [^\n]+\n\Z")
                self.assertTrue((self.folder / "full").is_symlink())


if __name__ == "__main__":
    unittest.main()
