# SPDX-License-Identifier: BSD-3-Clause
"""The built-in scenarios with contact: each does what its comment says."""
import math
import unittest

from programs import call, read, temporary_folder

G = 9.81


class Scenes(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def simulate(self, scenario, timing, *arguments, method="rk4", dt="1e-3"):
        self.out = self.folder / f"{scenario}-{timing}"
        call("simulate", "--scenario", scenario, "--integrator", method, "--dt", dt, "--impact-timing", timing, *arguments,
             "--no-figures", "--out", self.out, folder=self.folder)
        row, = read(self.out / "runs.csv")
        self.assertEqual(row["status"], "ok", row["message"])
        return row

    def rows(self):
        """Of the trajectory: for each body its rows, as numbers."""
        bodies = {}
        for row in read(self.out / "trajectory.csv"):
            bodies.setdefault(int(row["body"]), []).append({k: float(v) for k, v in row.items()})
        return bodies

    def vector(self, row, what, unit):
        return [row[f"{what}{axis}_{unit}"] for axis in "xyz"]

    def test_detection_pauses_at_the_contact(self):
        located = {}
        for method, setting in (("rk4", ["--dt", "1e-3"]), ("odeint_dopri5", ["--tolerance", "1e-12"]),
                                ("cvode_adams", ["--tolerance", "1e-12"])):
            out = self.folder / method
            call("simulate", "--scenario", "contact_detection", "--integrator", method, *setting, "--impact-timing",
                 "event_located", "--no-figures", "--out", out, folder=self.folder)
            event, = read(out / "events.csv")
            last = read(out / "trajectory.csv")[-1]
            self.assertEqual(event["t_s"], last["t_s"])
            self.assertEqual(float(event["impulse_N_s"]), 0)
            located[method] = float(event["t_s"])
        self.assertAlmostEqual(located["rk4"], located["odeint_dopri5"], delta=1e-10)
        self.assertAlmostEqual(located["rk4"], located["cvode_adams"], delta=1e-8)
        self.simulate("contact_detection", "time_stepping")
        times = sorted({row["t_s"] for row in self.rows()[0]})
        self.assertEqual(times[-1], float(read(self.out / "events.csv")[0]["t_s"]))
        self.assertTrue(0 <= times[-1] - located["rk4"] <= 1e-3, "the first step at which they overlap")
        # Nothing is answered: both still move as they did.
        self.assertEqual([self.vector(r[-1], "v", "m_per_s")[0] for r in self.rows().values()], [1, -1])

    def test_elastic_cubes(self):
        row = self.simulate("cube_bouncing", "event_located")
        energies = [float(r["energy_J"]) for r in read(self.out / "trajectory.csv")]
        self.assertLess(max(energies) / energies[0] - 1, 1e-8)
        first = float(read(self.out / "events.csv")[0]["t_s"])
        self.assertAlmostEqual(first, math.sqrt(2 / G), delta=1e-10)
        for scenario in ("vertex_on_face", "edge_on_edge"):
            row = self.simulate(scenario, "event_located")
            self.assertLess(float(row["linear_momentum_drift_max_rel"]), 1e-13)
            self.assertLess(float(row["angular_momentum_drift_max_rel"]), 1e-13)
            event, = read(self.out / "events.csv")
            self.assertLess(abs(float(event["energy_lost_J"])), 1e-13)
            self.assertAlmostEqual(abs(float(event["nx"])), 1, delta=1e-12)
        bodies = self.rows()  # edge_on_edge
        for body in (0, 1):
            self.assertGreater(math.hypot(*self.vector(bodies[body][-1], "w", "rad_per_s")), 0.1)
        self.simulate("vertex_on_face", "event_located")
        speeds = [self.vector(r[-1], "v", "m_per_s")[0] for r in self.rows().values()]
        self.assertAlmostEqual(speeds[0], 0, delta=1e-12)
        self.assertAlmostEqual(speeds[1], 1, delta=1e-12)

    def test_one_block_sticks_and_one_slides(self):
        for timing in ("time_stepping", "event_located"):
            self.simulate("incline", timing)
            rough, smooth = self.rows().values()
            moved = math.dist(self.vector(rough[0], "p", "m"), self.vector(rough[-1], "p", "m"))
            self.assertLess(moved, 1e-9)
            speed = math.hypot(*self.vector(smooth[-1], "v", "m_per_s"))
            self.assertAlmostEqual(speed, 2 * G * (math.sin(0.3) - 0.2 * math.cos(0.3)), delta=1e-4)

    def test_all_dominoes_fall(self):
        self.simulate("dominoes", "time_stepping")
        last = [rows[-1] for rows in self.rows().values()]
        self.assertEqual(len(last), 15)
        self.assertTrue(all(row["pz_m"] < 0.013 for row in last), "they stood at 0.024 m")
        self.assertTrue(all(a["px_m"] < b["px_m"] for a, b in zip(last, last[1:])), "in their order")

    def test_a_coin_rolls_round(self):
        self.simulate("spinning_coin", "time_stepping", "--t-end", "0.2", "--samples", "40", dt="1e-4")
        coin = self.rows()[0]
        self.assertTrue(all(math.hypot(r["px_m"], r["py_m"]) < 1e-3 for r in coin), "its centre stays")
        self.assertLess(abs(coin[-1]["pz_m"] / coin[0]["pz_m"] - 1), 0.03)

    def test_a_rattleback_turns_back_only_one_way(self):
        self.simulate("rattleback", "time_stepping", "--t-end", "5", "--samples", "50")
        self.assertGreater(self.rows()[0][-1]["wz_rad_per_s"], 4, "from −5 rad/s")
        self.simulate("rattleback", "time_stepping", "--t-end", "5", "--samples", "50", "--vary",
                      "body.stone.angular_velocity=[0.01,0.02,5]", "--force")
        self.assertGreater(self.rows()[0][-1]["wz_rad_per_s"], 4)

    def test_rolling_as_simbenchmark_has_it(self):
        row = self.simulate("simbenchmark_rolling", "time_stepping", "--samples", "4", method="semi_implicit_euler")
        bodies = self.rows()
        self.assertEqual(len(bodies), 26)
        pull = (0.5, math.sqrt(0.75))
        along = {body: sum(p * v for p, v in zip(pull, self.vector(rows[-1], "v", "m_per_s"))) / 4
                 for body, rows in bodies.items()}
        across = {body: rows[-1]["vx_m_per_s"] * pull[1] - rows[-1]["vy_m_per_s"] * pull[0] for body, rows in bodies.items()}
        self.assertLess(max(map(abs, across.values())), 1e-3, "along the force: a cone, no pyramid")
        self.assertAlmostEqual(along[0] / 0.7385, 1, delta=0.02)
        for body in range(1, 26):
            self.assertAlmostEqual(along[body] / 0.211, 1, delta=0.02)
        distance = math.dist(self.vector(bodies[0][0], "p", "m"), self.vector(bodies[0][-1], "p", "m"))
        friction = float(read(self.out / "energy.csv")[-1]["friction_loss_J"]) / distance
        self.assertAlmostEqual(friction / 137.34, 1, delta=0.02)
        self.assertAlmostEqual((150 - friction - 10 * along[0]) / 25 / 0.211, 1, delta=0.02)

    def test_shapes_decide_the_narrow_phase(self):
        for scenario, narrow in (("spinning_coin", "gjk"), ("cube_bouncing", "sat")):
            row = self.simulate(scenario, "time_stepping", "--t-end", "0.01")
            self.assertEqual(row["narrow_phase"], narrow)
        done = call("simulate", "--scenario", "spinning_coin", "--narrow-phase", "sat", "--out", self.folder / "no",
                    folder=self.folder, status=2)
        self.assertIn("take gjk", done.stderr)


if __name__ == "__main__":
    unittest.main()
