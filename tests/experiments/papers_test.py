# SPDX-License-Identifier: BSD-3-Clause
"""Every paper that does not take long: its study runs, and each number of its expected.csv comes out as given.

POLHODE_BIN_DIR is the folder of the experiments.
"""
import math
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import tomllib
import unittest

import mpmath

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import exact_top  # noqa: E402
import paper  # noqa: E402
import paper_claims  # noqa: E402
import paper_quantities  # noqa: E402

BIN = pathlib.Path(os.environ.get("POLHODE_BIN_DIR", "."))
HEAVY = ("andrews_squeezer", "engine_joints", "iftomm_benchmarks", "impact_orders")  # papers_slow_test.py runs them
NAMES = sorted(p.parent.name for p in ROOT.glob("papers/*/study.toml"))


class Papers(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="polhode_paper_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def run_paper(self, paper, status):
        done = subprocess.run(["/usr/bin/python3", "-B", str(ROOT / "scripts/paper.py"), str(BIN), str(paper), "--out",
                               str(self.folder / "out"), "--no-figures"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def changed(self, old, new, file="expected.csv", name="detest_b5"):
        paper = self.folder / name
        shutil.copytree(ROOT / "papers" / name, paper)
        text = (paper / file).read_text(encoding="utf-8")
        self.assertIn(old, text)
        (paper / file).write_text(text.replace(old, new, 1), encoding="utf-8")
        return paper

    def run_papers(self, *options, papers=ROOT / "papers", status=0):
        done = subprocess.run(["/usr/bin/python3", "-B", str(ROOT / "scripts/papers.py"), str(BIN), str(papers), "--out",
                               str(self.folder / "all"), "--no-figures", *map(str, options)], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def test_each_light_one_is_reproduced(self):
        light = [name for name in NAMES if name not in HEAVY]
        self.assertGreaterEqual(len(light), 10)
        done = self.run_papers("--only", ",".join(light))
        self.assertEqual([line.split()[0] for line in done.stdout.splitlines()[1:]], light)

    def test_each_readme_has_the_number_of_numbers(self):
        for name in NAMES:
            judged = sum(row["kind"] != "measured" for row in paper.table(ROOT / "papers" / name / "expected.csv"))
            self.assertIn(f"{judged} of {judged}", (ROOT / "papers" / name / "README.md").read_text(encoding="utf-8"))

    def test_a_number_that_is_not_reproduced_is_told(self):
        done = self.run_paper(self.changed("-0.93965707987292", "-0.93965707997292"), 3)
        self.assertIn("11 of 12 numbers as given", done.stdout)

    def test_a_row_that_picks_no_run_is_bad_input(self):
        self.assertIn("picks 0 rows of runs.csv", self.run_paper(self.changed("rkmk4,1e-3", "rkmk4,1e-4"), 2).stderr)

    def test_a_value_that_is_no_number_is_bad_input(self):
        done = self.run_paper(self.changed("-0.93965707987292", "much"), 2)
        self.assertIn("expected.csv, row 2: value must be a number", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_a_bound_from_below_counts(self):
        done = self.run_paper(self.changed("-0.93965707987292,1e-10,absolute", "-0.9,0,at_least"), 3)
        self.assertIn("at least -0.9", done.stdout)
        self.assertIn("11 of 12 numbers as given", done.stdout)

    def test_an_experiment_that_is_not_there_is_bad_input(self):
        done = self.run_paper(self.changed("\node,small_steps,", "\node,small_step,", name="simbenchmark_bouncing"), 2)
        self.assertIn("row 2: experiments.toml has no small_step", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_what_an_experiment_refuses_is_passed_on(self):
        self.run_paper(self.changed("--dt 1e-3", "--dt -1", "experiments.toml", "simbenchmark_bouncing"), 2)

    def test_a_quantity_of_the_motion_needs_the_motion(self):
        paper = self.changed("1e-3,,,,,,,angular_momentum_drift_max_rel,", "1e-3,,,,,,,impacts,", name="course_report")
        done = self.run_paper(paper, 2)
        self.assertIn("events.csv: No such file or directory; add --trajectory csv", done.stderr)

    def test_a_paper_names_the_experiments_that_it_needs(self):
        done = subprocess.run(["/usr/bin/python3", "-B", str(ROOT / "scripts/paper.py"), str(BIN),
                               str(ROOT / "papers/course_report"), "--programs"], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.split(), ["energy_drift", "narrow_phase"])

    def test_what_the_study_refuses_is_passed_on(self):
        self.run_paper(self.changed("dt = [1e-3", "dt = [-1e-3", "study.toml"), 2)

    def copies_of_b5(self, *names):
        """A folder of papers that are all detest_b5."""
        papers = self.folder / "papers"
        claims = ["paper,claim,says,numbers"]
        for name in names:
            shutil.copytree(ROOT / "papers/detest_b5", papers / name)
            claims += [f"{name},solution,y,", f"{name},period,T,7.45056320933095"]
        (papers / "claims.csv").write_text("\n".join(claims) + "\n", encoding="utf-8")
        return papers

    def test_a_paper_that_fails_does_not_stop_the_others(self):
        papers = self.copies_of_b5("b5_broken", "b5_whole")
        study = papers / "b5_broken/study.toml"
        study.write_text(study.read_text(encoding="utf-8").replace("dt = [1e-3", "dt = [-1e-3"), encoding="utf-8")
        done = self.run_papers("--index", self.folder / "index.md", papers=papers, status=1)
        self.assertRegex(done.stdout, "b5_broken +– +– +[0-9.]+ s +failed, exit status 2\nb5_whole +as computed +12 of 12 ")
        self.assertFalse((self.folder / "index.md").exists())

    def test_of_all_papers_those_that_stand_are_not_run_again(self):
        papers = self.copies_of_b5("detest_b5")
        self.assertNotIn("stands", self.run_papers(papers=papers).stdout)
        done = self.run_papers(papers=papers)
        self.assertRegex(done.stdout, "detest_b5 +as computed +12 of 12 +– +stands")
        expected = papers / "detest_b5/expected.csv"
        text = expected.read_text(encoding="utf-8")
        expected.write_text(text.replace("-0.93965707987292", "-0.93965707997292", 1), encoding="utf-8")
        done = self.run_papers(papers=papers, status=3)
        self.assertRegex(done.stdout, "detest_b5 +in part +11 of 12 +[0-9.]+ s")
        self.assertIn("detest_b5: not as given:  cvode_adams, tolerance 1e-13 end_body_angular_velocity_1", done.stderr)

    def test_a_call_that_is_stopped_goes_on(self):
        command = ["/usr/bin/python3", "-B", str(ROOT / "scripts/papers.py"), str(BIN), str(ROOT / "papers"), "--out",
                   str(self.folder / "all"), "--no-figures", "--only", "detest_b5,free_cylinder"]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as stopped:
            for line in stopped.stderr:
                if line.startswith("[2/2]"):
                    stopped.send_signal(signal.SIGTERM)
                    break
            said = stopped.stderr.read()
        self.assertEqual(stopped.returncode, 130, said)
        self.assertIn("the same command goes on from here", said)
        done = self.run_papers("--only", "detest_b5,free_cylinder")
        self.assertRegex(done.stdout, "detest_b5 .* stands\nfree_cylinder +as computed +40 of 40 +[0-9.]+ s\n")

    def test_a_folder_of_something_else_is_not_removed(self):
        (self.folder / "all/detest_b5").mkdir(parents=True)
        (self.folder / "all/detest_b5/mine.txt").write_text("mine", encoding="utf-8")
        done = self.run_papers("--only", "detest_b5", status=2)
        self.assertIn("holds other files; give another --out", done.stderr)
        self.assertTrue((self.folder / "all/detest_b5/mine.txt").exists())

    def test_a_paper_that_is_not_there_is_bad_input(self):
        done = self.run_papers("--only", "detest_b6", status=2)
        self.assertIn("no paper is called detest_b6; there are andrews_squeezer", done.stderr)


class Claims(unittest.TestCase):
    """Each number that was given for a claim stands in the expected.csv of its paper."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="polhode_claims_")
        self.addCleanup(holder.cleanup)
        self.papers = pathlib.Path(holder.name)
        shutil.copy(ROOT / "papers/claims.csv", self.papers)
        for name in NAMES:
            (self.papers / name).mkdir()
            for file in ("study.toml", "expected.csv"):
                shutil.copy(ROOT / "papers" / name / file, self.papers / name)

    def change(self, file, old, new):
        text = (self.papers / file).read_text(encoding="utf-8")
        self.assertIn(old, text)
        (self.papers / file).write_text(text.replace(old, new), encoding="utf-8")
        return paper_claims.faults(self.papers)

    def test_all_numbers_stand(self):
        self.assertEqual(paper_claims.faults(self.papers), [])
        claims = [claim for of in paper_claims.all_claims(self.papers).values() for claim in of]
        self.assertGreaterEqual(sum(len(claim["numbers"].split()) for claim in claims), 75)

    def test_a_number_that_is_not_expected_is_told(self):
        self.assertEqual(self.change("dzhanibekov/expected.csv", ",118.110887046386,", ",118.110887046387,"),
                         ["dzhanibekov, period: no row of expected.csv has the number 118.110887046386"])

    def test_a_row_without_a_claim_is_told(self):
        row = "rk4,quaternion,1e-4,axis_3_least"
        self.assertEqual(self.change("simo_wong_1991/expected.csv", f"nutation,{row}", f",{row}"),
                         ["simo_wong_1991/expected.csv, row 14: claims.csv has no claim '' of it"])

    def test_a_claim_without_rows_is_told(self):
        self.assertEqual(self.change("claims.csv", "dzhanibekov,flips", "dzhanibekov,turns,Turns,3\ndzhanibekov,flips"),
                         ["dzhanibekov: no row of expected.csv belongs to the claim turns"])

    def test_a_paper_without_claims_is_told(self):
        found = self.change("claims.csv", "\ndetest_b5,", "\ndetest_b6,")
        self.assertIn("claims.csv: there is no paper detest_b6", found)
        self.assertIn("detest_b5/expected.csv, row 2: claims.csv has no claim 'solution' of it", found)

    def test_verdicts_follow_from_the_rows(self):
        def of(*rows):
            return paper_claims.verdict([{"verdict": v, "source": s} for v, s in rows])
        self.assertEqual(of(("as given", "P table"), ("as given", "C")), ("reproduced", 2, 2))
        self.assertEqual(of(("as given", "C")), ("as computed", 1, 1))
        self.assertEqual(of(("as given", "P"), ("not", "P")), ("in part", 1, 2))
        self.assertEqual(of(("not", "P"), ("not", "C")), ("not reproduced", 0, 2))
        self.assertEqual(of(("measured", "P about 1.5")), ("measured", 0, 0))


class SetUps(unittest.TestCase):
    """The problems are those that the papers state: papers/setups.csv. Its keys are those of scenario files, and three more."""

    def further(self, scene):
        """momentum: J Ω in body axes, where both are principal; tilt: angle of the orientation, rad; m g l, J."""
        body = scene["body"][0]
        values = {"momentum": [j * w for j, w in zip(body.get("inertia", []), body.get("angular_velocity", []))]}
        if "orientation" in body:
            values["tilt"] = 2 * math.acos(body["orientation"][0])
        if "center_of_mass" in body:
            values["weight_times_length"] = -body["mass"] * scene["gravity"][2] * body["center_of_mass"][2]
        return values

    def test_each_number_stands_in_its_scenario(self):
        for row in paper.table(ROOT / "papers/setups.csv"):
            file = ROOT / (row["scenario"] if "/" in row["scenario"] else f"experiments/scenarios/{row['scenario']}.toml")
            scene = tomllib.loads(file.read_text(encoding="utf-8"))
            value = self.further(scene).get(row["key"])
            if value is None:
                value = scene
                for part in row["key"].split("."):
                    value = value[int(part) if part.isdigit() else part]
            wanted = [float(x) for x in row["numbers"].split()]
            with self.subTest(**row):
                self.assertEqual(len(wanted), len(value) if isinstance(value, list) else 1)
                for ours, theirs in zip(value if isinstance(value, list) else [value], wanted):
                    self.assertAlmostEqual(ours, theirs, delta=1e-14)


class ExactEnds(unittest.TestCase):
    """The values that were computed for these papers follow from a Taylor series at 30 digits."""

    def check(self, name, of, moments, momentum, quantities):
        end = exact_top.free_top(moments, [mpmath.mpf(y) / mpmath.mpf(j) for y, j in zip(momentum, moments)])(10)
        values = {f"end_body_angular_velocity_{k + 1}": end[k] for k in range(3)}
        values |= {f"end_body_angular_momentum_{k + 1}": mpmath.mpf(moments[k]) * end[k] for k in range(3)}
        values |= {f"end_q{axis}": end[3 + k] for k, axis in enumerate("wxyz")}
        rows = [row for row in paper.table(ROOT / "papers" / name / "expected.csv")
                if (row.get("of") or "") == of and row["quantity"] in values]
        self.assertEqual({row["quantity"] for row in rows}, set(quantities))
        for row in rows:
            self.assertLess(abs(mpmath.mpf(row["value"]) - values[row["quantity"]]), 1e-15, row)

    def test_flat_body(self):
        self.check("hairer_vilmart_2006", "flat_end_point", ("0.345", "0.653", "1.0"), ("1.8", "0.4", "-0.9"),
                   [f"end_body_angular_momentum_{k}" for k in "123"] + [f"end_q{k}" for k in "wxyz"])

    def test_free_cylinder(self):
        self.check("free_cylinder", "", ("0.04", "0.04", "0.02"), ("0.08", "0.16", "0.12"),
                   [f"end_body_angular_velocity_{k}" for k in "123"] + [f"end_q{k}" for k in "wxyz"])


class Motions(unittest.TestCase):
    """Times of flips and extremes, from known motions."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="polhode_motion_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def write(self, rows):
        """A trajectory of (t, q, momentum)."""
        names = ["t_s", "body", "qw", "qx", "qy", "qz", "lx_kg_m2_per_s", "ly_kg_m2_per_s", "lz_kg_m2_per_s"]
        lines = [",".join(names)] + [",".join(map(repr, (t, 0, *q, *momentum))) for t, q, momentum in rows]
        (self.folder / "trajectory.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")

    def quantity(self, name):
        return paper_quantities.of(name, self.folder, "0", None)[name]

    def test_period_and_flips(self):
        self.write([(0.05 * k, (1.0, 0.0, 0.0, 0.0), (0.0, math.cos(0.05 * k * 1.7), 1.0)) for k in range(301)])
        self.assertEqual(self.quantity("flips_2"), 8)
        self.assertAlmostEqual(self.quantity("period_2_s"), 2 * math.pi / 1.7, delta=1e-10)
        self.assertAlmostEqual(self.quantity("flip_interval_least_2_s"), math.pi / 1.7, delta=1e-9)
        self.assertAlmostEqual(self.quantity("flip_interval_largest_2_s"), math.pi / 1.7, delta=1e-9)

    def test_a_motion_without_flips_has_no_period(self):
        self.write([(0.1 * k, (1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 1.0)) for k in range(30)])
        self.assertEqual(paper_quantities.of("period_2_s", self.folder, "0", None), {"flips_2": 0})

    def test_nutation(self):
        tilts = [0.2 + 0.1 * math.cos(3 * 0.02 * k) for k in range(500)]
        self.write([(0.02 * k, (math.cos(a / 2), math.sin(a / 2), 0.0, 0.0), (0.0, 0.0, 1.0)) for k, a in enumerate(tilts)])
        self.assertAlmostEqual(self.quantity("axis_3_least"), math.cos(0.3), delta=1e-9)
        self.assertAlmostEqual(self.quantity("axis_3_largest"), math.cos(0.1), delta=1e-9)


if __name__ == "__main__":
    unittest.main()
