# SPDX-License-Identifier: BSD-3-Clause
"""The experiments `impact`, `stack` and `pile` as a user meets them: small studies, what they leave and what they say."""
import math
import unittest

from programs import call, read, temporary_folder


class Impact(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out = cls.folder / "out"
        cls.printed = call("impact", "--dt", "0.032,0.016,0.008,0.004", "--response", "single_impulse,simultaneous", "--out", cls.out,
                           folder=cls.folder).stdout
        cls.rows = read(cls.out / "impacts.csv")

    def errors(self, column, motion, method, timing, response="single_impulse"):
        return {float(r["dt_s"]): float(r[column]) for r in self.rows if [r["motion"], r["integrator"], r["impact_timing"],
                r["response"]] == [motion, method, timing, response]}

    def test_located_times_have_the_order_of_the_method(self):
        for method, order in (("explicit_midpoint", 2), ("rk4", 4)):
            for motion in ("tumbling_cube", "spinning_cubes"):
                errors = self.errors("event_time_error_s", motion, method, "event_located")
                self.assertEqual(len(errors), 4)
                self.assertAlmostEqual(math.log2(errors[0.032] / errors[0.008]) / 2, order, delta=0.3)
        for h, error in self.errors("event_time_error_s", "tumbling_cube", "rk4", "time_stepping").items():
            self.assertTrue(0.01 * h < error <= 3 * h, f"{error} s at a step of {h} s")

    def test_located_impacts_keep_what_they_must(self):
        for row in self.rows:
            if row["impact_timing"] == "event_located" and row["integrator"] == "rk4":
                self.assertLess(float(row["energy_error_rel"]), 1e-13)
            if row["motion"] == "spinning_cubes":
                self.assertLess(float(row["linear_momentum_error_rel"]), 1e-13)
                self.assertLess(float(row["angular_momentum_error_rel"]), 1e-12)
            else:
                self.assertEqual(row["linear_momentum_error_rel"], "")

    def test_what_it_leaves(self):
        exact = [r for r in read(self.out / "runs.csv") if r["integrator"] == "odeint_fehlberg78"]
        self.assertEqual(len(exact), 2, "one run for each motion stands for the exact one")
        self.assertEqual(len(self.rows), 2 * 3 * 4 * 2 * 3)
        for name in ("figures/event_time.svg", "figures/energy.svg", "tables/impacts.tex", "report.html"):
            self.assertGreater((self.out / name).stat().st_size, 0, name)
        self.assertIn("On spinning_cubes the momentum is off by at most", self.printed)
        again = self.folder / "again"
        call("impact", "--dt", "0.032,0.016,0.008,0.004", "--response", "single_impulse,simultaneous", "--out", again, "--jobs", "1",
             folder=self.folder)
        for name in ("runs.csv", "impacts.csv", "figures/energy.svg", "tables/impacts.md"):
            self.assertEqual((self.out / name).read_bytes(), (again / name).read_bytes(), name)

    def test_losses_are_not_errors(self):
        out = self.folder / "ball"
        call("impact", "--scenario", "bouncing_ball", "--t-end", "2", "--integrator", "rk4", "--dt", "1e-3", "--impact-timing",
             "event_located", "--response", "single_impulse", "--no-figures", "--out", out, folder=self.folder)
        row, = read(out / "impacts.csv")
        self.assertLess(float(row["energy_error_rel"]), 1e-9, "half of its energy is lost, and booked")
        self.assertLess(float(row["event_time_error_s"]), 1e-11)

    def test_options_are_those_of_every_study(self):
        for program in ("impact", "stack", "pile"):
            self.assertIn("--response", call(program, "--help", folder=self.folder).stdout)
            self.assertIn("simultaneous", call(program, "--list", "responses", folder=self.folder).stdout)
            self.assertIn(program + ": ", call(program, "--dry-run", "--out", self.folder / "none", folder=self.folder).stdout)
            self.assertFalse((self.folder / "none").exists())


class Stack(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def test_two_boxes_stand_and_a_lean_one_falls(self):
        scenario = self.folder / "lean.toml"
        scenario.write_text('t_end = 4\ncontact = true\ngravity = [0, 0, -9.81]\n'
                            '[[body]]\nname = "low"\nmass = 1\nshape = { kind = "box", size = [1, 1, 1] }\nposition = [0, 0, 0.5]\nfriction = 0.5\n'
                            '[[body]]\nname = "high"\nmass = 1\nshape = { kind = "box", size = [1, 1, 1] }\nposition = [0.4, 0, 1.5]\nfriction = 0.5\n'
                            '[[body]]\nname = "floor"\nstatic = true\nfriction = 0.5\nshape = { kind = "half_space", normal = [0, 0, 1] }\n',
                            encoding="utf-8")
        for shift, stands in (("0.4", True), ("0.51", False)):
            out = self.folder / shift
            call("stack", "--scenario", scenario, "--vary", f"body.high.position.0={shift}", "--dt", "0.01", "--response",
                 "sequential_impulses", "--no-figures", "--out", out, folder=self.folder)
            row, = read(out / "standing.csv")
            self.assertEqual(row["boxes"], "2")
            self.assertEqual(row["left_place_s"] == "", stands, row)
            self.assertLess(float(row["displacement_after_2s_max_m"]), 1e-3, "what falls lies still by then")

    def test_heights_are_an_axis(self):
        out = self.folder / "out"
        done = call("stack", "--vary", "body.box.repeat=[1,1,2];[1,1,4]", "--dt", "0.01", "--t-end", "3", "--out", out, folder=self.folder)
        rows = read(out / "standing.csv")
        self.assertEqual(sorted((r["response"], r["boxes"]) for r in rows),
                         [(r, n) for r in ("sequential_impulses", "single_impulse") for n in ("2", "4")])
        self.assertIn("stand to the end", done.stdout)
        self.assertTrue((out / "figures" / "stacks.pdf").exists())


class Pile(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def test_times_stand_apart(self):
        outs = [self.folder / "a", self.folder / "b"]
        for out in outs:
            call("pile", "--scenario", "pile_10,pile_100", "--t-end", "2", "--out", out, folder=self.folder)
        for name in ("runs.csv", "piles.csv", "tables/piles.tex", "figures/piles.svg"):
            self.assertEqual((outs[0] / name).read_bytes(), (outs[1] / name).read_bytes(), name)
        rows = read(outs[0] / "piles.csv")
        self.assertEqual([r["bodies"] for r in rows], ["10", "100"])
        for row in rows:
            self.assertLess(float(row["penetration_max_m"]), 0.2, "nothing passes through anything")
            self.assertLess(float(row["energy_rise_max_rel"]), 0.02)
        self.assertTrue(all(float(r["steps_per_s"]) > 0 for r in read(outs[0] / "timings" / "cost.csv")))
        runs = read(outs[0] / "runs.csv")
        self.assertTrue(all(float(r["impact_loss_J"]) > 0 for r in runs))


if __name__ == "__main__":
    unittest.main()
