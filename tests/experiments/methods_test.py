# SPDX-License-Identifier: BSD-3-Clause
"""The experiment `methods`: its costs against its runs, its claims against its costs, and what becomes of them without
the method that wins."""
import math
import pathlib
import re
import tomllib
import unittest

import recounted_methods
from programs import call, read, temporary_folder

MOTIONS = "hairer_vilmart,detest_b5,free_symmetric_top,tumbling_cube,pyramid"
METHODS = ["explicit_midpoint", "rk4", "lie_midpoint", "dmv4", "exact_rotor", "odeint_dopri5"]
FEW = ["--scenario", MOTIONS, "--angular-state", "velocity_body,velocity_world", "--orientation", "quaternion"]


class Methods(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out, cls.without = cls.folder / "out", cls.folder / "without"
        cls.printed = call("methods", *FEW, "--integrator", ",".join(METHODS), "--out", cls.out, folder=cls.folder).stdout
        cls.rows = read(cls.out / "costs.csv")
        cls.costs = recounted_methods.Costs(cls.rows)
        ranked = read(cls.out / "recommended.csv")
        cls.winner = next(r for r in ranked if r["group"] == "free_tops" and r["error_at_most"] == "1e-6")["method"]
        others = ",".join(m for m in METHODS if m != cls.winner)
        call("methods", *FEW, "--integrator", others, "--out", cls.without, folder=cls.folder)

    def test_costs_are_read_off_the_runs(self):
        """Free tops, whose error is the attitude's: the definition, from the rows of runs.csv."""
        runs = [r for r in read(self.out / "runs.csv") if r["scenario"] == "hairer_vilmart"
                and r["dt_s"] not in ("", "0.125")]  # that step names the method, and is of no ladder
        checked = 0
        for row in self.rows:
            if row["motion"] != "hairer_vilmart" or row["adaptive"] == "yes":
                continue
            state = row["formulation"].split(", ")[1]
            points = sorted(((int(r["rhs_evaluations"]), float(r["attitude_error_max_rad"])) for r in runs
                             if (r["integrator"], r["angular_state"]) == (row["method"], state)
                             and r["status"] == "ok"), reverse=True)
            followed = []
            for cost, error in points:
                if error >= 1:
                    break
                followed.append((cost, error))
            followed.reverse()
            turns = 10 / float(row["characteristic_time_s"])
            for name in recounted_methods.ERRORS:
                asked, printed, expected = float(name), row[f"rhs_per_time_to_{name}"], None
                for k, (cost, error) in enumerate(followed):
                    if error <= asked:
                        expected = cost
                        if k > 0:
                            before, was = followed[k - 1]
                            part = math.log(was / asked) / math.log(was / max(error, 1e-17))
                            expected = before * (cost / before) ** part
                        break
                if expected is None:
                    self.assertEqual(printed, "", row)
                else:
                    self.assertAlmostEqual(float(printed) * turns, expected, delta=1e-5 * expected)
                    checked += 1
        self.assertGreater(checked, 40)

    def test_no_task_is_solved_beyond_the_budget(self):
        for row in self.rows:
            for error in recounted_methods.ERRORS:
                self.assertLessEqual(float(row[f"rhs_per_time_to_{error}"] or 0), 20000, row)

    def test_the_exact_method_is_named_and_does_not_compete(self):
        exact = {r["method"] for r in self.rows if r["group"] == "free_tops" and r["is_exact"] == "yes"}
        self.assertIn("exact_rotor", exact)
        self.assertNotIn("exact_rotor", {r["method"] for r in read(self.out / "recommended.csv") if r["group"] == "free_tops"})
        self.assertRegex((self.out / "methods.md").read_text(encoding="utf-8"),
                         r"Exact at every step, and so outside the comparison: [^.]*exact_rotor")

    def test_recommendations_follow_from_the_costs(self):
        recounted_methods.check_recommended(self, self.costs, read(self.out / "recommended.csv"))

    def test_regrets_follow_from_the_costs(self):
        recounted_methods.check_regrets(self, self.costs, read(self.out / "regret.csv"))

    def test_pairs_follow_from_the_costs(self):
        pairs = read(self.out / "pairs.csv")
        self.assertGreater(len(pairs), 10)
        recounted_methods.check_pairs(self, self.costs, pairs)

    def test_the_answer_says_how_far_it_holds(self):
        text = (self.out / "methods.md").read_text(encoding="utf-8")
        ratios = [r[4] for r in self.costs.regrets()]
        found = re.search(r"costs at most ([0-9.e]+) times the least cost in half of (\d+) tasks", text)
        self.assertIsNotNone(found, text[:800])
        self.assertAlmostEqual(float(found[1]), recounted_methods.quantile(ratios, 0.5), delta=0.006 * float(found[1]))
        self.assertEqual(int(found[2]), len(ratios))
        best = self.costs.ranking(self.costs.motions["free_tops"], ["1e-6"])[0][2]
        self.assertRegex(text, rf"[Aa]n error of 1e-6 is reached at the least cost by (?:[^.]*; )?{best[0]} for free tops")

    def test_without_the_winner_the_costs_and_pairs_of_the_others_stay(self):
        def rows(out, name, methods):
            return [r for r in read(out / name) if all(r[m] != self.winner for m in methods)]
        self.assertEqual(rows(self.out, "costs.csv", ["method"]), read(self.without / "costs.csv"))
        self.assertEqual(rows(self.out, "pairs.csv", ["first_method", "second_method"]), read(self.without / "pairs.csv"))

    def test_titles_of_groups_are_translated(self):
        root = pathlib.Path(__file__).resolve().parents[2] / "experiments"
        titles = set(re.findall(r'"([A-Z][a-z ]+)",\s*Measure', (root / "methods/groups.cpp").read_text(encoding="utf-8")))
        self.assertGreaterEqual(len(titles), 9)
        for language in sorted((root / "study/plot/languages").glob("*.toml")):
            self.assertLessEqual(titles, set(tomllib.loads(language.read_text(encoding="utf-8"))), language.name)

    def test_the_same_study_again_has_the_same_bytes(self):
        before = {n: (self.out / n).read_bytes() for n in ("costs.csv", "pairs.csv", "regret.csv", "methods.md")}
        call("methods", *FEW, "--integrator", ",".join(METHODS), "--out", self.out, folder=self.folder)
        for name, text in before.items():
            self.assertEqual((self.out / name).read_bytes(), text, name)

    def test_figures_and_page(self):
        page = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertIn('id="answer"', page)
        for name in ("solved_against_budget", "profiles_of_two"):
            self.assertTrue((self.out / "figures" / f"{name}.svg").exists(), name)


if __name__ == "__main__":
    unittest.main()
