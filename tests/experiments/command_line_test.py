# SPDX-License-Identifier: BSD-3-Clause
"""What the terminal says to a user: what was meant by a wrong name, what has no effect, why runs were refused."""
import pathlib
import re
import shutil
import subprocess
import unittest

from programs import call, read, temporary_folder

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
SHORT = ["--t-end", "0.1", "--no-figures"]


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def refused(self, *arguments, program="energy_drift"):
        """The one line on stderr."""
        done = call(program, *arguments, folder=self.folder, status=2)
        self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1), done.stderr)
        return done.stderr

    def ran(self, *arguments, program="energy_drift", status=0):
        return call(program, *arguments, *SHORT, "--out", "out", folder=self.folder, status=status).stdout

    def test_a_wrong_method_is_answered_by_what_was_meant(self):
        for said, meant in [("RK4", "'rk4'"), ("cvode", "'cvode_adams' or 'cvode_bdf'"), ("rkk4", "'rk4'"),
                            ("lie-midpoint", "'lie_midpoint'"), ("dopri5", "'odeint_dopri5'"), ("verle", "'velocity_verlet'")]:
            line = self.refused("--integrator", said)
            self.assertIn(f"no '{said}'; did you mean {meant}? --list integrators prints all ", line)
        line = self.refused("--integrator", "euler")
        for method in ("explicit_euler", "semi_implicit_euler", "lie_euler"):
            self.assertIn(f"'{method}'", line)
        line = self.refused("--integrator", "qqqqqq")
        self.assertNotIn("did you mean", line)
        self.assertLess(len(line), 120, "a name that is like no other is no reason for a list of all")

    def test_a_wrong_scenario_is_answered_by_what_was_meant(self):
        line = self.refused("--scenario", "peters")
        self.assertIn("did you mean 'peters_hsu' or 'peters_hsu_simple'? ./run energy_drift --list scenarios prints", line)
        self.assertNotIn("dzhanibekov", line)

    def test_the_first_unknown_option_is_named_first(self):
        line = self.refused("--dtt", "0.1", "--tolerances", "1e-3", "--foo")
        self.assertIn("there is no option '--dtt'; did you mean '--dt'? See --help", line)
        self.assertNotIn("foo", line)
        for said, meant in [("--tol=1e-3", "--tolerance"), ("--normalise", "--normalize"), ("-dt", "--dt"),
                            ("--state", "--angular-state"), ("--Scenario", "--scenario")]:
            self.assertIn(f"did you mean '{meant}'?", self.refused(said, "1"))
        self.assertIn("there is no option '--foo'; see --help", self.refused("--foo", "1", "--dtt"))
        self.assertIn("'explicit_euler' belongs to no option", self.refused("--integrator", "rk4", "explicit_euler"))

    def test_what_changes_no_run_is_refused(self):
        for arguments, option, reason in [
            (["--integrator", "rk4,dmv", "--tolerance", "1e-9"], "--tolerance", "every method here has a fixed step"),
            (["--integrator", "cvode_adams", "--dt", "0.1"], "--dt", "every method here chooses its own steps"),
            (["--integrator", "rk4", "--order", "3"], "--order", "no method here offers several orders"),
            (["--orientation", "matrix", "--rotation-from", "stored"], "--rotation-from", "a matrix is used as it is"),
            (["--response", "compliant"], "--response", "no scenario here has contact = true"),
            (["--broad-phase", "all"], "--broad-phase", "no scenario here has contact = true"),
            (["--scenario", "two_cubes", "--integrator", "rk4", "--response", "compliant", "--impact-timing", "event_located"],
             "--impact-timing", "no run here answers impacts one by one"),
        ]:
            self.assertIn(f"{option}: it has no effect, because {reason}", self.refused(*arguments))
        self.assertFalse(list(self.folder.iterdir()), "what is refused leaves nothing")
        # Where one run is changed, or where nothing was said, all is well.
        for arguments in (["--integrator", "rk4,cvode_adams", "--dt", "0.1", "--tolerance", "1e-6"],
                          ["--integrator", "rk4"], ["--integrator", "cvode_adams"],
                          ["--orientation", "matrix,quaternion", "--rotation-from", "stored"]):
            call("energy_drift", *arguments, "--dry-run", folder=self.folder)

    def test_an_empty_folder_name_is_refused(self):
        self.assertIn("--out: the value is empty", self.refused("--integrator", "rk4", *SHORT, "--out", ""))
        self.assertFalse(list(self.folder.iterdir()))

    def test_a_study_file_is_held_to_the_same(self):
        file = self.folder / "study.toml"
        file.write_text('integrator = "rk4"\n\ntolerance = 1e-9\n', encoding="utf-8")
        self.assertRegex(self.refused("--study", file), r"study\.toml:3:\d+: tolerance: it has no effect")
        file.write_text('integrators = "rk4"\n', encoding="utf-8")
        self.assertIn("no such axis; did you mean 'integrator'?", self.refused("--study", file))
        file.write_text('integrator = "rk4"\nscenario = "nope/x.toml"\n', encoding="utf-8")
        self.assertRegex(self.refused("--study", file), r"study\.toml:2:\d+: scenario: there is no file nope/x\.toml$")

    def test_a_study_file_names_the_command_line_for_its_options(self):
        file = self.folder / "study.toml"
        of_studies = {"--vary", "--grid", "--zip", "--random", "--cells", "--where"}
        options = re.findall(r"^ +(--[a-z-]+)", call("energy_drift", "--help", folder=self.folder).stdout, re.MULTILINE)
        self.assertGreater(len(options), 40)
        of_calls = 0
        for option in set(options) - of_studies:
            file.write_text(f'integrator = "rk4"\n{option[2:].replace("-", "_")} = ["?"]\n', encoding="utf-8")
            line = self.refused("--study", file)
            self.assertNotIn("no such axis", line)
            if "give it on the command line" in line:
                of_calls += 1
                self.assertRegex(line, rf"study\.toml:2:\d+: \w+: is no axis; give it on the command line, as {option}$")
        self.assertGreater(of_calls, 15)

    def test_drag_without_a_coefficient_is_refused(self):
        file = self.folder / "s.toml"
        text = 't_end = 1\n[[body]]\nmass = 1\ninertia = [1, 2, 3]\nvelocity = [1, 0, 0]\n[[force]]\nkind = "drag"\nbodies = ["body0"]\n'
        file.write_text(text, encoding="utf-8")
        self.assertIn("s.toml:6:1: force.0: has no effect without any of its keys linear, quadratic, angular; give at least one",
                      self.refused("--scenario", file))
        file.write_text(text + "quadratic = 0.5\n", encoding="utf-8")
        call("energy_drift", "--scenario", file, "--dry-run", folder=self.folder)

    def test_the_terminal_says_why_runs_were_refused_each_reason_once(self):
        reason = "cvode_adams works in double only, not in "
        arguments = ["--integrator", "rk4,cvode_adams", "--dt", "0.01", "--precision", "double,float,long_double",
                     "--tolerance", "1e-4,1e-6"]
        text = self.ran(*arguments, status=3)
        for precision in ("float", "long_double"):
            self.assertEqual(text.count(f"2 runs refused: {reason}{precision}\n"), 1, text)
        plan = call("energy_drift", *arguments, "--dry-run", folder=self.folder).stdout
        self.assertIn(f"2 runs will be refused: {reason}float\n", plan)

    def test_the_terminal_shows_every_run_of_a_small_study(self):
        def shown(count):
            text = self.ran("--integrator", "rk4", "--dt", "0.05", "--vary", f"body.0.angular_velocity.0=1:2:{count}")
            shutil.rmtree(self.folder / "out")
            return len(re.findall("^rk4 ", text, re.MULTILINE)), text
        self.assertEqual(shown(46)[0], 46)
        rows, text = shown(120)
        self.assertEqual(rows, 40)
        self.assertIn("(40 of 120 runs, evenly spread; the other 80 are in runs.csv)", text)

    def test_numbers_that_a_range_made_are_rounded_for_people_alone(self):
        arguments = ["--integrator", "rk4", "--dt", "1e-3:1e-1:5:log", "--vary", "body.0.angular_velocity.0=1:2:4"]
        text = self.ran(*arguments) + call("energy_drift", *arguments, "--dry-run", folder=self.folder).stdout
        self.assertIn("0.0031623", text)
        self.assertIn("1.3333", text)
        pages = [text] + [(self.folder / "out" / name).read_text(encoding="utf-8")
                          for name in ("report.html", "tables/summary.md", "tables/summary.tex")]
        for page in pages:
            self.assertEqual(re.findall(r"0\.003162\d{3,}|1\.3333\d+|1\.6666\d+", page), [])
        runs = read(self.folder / "out" / "runs.csv")
        self.assertIn("0.0031622776601683794", {r["dt_s"] for r in runs})
        self.assertIn("1.3333333333333333", {r["body.0.angular_velocity.0"] for r in runs})

    def test_the_command_of_the_report_is_one_that_a_shell_takes(self):
        self.ran("--integrator", "rk4", "--dt", "0.05")
        page = (self.folder / "out" / "report.html").read_text(encoding="utf-8")
        self.assertIn("<code>./run energy_drift --integrator rk4 --dt 0.05 --t-end 0.1", page)

    def test_help_of_the_tests_builds_nothing(self):
        shutil.copy(CHECKOUT / "test", self.folder / "test")
        (self.folder / "scripts").mkdir()
        (self.folder / "scripts" / "setup.sh").write_text("install_packages() { echo installs; exit 9; }\n", encoding="utf-8")
        for arguments in (["--help"], ["-h"], ["-R", "rk4", "--help"]):
            done = subprocess.run(["bash", "test", *arguments], cwd=self.folder, capture_output=True, text=True, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue(done.stdout.startswith("usage: ./test "), done.stdout)
        self.assertEqual(subprocess.run(["bash", "test"], cwd=self.folder, capture_output=True, timeout=60).returncode, 9)


if __name__ == "__main__":
    unittest.main()
