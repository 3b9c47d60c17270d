# SPDX-License-Identifier: BSD-3-Clause
"""The experiment `stability` as a user meets it: the limits that linear theory knows, measured on the runs, those of a free
top by energy and by motion, and resuming."""
import math
import re
import sqlite3
import unittest

from programs import call, read, temporary_folder

METHODS = "explicit_euler,semi_implicit_euler,velocity_verlet,rk4,implicit_midpoint,odeint_adams_bashforth_moulton"
SMALL = ["--scenario", "oscillator", "--integrator", METHODS, "--dt", "0.002,0.05:100:20:log"]
LIMITS = {"semi_implicit_euler": 2, "velocity_verlet": 2, "rk4": 2 * math.sqrt(2)}


class Stability(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out = cls.folder / "out"
        cls.printed = cls.run_program(*SMALL, "--out", cls.out)
        cls.runs = read(cls.out / "runs.csv")
        cls.steps = read(cls.out / "stability.csv")
        cls.critical = {r["integrator"]: r for r in read(cls.out / "critical_steps.csv")}

    @classmethod
    def run_program(cls, *arguments, status=0):
        done = call("stability", *arguments, folder=cls.folder, status=status)
        return done.stderr if status else done.stdout

    def steps_of(self, method):
        """Those with a verdict on the energy: of runs of 500 steps at least."""
        return sorted((r for r in self.steps if r["integrator"] == method and r["verdict"]),
                      key=lambda r: float(r["dt_s"]))

    def test_limits_on_the_oscillator_are_those_of_linear_theory(self):
        for method, limit in LIMITS.items():
            row = self.critical[method]
            self.assertEqual((row["growth"], row["linear_theory"]), ("found", "found"), method)
            self.assertAlmostEqual(float(row["critical_h_omega"]), limit, delta=0.01 * limit, msg=method)
            self.assertAlmostEqual(float(row["linear_critical_h_omega"]), limit, delta=1e-4 * limit, msg=method)
            low, high = float(row["largest_holding_step_s"]), float(row["critical_step_s"])
            self.assertLessEqual(high - low, 0.003 * high, method)

    def test_explicit_euler_has_no_stable_step(self):
        row = self.critical["explicit_euler"]
        self.assertEqual((row["growth"], row["linear_theory"]), ("from the smallest", "from the smallest"))
        self.assertEqual(row["holds_again"], "no")
        for step in self.steps_of("explicit_euler"):
            self.assertIn(step["verdict"], ("gaining", "blown up"), step["dt_s"])
            h = float(step["h_omega"])
            self.assertAlmostEqual(float(step["spectral_radius"]), math.sqrt(1 + h * h), delta=1e-12 * (1 + h))

    def test_implicit_midpoint_has_no_critical_step_up_to_100(self):
        row = self.critical["implicit_midpoint"]
        self.assertEqual((row["growth"], row["blow_up"], row["linear_theory"]), ("none", "none", "none"))
        self.assertEqual(float(row["largest_step_s"]), 100)
        for step in self.steps_of("implicit_midpoint"):
            self.assertEqual(step["verdict"], "stable", step["dt_s"])
            self.assertAlmostEqual(float(step["spectral_radius"]), 1, delta=1e-9)

    def test_what_loses_energy_is_told_from_what_keeps_it(self):
        def verdicts(method):
            return {s["verdict"] for s in self.steps_of(method) if 0.05 <= float(s["h_omega"]) < 1.99}
        self.assertEqual(verdicts("rk4"), {"damped"})
        self.assertEqual(verdicts("velocity_verlet"), {"stable"})

    def test_the_motion_is_followed_up_to_the_phase_error_that_theory_gives(self):
        # The bound is 0.5 m, a quarter of the largest displacement, within 40 s. Verlet swings at ω' = 1 + h²/24: the two
        # are 0.5 m apart at a phase of 2 asin 0.25. Explicit Euler's amplitude is e^(ht/2).
        self.assertEqual({r["motion"] for r in self.critical.values()}, {"found"})
        self.assertEqual({r["motion_lost_by"] for r in self.critical.values()}, {"position"})
        verlet, euler = (float(self.critical[m]["largest_following_step_s"]) for m in ("velocity_verlet", "explicit_euler"))
        self.assertAlmostEqual(verlet, math.sqrt(24 * 2 * math.asin(0.25) / 40), delta=0.05)
        self.assertAlmostEqual(euler, 2 * math.log(1.5) / 40, delta=0.003)
        for method, limit in LIMITS.items():
            self.assertLess(float(self.critical[method]["largest_following_step_s"]), limit, method)

    def test_every_step_tried_is_a_run_of_whole_steps(self):
        self.assertEqual({r["run"] for r in self.runs}, {s["run"] for s in self.steps})
        self.assertGreater(len(self.runs), 6 * 21)
        judged = {s["run"] for s in self.steps if s["verdict"]}
        for run in self.runs:
            ratio = float(run["t_end_s"]) / float(run["dt_s"])
            self.assertAlmostEqual(ratio, round(ratio), delta=1e-6)
            self.assertGreaterEqual(float(run["t_end_s"]), 40)
            self.assertEqual(round(ratio) >= 500, run["run"] in judged)

    def test_a_multi_step_method_has_limits_and_no_map_of_one_step(self):
        self.assertEqual(self.critical["odeint_adams_bashforth_moulton"]["linear_theory"], "")
        self.assertEqual({s["spectral_radius"] for s in self.steps_of("odeint_adams_bashforth_moulton")}, {""})

    def test_what_is_left_half_done_is_taken_up_again(self):
        again = self.folder / "again"
        self.run_program(*SMALL, "--jobs", "1", "--no-figures", "--out", again)
        with sqlite3.connect(again / "results.sqlite") as store:  # as after a crash within the bisection
            later = [r[0] for r in store.execute("SELECT id FROM runs ORDER BY rowid DESC LIMIT 7")]
            store.executemany("DELETE FROM runs WHERE id = ?", [(i,) for i in later])
        store.close()
        self.run_program(*SMALL, "--no-figures", "--out", again)
        for name in ("runs.csv", "stability.csv", "critical_steps.csv", "tables/critical_steps.tex"):
            self.assertEqual((again / name).read_bytes(), (self.out / name).read_bytes(), name)
        wider = [a.replace(METHODS, METHODS + ",heun") for a in SMALL]
        self.run_program(*wider, "--no-figures", "--out", again)
        self.assertIn("heun", (again / "critical_steps.csv").read_text(encoding="utf-8"))
        other = ["--scenario", "oscillator", "--integrator", "rk4", "--dt", "0.1,1"]
        self.assertIn("different study", self.run_program(*other, "--out", again, status=2))

    def test_the_limit_moves_with_the_stiffness_and_the_map_shows_it(self):
        out = self.folder / "map"
        self.run_program("--scenario", "oscillator", "--integrator", "velocity_verlet,rk4", "--dt", "0.05:10:8:log",
                         "--vary", "force.0.stiffness=0.25,1,4", "--out", out)
        for row in read(out / "critical_steps.csv"):
            limit = LIMITS[row["integrator"]]
            self.assertAlmostEqual(float(row["critical_h_omega"]), limit, delta=0.01 * limit)
            self.assertAlmostEqual(float(row["critical_step_s"]), limit / math.sqrt(float(row["force.0.stiffness"])),
                                   delta=0.02 * limit)
        for kind in ("svg", "pdf", "tex"):
            self.assertGreater((out / f"figures/stability_map_1.{kind}").stat().st_size, 1000)
        data = (out / "figures/stability_map_1.dat").read_text(encoding="utf-8")
        edges = [float(line.split()[2]) for line in data.split(": blown up")[1].split("\n\n")[0].splitlines()[2:]]
        self.assertEqual(len(edges), 3)
        for edge in edges:  # of the first panel, velocity_verlet: the cells that blow up begin at the limit
            self.assertAlmostEqual(edge, 2, delta=0.02)

    def test_words_say_what_the_table_says(self):
        self.assertIn("oscillator, no critical step up to the largest tried: implicit_midpoint.", self.printed)
        self.assertRegex(self.printed, r"already: explicit_euler\.")
        self.assertRegex(self.printed, r"same limit to 1 % for 5 of 5 cases\.")
        self.assertRegex(self.printed, r"oscillator, the motion is followed for 40 s: up to h\|ω\| 0\.02")
        self.assertIn("Left out, since they choose their own steps: cvode_adams", self.printed)
        report = re.sub(r"<[^>]*>", "", (self.out / "report.html").read_text(encoding="utf-8"))
        self.assertIn("Left out, since they choose their own steps", report)

    def test_by_itself_it_makes_limits_of_all_methods_and_a_map_of_some(self):
        said = self.run_program("--dry-run", "--out", "never")
        self.assertIn("further runs follow from the results of these", said)
        self.assertRegex(said, r"(?m)^about .* with \d+ jobs?[,:] ")
        values = re.search(r"body\.0\.inertia\.1 +(.*)", said)[1].split(", ")
        self.assertEqual(len(values), 16)
        plain = self.run_program("--scenario", "oscillator,hairer_vilmart", "--dry-run", "--out", "never")
        self.assertNotIn("inertia", plain)
        runs = [int(re.search(r"(\d+) runs", text)[1]) for text in (said, plain)]
        self.assertEqual(runs[0] - runs[1], 6 * 16 * 24)

    def test_what_makes_no_sense_is_refused_in_one_line(self):
        for arguments, words in ((["--integrator", "cvode_bdf"], "chooses its own steps"),
                                 (["--t-end", "1,2"], "--t-end: stability takes one"),
                                 (["--samples", "10"], "--samples: stability looks at every step")):
            said = self.run_program(*arguments, "--out", "never", status=2)
            self.assertIn(words, said)
            self.assertEqual(len(said.splitlines()), 1)
        self.assertFalse((self.folder / "never").exists())


TOP = ["explicit_euler", "explicit_midpoint", "rk4", "lie_midpoint", "gauss4"]


class StabilityOfATop(unittest.TestCase):
    """Hairer and Vilmart's free top with ω in body axes, where theory tells gain from loss: E(ω) is a square, so that one
    step of Euler's method adds ½h² ω̇·Iω̇ to it."""

    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out = cls.folder / "out"
        cls.printed = call("stability", "--scenario", "hairer_vilmart", "--integrator", ",".join(TOP), "--angular-state",
                           "velocity_body", "--dt", "0.001:10:16:log", "--t-end", "40", "--no-figures", "--out", cls.out,
                           folder=cls.folder).stdout
        cls.critical = {r["integrator"]: r for r in read(cls.out / "critical_steps.csv")}
        cls.runs = {r["run"]: r for r in read(cls.out / "runs.csv")}
        cls.steps = read(cls.out / "stability.csv")

    def exponent(self, method):
        return float(self.critical[method]["energy_gain_exponent"])

    def test_the_motion_has_a_limit_for_every_method_and_it_is_that_of_the_runs(self):
        for method in TOP:
            row = self.critical[method]
            self.assertEqual((row["motion"], row["motion_measured"], float(row["motion_duration_s"])),
                             ("found", "yes", 40), method)
            limit, lost = float(row["largest_following_step_s"]), float(row["motion_lost_step_s"])
            self.assertLessEqual(lost - limit, 0.01 * lost)
            for step in self.steps:
                run = self.runs[step["run"]]
                if step["integrator"] != method or step["motion_lost"]:
                    continue
                self.assertLess(float(run["attitude_error_max_rad"]), 1)
                self.assertLess(float(run["orientation_defect_max"]), 0.1)
                self.assertLess(float(run["angular_momentum_drift_max_rel"]), 0.1)
            self.assertFalse([s for s in self.steps if s["integrator"] == method and float(s["dt_s"]) <= limit
                              and s["motion_lost"] and float(s["t_end_s"]) < 40 + float(s["dt_s"])])
        limits = [float(self.critical[m]["largest_following_step_s"]) for m in TOP]
        self.assertLess(limits[0], 0.01)
        self.assertEqual(min(limits), limits[0])
        self.assertEqual(max(limits), limits[-1])

    def test_explicit_euler_gains_at_every_step_in_proportion_to_it(self):
        for step in self.steps:
            if step["integrator"] != "explicit_euler" or not step["verdict"]:
                continue
            self.assertIn(step["verdict"], ("gaining slowly", "gaining", "blown up"), step["dt_s"])
            if step["verdict"] != "blown up":
                self.assertGreater(float(step["energy_gain_per_s"]), 0)
        self.assertEqual(self.critical["explicit_euler"]["energy_below"], "gaining slowly")
        self.assertAlmostEqual(self.exponent("explicit_euler"), 1, delta=0.1)

    def test_rk4_loses_slowly_in_proportion_to_the_fifth_power_of_its_step(self):
        row = self.critical["rk4"]
        self.assertEqual((row["energy_below"], row["growth"], row["blow_up"]), ("damped", "found", "found"))
        self.assertLess(float(row["energy_gain_per_s"]), 0)
        self.assertAlmostEqual(self.exponent("rk4"), 5, delta=0.3)
        self.assertLess(float(row["largest_following_step_s"]), float(row["critical_step_s"]))

    def test_midpoint_on_the_group_and_gauss_neither_gain_nor_lose(self):
        for method in ("lie_midpoint", "gauss4"):
            row = self.critical[method]
            self.assertEqual((row["energy_below"], row["energy_gain_per_s"]), ("stable", ""), method)
            self.assertLess(float(row["largest_following_step_s"]), float(row["critical_step_s"]), method)

    def test_explicit_midpoint_is_not_called_stable_beyond_its_motion(self):
        row = self.critical["explicit_midpoint"]
        self.assertEqual(row["energy_below"], "gaining slowly")
        self.assertAlmostEqual(self.exponent("explicit_midpoint"), 3, delta=0.2)
        self.assertLess(float(row["largest_following_step_s"]), 0.5 * float(row["critical_step_s"]))
        for step in self.steps:  # q grows without bound, whatever the energy does
            if float(self.runs[step["run"]]["orientation_defect_max"] or 0) > 1000 and step["verdict"]:
                self.assertEqual(step["verdict"], "blown up")

    def test_the_text_speaks_of_the_motion_first_and_of_slow_gains_with_their_rates(self):
        text = self.printed
        self.assertLess(text.index("hairer_vilmart, the motion is followed for 40 s: up to"), text.index("critical h|ω| of the energy"))
        self.assertNotIn("already", text)
        self.assertRegex(text, r"gained slowly, not by an instability, .* in a turn: explicit_euler \([^)]*∝ h\^1\.0\)")
        self.assertRegex(text, r"energy is lost below .*rk4 \([^)]*∝ h\^5\.\d\)")

    def test_a_slow_gain_is_no_critical_step(self):
        out = self.folder / "world"
        text = call("stability", "--scenario", "hairer_vilmart", "--integrator", "rk4", "--dt", "0.02:10:12:log",
                    "--t-end", "40", "--no-figures", "--out", out, folder=self.folder).stdout
        row = read(out / "critical_steps.csv")[0]
        self.assertEqual((row["growth"], row["energy_below"]), ("found", "gaining slowly"))
        self.assertGreater(float(row["critical_h_omega"]), 1)
        self.assertAlmostEqual(float(row["energy_gain_exponent"]), 5, delta=0.3)
        self.assertNotIn("already", text)

    def test_a_pendulum_that_starts_with_no_energy_is_judged_by_that_of_its_motion(self):
        rod = self.folder / "rod.toml"
        rod.write_text("""t_end = 10
gravity = [0, 0, -9.81]
[[body]]
mass = 1.5
inertia = [1.1666667, 1.1666667, 0.001]
pinned = true
center_of_mass = [0, 0, -0.8333333333]
orientation = [0.7071067811865476, 0.7071067811865475, 0, 0]
""", encoding="utf-8")
        out = self.folder / "rod"
        call("stability", "--scenario", rod, "--integrator", "rk4,lie_midpoint,gauss4", "--dt", "0.01:3:10:log",
             "--t-end", "20", "--no-figures", "--out", out, folder=self.folder)
        for row in read(out / "critical_steps.csv"):
            self.assertEqual(row["blow_up"], "found", row["integrator"])
            self.assertGreater(float(row["blow_up_h_omega"]), 1, row["integrator"])
            self.assertEqual(row["motion"], "found", row["integrator"])
            self.assertGreater(float(row["largest_following_step_s"]), 0.05, row["integrator"])

    def test_of_contact_neither_a_linear_theory_nor_a_reference_is_told(self):
        text = call("stability", "--scenario", "bouncing_ball", "--integrator", "semi_implicit_euler", "--dt", "0.002,0.01",
                    "--t-end", "1", "--no-figures", "--out", self.folder / "contact", folder=self.folder).stdout
        self.assertIn("bouncing_ball: no exact motion is known", text)
        for words in ("is linear", "--reference", "linear theory"):
            self.assertNotIn(words, text)

    def test_help_says_what_the_bounds_are(self):
        said = " ".join(call("stability", "--help", folder=self.folder).stdout.split())
        for words in ("less than 1 % of its scale", "attitude error below 1 rad", "below 0.25 of the largest displacement",
                      "momenta and further invariants below 0.1", "orientation defect below 0.1"):
            self.assertIn(words, said)


if __name__ == "__main__":
    unittest.main()
