# SPDX-License-Identifier: BSD-3-Clause
"""judge as a user meets it: runs of simulate give their own numbers back, and other programs' files are taken or refused.

POLHODE_BIN_DIR is the folder of judge and simulate. Every test works in its own temporary folder.
"""
import csv
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import faulty_programs as faulty

BIN = pathlib.Path(os.environ.get("POLHODE_BIN_DIR", "."))
PATIENCE = 120  # s

SCORES = ["energy_initial_J", "energy_drift_max_rel", "energy_drift_final_rel", "energy_drift_rate_W",
          "energy_drift_rate_ci_W", "drift_exponent", "drift_exponent_low", "drift_exponent_high",
          "linear_momentum_drift_max_rel", "angular_momentum_drift_max_rel", "orientation_defect_max",
          "position_error_max_m", "attitude_error_max_rad", "angular_velocity_error_max_rel", "polhode_phase_error_max_s",
          "polhode_phase_error_max_rad", "polhode_off_error_max_rel"]


def only_row(path):
    with open(path, newline="", encoding="utf-8") as file:
        (row,) = csv.DictReader(file)
    return row


class Judge(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def call(self, program, *arguments):
        return subprocess.run([BIN / program, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=PATIENCE, check=False)

    def good(self, program, *arguments):
        done = self.call(program, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def refused(self, *arguments):
        before = sorted(self.folder.rglob("*"))
        done = self.call("judge", *arguments)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertRegex(done.stderr, r"\Ajudge: [^\n]+\n\Z")
        self.assertEqual(sorted(self.folder.rglob("*")), before)
        return done.stderr

    def test_a_run_of_ours_gets_its_own_numbers(self):
        cases = [("hairer_vilmart", "rk4", "--dt", "0.1", "--t-end", "400", "--samples", "1000"),
                 ("peters_hsu", "explicit_midpoint", "--dt", "0.01", "--samples", "500", "--orientation", "matrix"),
                 ("lagrange_top", "rk4", "--dt", "0.01", "--samples", "100", "--rotation-from", "stored"),
                 ("two_bodies", "velocity_verlet", "--dt", "0.01", "--t-end", "40", "--samples", "100")]
        for scenario, method, *options in cases:
            with self.subTest(scenario):
                run = self.folder / scenario
                self.good("simulate", "--scenario", scenario, "--integrator", method, *options, "--no-figures", "--out", run)
                out = self.folder / (scenario + "_judged")
                stored = ["--rotation-from", "stored"] if "stored" in options else []
                self.good("judge", "--scenario", scenario, run / "trajectory.csv", *stored, "--no-figures", "--out", out)
                ours, theirs = only_row(run / "runs.csv"), only_row(out / "scores.csv")
                self.assertEqual(theirs["drift_class"], ours["drift_class"])
                self.assertEqual((theirs["status"], theirs["trajectory"], theirs["notes"]), ("ok", scenario, ""))
                self.assertLessEqual(float(theirs["energy_column_difference_max_rel"]), 1e-14)
                for column in SCORES:
                    self.assertEqual(theirs[column] == "", ours[column] == "", column)
                    if ours[column]:
                        # What is round-off in both may differ by round-off.
                        self.assertAlmostEqual(float(theirs[column]), float(ours[column]),
                                               delta=1e-6 * abs(float(ours[column])) + 2e-13, msg=column)

    def test_single_precision_with_few_digits(self):
        self.good("simulate", "--scenario", "peters_hsu", "--integrator", "rk4", "--dt", "0.01", "--no-figures",
                  "--out", "run")
        with open(self.folder / "run" / "trajectory.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        columns = [c for c in reversed(list(rows[0])) if c not in ("body", "energy_J") and not c.startswith("l")]
        with open(self.folder / "engine.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(columns + ["frame_rate"])
            writer.writerows([f"{float(row[c]):.6g}" for c in columns] + ["60"] for row in rows)
        done = self.good("judge", "--scenario", "peters_hsu", "--trajectory-file", "engine.csv,run/trajectory.csv",
                         "--no-figures", "--out", "out")
        self.assertIn("engine", done.stdout)
        with open(self.folder / "out" / "scores.csv", newline="", encoding="utf-8") as file:
            engine, run = csv.DictReader(file)
        self.assertEqual((engine["trajectory"], run["trajectory"]), ("engine", "run"))
        self.assertEqual(engine["drift_class"], "bounded")
        self.assertAlmostEqual(float(engine["attitude_error_max_rad"]), float(run["attitude_error_max_rad"]), delta=1e-5)
        self.assertGreater(float(engine["energy_drift_max_rel"]), 1e-8)
        self.assertEqual(engine["energy_column_difference_max_rel"], "")

    def test_the_same_again_and_another(self):
        self.good("simulate", "--dt", "0.01", "--no-figures", "--out", "run")
        command = ["--scenario", "peters_hsu", "run/trajectory.csv", "--out", "out"]
        self.good("judge", *command)
        pages = (self.folder / "out" / "report.html").read_bytes()
        self.good("judge", *command)
        self.assertEqual((self.folder / "out" / "report.html").read_bytes(), pages)
        self.assertTrue((self.folder / "out" / "figures" / "errors_against_time.gp").exists())
        self.assertIn("<h3>Scores</h3>", pages.decode())
        text = (self.folder / "run" / "trajectory.csv").read_text(encoding="utf-8")
        (self.folder / "short.csv").write_text("".join(text.splitlines(keepends=True)[:200]), encoding="utf-8")
        self.assertIn("different study", self.refused("--scenario", "peters_hsu", "short.csv", "--out", "out"))

    def test_a_reference_where_nothing_is_known(self):
        self.good("simulate", "--scenario", "kovalevskaya_top", "--integrator", "rk4", "--dt", "0.01", "--t-end", "2",
                  "--samples", "50", "--no-figures", "--reference", "--out", "run")
        self.good("judge", "--scenario", "kovalevskaya_top", "run/trajectory.csv", "--no-figures", "--reference", "--out",
                  "out")
        ours, theirs = only_row(self.folder / "run" / "runs.csv"), only_row(self.folder / "out" / "scores.csv")
        for column in ("attitude_error_max_rad", "kovalevskaya_drift_max_rel"):
            self.assertAlmostEqual(float(theirs[column]), float(ours[column]), delta=1e-6 * float(ours[column]))
        self.assertTrue(theirs["attitude_reference_rad"])

    def first_line_and_score(self, scenario, *arguments):
        done = self.good("judge", "--scenario", scenario, *arguments, "--no-figures", "--force", "--out", "out")
        return done.stdout.splitlines()[0], only_row(self.folder / "out" / "scores.csv")

    def faulty_file(self, scenario, step, rows, fault, **written):
        faulty.write(self.folder / "engine.csv", faulty.motion(faulty.Body(scenario), step, rows, **fault), **written)
        return self.first_line_and_score(scenario, "engine.csv")

    def test_the_first_line_names_the_cause_and_the_way_along_the_polhode(self):
        cases = [({}, {}, "none", "on_time", "engine: sound: energy holds to "),
                 ({"gyroscopic": -1}, {}, "gyroscopic_sign", "backwards", "engine: ω × Iω has the wrong sign (fits "),
                 ({"gyroscopic": 0}, {}, "gyroscopic_absent", "standing", "engine: ω × Iω is left out (fits "),
                 ({}, {"body_axes": True}, "omega_frame", "off", "engine: its angular velocity is in body axes (fits ")]
        for fault, written, cause, pace, start in cases:
            with self.subTest(cause):
                line, score = self.faulty_file("hairer_vilmart", 0.02, 150, fault, **written)
                self.assertTrue(line.startswith(start), line)
                self.assertEqual((score["diagnosis"], score["polhode_pace"]), (cause, pace))
                self.assertGreaterEqual(float(score["diagnosis_factor"] or 10), 10)
                self.assertEqual(bool(re.search("angular momentum (is lost )?by [0-9.]+ %", line)), cause != "none", line)
                self.assertEqual("read rightly, energy holds to" in line, bool(written), line)
                if pace in ("backwards", "standing"):
                    self.assertIn("backwards along its polhode" if pace == "backwards" else "stands still on its polhode", line)
        report = (self.folder / "out" / "report.html").read_text(encoding="utf-8")
        self.assertIn("its angular velocity is in body axes", report)

    def test_early_and_late_along_the_polhode_is_no_fault(self):
        for method, pace in (("dmv", "early"), ("lie_midpoint", "late")):
            with self.subTest(method):
                self.good("simulate", "--scenario", "hairer_vilmart", "--integrator", method, "--dt", "0.1",
                          "--no-figures", "--out", method)
                line, score = self.first_line_and_score("hairer_vilmart", f"{method}/trajectory.csv")
                self.assertEqual((score["diagnosis"], score["polhode_pace"]), ("none", pace))
                self.assertRegex(line, rf"it is {pace} along its polhode by 0\.\d+ s at the end")

    def test_a_cause_where_no_exact_motion_is_known(self):
        self.good("simulate", "--scenario", "kovalevskaya_top", "--integrator", "rk4", "--dt", "0.02", "--t-end", "4",
                  "--gyroscopic", "off", "--no-figures", "--out", "run")
        line, score = self.first_line_and_score("kovalevskaya_top", "run/trajectory.csv")
        self.assertEqual(score["diagnosis"], "gyroscopic_absent", line)
        self.assertIn("--reference measures the errors", line)

    def test_another_start_and_what_cannot_be_tried(self):
        rows = faulty.motion(faulty.Body("hairer_vilmart"), 0.02, 150)
        turned = [(t, faulty.product([0.8, 0.6, 0, 0], q), faulty.to_world([0.8, 0.6, 0, 0], w)) for t, q, w in rows]
        faulty.write(self.folder / "turned.csv", turned)
        line, score = self.first_line_and_score("hairer_vilmart", "turned.csv")
        self.assertEqual(score["diagnosis"], "start", line)
        self.assertIn("follows the scenario's equations from there", line)
        text = (self.folder / "turned.csv").read_text(encoding="utf-8").replace("_rad_per_s", "")
        (self.folder / "attitude.csv").write_text(text, encoding="utf-8")
        line, score = self.first_line_and_score("hairer_vilmart", "attitude.csv")
        self.assertEqual(score["diagnosis"], "")
        self.assertIn("without angular velocity or momentum no reading can be tried", line)

    def test_half_the_inertia_in_its_own_momentum_and_energy(self):
        self.good("simulate", "--scenario", "hairer_vilmart", "--integrator", "rk4", "--dt", "0.02", "--t-end", "4",
                  "--no-figures", "--out", "run")
        with open(self.folder / "run" / "trajectory.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        for columns in (["lx_kg_m2_per_s", "ly_kg_m2_per_s", "lz_kg_m2_per_s"], ["energy_J"]):
            with self.subTest(columns[0]):
                with open(self.folder / "half.csv", "w", newline="", encoding="utf-8") as file:
                    writer = csv.DictWriter(file, list(rows[0]))
                    writer.writeheader()
                    writer.writerows({**row, **{c: float(row[c]) / 2 for c in columns}} for row in rows)
                line, score = self.first_line_and_score("hairer_vilmart", "half.csv")
                self.assertEqual(score["diagnosis"], "inertia", line)
                self.assertIn("is that of 0.5 times the scenario's inertia", line)

    def test_what_is_refused(self):
        (self.folder / "bad.csv").write_text("t_s,qw,qx,qy,qz\n0,1,0,0,0\n1,x,0,0,0\n", encoding="utf-8")
        self.assertIn("bad.csv:3:3: qw is 'x'", self.refused("--scenario", "peters_hsu", "bad.csv", "--out", "out"))
        self.assertIn("no such file", self.refused("--scenario", "peters_hsu", "none.csv", "--out", "out"))
        self.assertIn("--scenario is missing", self.refused("bad.csv"))
        self.assertIn("no trajectory", self.refused("--scenario", "peters_hsu"))
        self.assertIn("named twice", self.refused("--scenario", "peters_hsu", "bad.csv", "bad.csv"))
        self.assertIn("is a folder", self.refused("--scenario", "peters_hsu", "."))
        self.assertIn("peters", self.refused("--scenario", "peters_hs", "bad.csv"))
        self.assertIn("--help", self.refused("--nonsense"))

    def test_a_file_without_an_end(self):
        with open(self.folder / "nothing.csv", "wb") as file:
            file.truncate(1 << 40)  # zeros that take no room
        with open(self.folder / "row.csv", "wb") as file:
            file.write(b"t_s,qw,qx,qy,qz\n0,1,0,0,0\n1" + b",1" * (1 << 20))
        for name, complaint in (("/dev/zero", "/dev/zero: byte 1 is zero"), ("nothing.csv", "nothing.csv: byte 1 is zero"),
                                ("row.csv", "row.csv:3:")):
            with self.subTest(name):
                self.assertIn(complaint, self.refused("--scenario", "peters_hsu", name, "--out", "out"))


if __name__ == "__main__":
    unittest.main()
