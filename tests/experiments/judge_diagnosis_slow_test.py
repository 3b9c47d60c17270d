# SPDX-License-Identifier: BSD-3-Clause
"""judge's first line on twenty trajectories with planted errors and twenty sound ones, finely and coarsely sampled.

POLHODE_BIN_DIR is the folder of judge and simulate. The planted ones are those of a program of its own (faulty_programs.py).
"""
import csv
import math
import unittest

import faulty_programs as faulty
import programs

STEPS = {"peters_hsu": 0.01, "hairer_vilmart": 0.02, "free_symmetric_top": 0.01, "lagrange_top": 0.005, "dzhanibekov": 0.2}
FINE, COARSE = (1, 300), (25, 20)  # steps from row to row, rows


def rows(scenario, sampling, **fault):
    every, count = sampling
    return faulty.motion(faulty.Body(scenario), STEPS[scenario], count, every, **fault)


# The name of the cause, words of it in the first line, the scenario and its rows, what is done wrong in the program, and
# what in its file.
PLANTED = [
    ("none", "sound", "hairer_vilmart", FINE, {}, {}),
    ("none", "sound", "lagrange_top", COARSE, {}, {"orientation": "matrix"}),
    ("gyroscopic_sign", "ω × Iω has the wrong sign", "peters_hsu", FINE, {"gyroscopic": -1}, {}),
    ("gyroscopic_sign", "ω × Iω has the wrong sign", "hairer_vilmart", COARSE, {"gyroscopic": -1}, {"digits": 6}),
    ("gyroscopic_absent", "ω × Iω is left out", "dzhanibekov", FINE, {"gyroscopic": 0}, {}),
    ("gyroscopic_absent", "ω × Iω is left out", "lagrange_top", COARSE, {"gyroscopic": 0}, {"orientation": "matrix"}),
    ("omega_frame", "its angular velocity is in body axes", "free_symmetric_top", FINE, {}, {"body_axes": True}),
    ("omega_frame", "the inertia is not turned with the body", "lagrange_top", COARSE, {"frame": "unturned"}, {}),
    ("transposed", "its rotation matrices are transposed", "peters_hsu", COARSE, {},
     {"transposed": True, "orientation": "matrix"}),
    ("transposed", "its quaternions are conjugated", "dzhanibekov", FINE, {}, {"transposed": True}),
    ("quaternion_order", "in the order x, y, z, w", "lagrange_top", FINE, {}, {"order": (1, 2, 3, 0)}),
    ("quaternion_order", "in the order x, y, z, w", "free_symmetric_top", COARSE, {}, {"order": (1, 2, 3, 0), "digits": 6}),
    ("degrees", "in degrees per second", "peters_hsu", FINE, {}, {"unit_of_rate": 180 / math.pi}),
    ("degrees", "in degrees per second", "lagrange_top", COARSE, {}, {"unit_of_rate": 180 / math.pi}),
    ("inertia", "the inertia is half the scenario's", "lagrange_top", FINE, {"inertia": (0.5, 0.5, 0.5)}, {}),
    ("inertia", "the moment of inertia about body axis 3 is half the scenario's", "hairer_vilmart", COARSE,
     {"inertia": (1, 1, 0.5)}, {}),
    ("first_order_step", "explicit Euler", "hairer_vilmart", FINE, {"method": "explicit"}, {}),
    ("first_order_step", "semi-implicit Euler", "peters_hsu", COARSE, {"method": "semi"}, {}),
    ("clock_offset", "its clock is fast by 0.05 s", "hairer_vilmart", FINE, {}, {"delay": 0.05}),
    ("clock_offset", "its clock is late by 0.02 s", "lagrange_top", COARSE, {}, {"delay": -0.02}),
]

# Methods with fine and large steps, in both charts, at every step and at few instants.
SOUND = [
    ("peters_hsu", "rk4", "0.01", []), ("peters_hsu", "rk4", "0.05", ["--samples", "40"]),
    ("peters_hsu", "exact_rotor", "0.05", []), ("peters_hsu", "lie_midpoint", "0.05", ["--orientation", "matrix"]),
    ("dzhanibekov", "dmv", "0.2", []), ("dzhanibekov", "rk4", "0.2", ["--samples", "40"]),
    ("dzhanibekov", "implicit_midpoint", "1", []),
    ("free_symmetric_top", "dmv", "0.05", ["--samples", "40"]), ("free_symmetric_top", "simo_wong", "0.02", []),
    ("free_symmetric_top", "explicit_midpoint", "0.005", ["--orientation", "matrix"]),
    ("hairer_vilmart", "dmv", "0.1", []), ("hairer_vilmart", "gauss4", "0.2", []),
    ("hairer_vilmart", "velocity_verlet", "0.01", ["--samples", "40"]),
    ("lagrange_top", "rk4", "0.02", []), ("lagrange_top", "implicit_midpoint", "0.01", ["--samples", "40"]),
    ("lagrange_top", "lie_midpoint", "0.01", ["--orientation", "matrix"]),
]


class Diagnosis(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = programs.temporary_folder(cls.addClassCleanup)
        cls.seen = 0

    def judged(self, scenario, files):
        """The first line and the row of scores.csv of each file."""
        out = f"judged_{scenario}_{Diagnosis.seen}"
        Diagnosis.seen += 1
        done = programs.call("judge", "--scenario", scenario, *files, "--no-figures", "--out", out, folder=self.folder)
        scores = programs.read(self.folder / out / "scores.csv")
        return list(zip(done.stdout.splitlines(), scores))

    def test_twenty_planted_errors(self):
        self.assertEqual(len(PLANTED), 20)
        by_scenario = {}
        for k, (cause, words, scenario, sampling, fault, written) in enumerate(PLANTED):
            path = self.folder / f"planted_{k}.csv"
            faulty.write(path, rows(scenario, sampling, **fault), **written)
            by_scenario.setdefault(scenario, []).append((path, cause, words))
        for scenario, cases in by_scenario.items():
            for (path, cause, words), (line, score) in zip(cases, self.judged(scenario, [c[0] for c in cases])):
                with self.subTest(f"{cause} on {scenario}"):
                    self.assertTrue(line.startswith(path.stem + ": "), line)
                    self.assertEqual(score["diagnosis"], cause, line)
                    self.assertIn(words, line)
                    if cause == "none":
                        self.assertEqual(score["diagnosis_factor"], "")
                    else:
                        self.assertGreaterEqual(float(score["diagnosis_factor"]), 10)
                        self.assertGreaterEqual(float(score["diagnosis_margin"]), 10)

    def test_twenty_sound_ones(self):
        by_scenario = {}
        for k, (scenario, method, step, options) in enumerate(SOUND):
            run = f"run_{k}"
            programs.call("simulate", "--scenario", scenario, "--integrator", method, "--dt", step, *options,
                          "--no-figures", "--out", run, folder=self.folder)
            by_scenario.setdefault(scenario, []).append(f"{run}/trajectory.csv")
        for scenario in ("peters_hsu", "lagrange_top"):  # CVODE, and q and −q by turns with few digits
            programs.call("simulate", "--scenario", scenario, "--integrator", "cvode_adams", "--tolerance", "1e-6",
                          "--samples", "100", "--no-figures", "--out", f"cvode_{scenario}", folder=self.folder)
            by_scenario[scenario].append(f"cvode_{scenario}/trajectory.csv")
            faulty.write(self.folder / f"signs_{scenario}.csv", rows(scenario, FINE), flips=True, digits=7)
            by_scenario[scenario].append(f"signs_{scenario}.csv")
        self.assertEqual(sum(map(len, by_scenario.values())), 20)
        for scenario, files in by_scenario.items():
            for file, (line, score) in zip(files, self.judged(scenario, files)):
                with self.subTest(f"{file} of {scenario}"):
                    self.assertEqual(score["diagnosis"], "none", line)
                    self.assertRegex(line, r": (sound|no wrong convention or equation)")
                    self.assertRegex(line, r"energy holds to [0-9.e-]+")

    def test_two_at_once(self):
        faulty.write(self.folder / "two.csv", rows("hairer_vilmart", FINE, gyroscopic=-1), body_axes=True)
        faulty.write(self.folder / "steps.csv", rows("lagrange_top", FINE, gyroscopic=-1, method="explicit"))
        ((line, score),) = self.judged("hairer_vilmart", ["two.csv"])
        self.assertEqual(set(score["diagnosis"].split("+")), {"omega_frame", "gyroscopic_sign"}, line)
        ((line, score),) = self.judged("lagrange_top", ["steps.csv"])
        self.assertEqual(set(score["diagnosis"].split("+")), {"first_order_step", "gyroscopic_sign"}, line)


if __name__ == "__main__":
    unittest.main()
