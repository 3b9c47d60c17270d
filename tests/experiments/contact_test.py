# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios with contact as a user meets them: impacts listed, energy accounted for, pairings refused with the reason."""
import math
import unittest

from programs import call, read, temporary_folder

FLOOR = '[[body]]\nname = "floor"\nstatic = true\nshape = { kind = "half_space", normal = [0, 0, 1] }\n'


class Contact(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def simulate(self, *arguments, status=0):
        return call("simulate", *arguments, "--no-figures", folder=self.folder, status=status)

    def test_a_ball_bounces_when_it_should(self):
        for method, setting in (("rk4", ["--dt", "1e-3"]), ("cvode_adams", ["--tolerance", "1e-12"])):
            out = self.folder / method
            self.simulate("--scenario", "bouncing_ball", "--integrator", method, *setting, "--impact-timing", "event_located",
                          "--out", out)
            events = read(out / "events.csv")
            first = math.sqrt(2 * 4.9 / 9.81)
            for k in range(6):
                self.assertAlmostEqual(float(events[k]["t_s"]), first * (1 + 2 * (1 - 0.5 ** k)), delta=1e-8)
                self.assertEqual([events[k][c] for c in ("kind", "body_a", "body_b", "nz")], ["impact", "0", "1", "1"])
                self.assertAlmostEqual(float(events[k]["energy_lost_J"]), 0.75 * 10 * 9.81 * 4.9 / 4 ** k, delta=1e-3)
            last = read(out / "energy.csv")[-1]
            self.assertAlmostEqual(float(last["impact_loss_J"]), 10 * 9.81 * 4.9, delta=1e-3)
            self.assertLess(abs(float(last["drift_J"])), 1e-5)

    def test_the_ledger_has_friction(self):
        for timing in ("time_stepping", "event_located"):
            out = self.folder / timing
            self.simulate("--scenario", "slip_to_roll", "--integrator", "rk4", "--dt", "1e-3", "--impact-timing", timing,
                          "--out", out)
            last = read(out / "energy.csv")[-1]
            self.assertAlmostEqual(float(last["friction_loss_J"]), 1.5 * 9 / 7, delta=1e-4)  # m v0²/7
            self.assertLess(abs(float(last["impact_loss_J"])), 1e-4)
            self.assertLess(abs(float(last["drift_J"])), 1e-4)
            events = read(out / "events.csv")
            self.assertEqual([e["kind"] for e in events], ["slide_end"] if timing == "event_located" else [])
            for event in events:
                self.assertAlmostEqual(float(event["t_s"]), 2 * 3 / (7 * 0.25 * 9.81), delta=1e-8)
            row, = read(out / "runs.csv")
            self.assertEqual([row[c] for c in ("broad_phase", "narrow_phase", "response", "impact_timing")],
                             ["sweep_and_prune", "sat", "sequential_impulses", timing])

    def test_a_force_takes_a_ball_through_its_bounces(self):
        for method, setting in (("rk4", ["--dt", "2e-5"]), ("cvode_bdf", ["--tolerance", "1e-11"])):
            out = self.folder / method
            self.simulate("--scenario", "bouncing_ball", "--integrator", method, *setting, "--response", "compliant",
                          "--t-end", "1.9", "--out", out)
            row, = read(out / "runs.csv")
            self.assertEqual([row["status"], row["response"], row["impact_timing"]], ["ok", "compliant", ""])
            energy = read(out / "energy.csv")
            # Restitution 0.5 leaves a quarter of the energy; a little goes with gravity over the depth of the impact.
            self.assertAlmostEqual(float(energy[-1]["work_J"]), -0.75 * 10 * 9.81 * 4.9, delta=1)
            self.assertLess(max(abs(float(e["drift_J"])) for e in energy), 0.02)

    def test_stiffness_is_an_axis(self):
        out = self.folder / "out"
        call("energy_drift", "--scenario", "bouncing_ball", "--integrator", "cvode_bdf", "--tolerance", "1e-8", "--response",
             "compliant", "--vary", "contact_stiffness=1e5,1e6", "--vary", "contact_slip_speed=1e-3,1e-4", "--t-end", "1.2",
             "--no-figures", "--out", out, folder=self.folder)
        rows = read(out / "runs.csv")
        self.assertEqual(len(rows), 4)
        self.assertEqual(len({row["rhs_evaluations"] for row in rows}), 2)  # a ball that falls straight does not slip

    def test_an_axis_is_empty_where_nothing_touches(self):
        out = self.folder / "out"
        call("energy_drift", "--scenario", "two_cubes,coursework", "--integrator", "semi_implicit_euler", "--dt", "0.01", "--t-end",
             "2", "--response", "all", "--impact-timing", "all", "--no-figures", "--out", out, folder=self.folder)
        rows = read(out / "runs.csv")
        self.assertEqual(sum(r["scenario"] == "coursework" for r in rows), 1)
        self.assertEqual(sum(r["scenario"] == "two_cubes" for r in rows), 10)
        for row in rows:
            self.assertEqual(row["impact_timing"] == "", row["response"] in ("", "compliant"))
            self.assertEqual(row["response"] == "", row["scenario"] == "coursework")
            self.assertEqual(row["status"], "ok")

    def test_what_makes_no_sense_says_why(self):
        for arguments, reason in (
                (["--scenario", "contact_detection", "--integrator", "rk4", "--dt", "1e-3", "--response", "compliant"],
                 "knows no impacts for end_at_contact"),
                (["--integrator", "odeint_dopri5", "--tolerance", "1e-8"], "take --impact-timing event_located"),
                (["--integrator", "rk4", "--dt", "1e-3", "--precision", "float"], "contact works in double only"),
                (["--integrator", "rk4", "--dt", "1e-3", "--response", "sequential_impulse"], "sequential_impulses")):
            scenario = [] if "--scenario" in arguments else ["--scenario", "bouncing_ball"]
            done = self.simulate(*scenario, *arguments, "--out", self.folder / "out", status=2)
            self.assertIn(reason, done.stderr)
            self.assertFalse((self.folder / "out").exists())

    def test_a_scenario_that_cannot_be_says_where(self):
        ball = '[[body]]\nname = "ball"\nmass = 1\nshape = { kind = "sphere", radius = 0.5 }\n'
        for text, place in ((ball, "s.toml:2:11: contact: needs two bodies with a shape"),
                            (ball.replace("0.5", "0.5, size = [1, 1, 1]") + FLOOR, "s.toml:6:"),
                            (ball.replace('"sphere", radius = 0.5', '"half_space", normal = [0, 0, 1]') + FLOOR,
                             "its body must be static"),
                            (ball + FLOOR.replace("[0, 0, 1]", "[0, 0, 0]"), "normal"),
                            ("contact_stiffness = 0\n" + ball + FLOOR, "s.toml:3:21: contact_stiffness")):
            (self.folder / "s.toml").write_text("t_end = 1\ncontact = true\n" + text, encoding="utf-8")
            done = self.simulate("--scenario", "s.toml", "--integrator", "rk4", "--dt", "1e-3", status=2)
            self.assertIn(place, done.stderr)


if __name__ == "__main__":
    unittest.main()
