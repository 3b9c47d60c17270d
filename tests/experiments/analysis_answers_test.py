# SPDX-License-Identifier: BSD-3-Clause
"""The answers of experiments with an analysis of their own, counted again from their files."""
import re
import unittest

from answer_test import answer
from programs import call, read, temporary_folder


class AnalysisAnswers(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def study(self, program, *arguments, rows):
        call(program, *arguments, "--no-figures", "--out", "out", folder=self.folder)
        sentences = answer((self.folder / "out/report.html").read_text(encoding="utf-8"))
        self.assertTrue(1 <= len(sentences) <= 3, sentences)
        return sentences, read(self.folder / "out" / rows)

    def same(self, said, value):
        self.assertAlmostEqual(float(said), value, delta=0.006 * abs(value))

    def test_the_highest_stacks_that_stand(self):
        sentences, rows = self.study("stack", "--response", "single_impulse,sequential_impulses", "--dt", "0.0166666666666667,0.0333333333333333",
                                     "--vary", "body.box.repeat=[1,1,2];[1,1,3];[1,1,6]", "--t-end", "4", rows="standing.csv")
        highest = {}
        for row in sorted(rows, key=lambda row: int(row["boxes"])):
            curve = highest.setdefault((row["response"], row["step_s_or_tolerance"]), [0, False])
            curve[1] = curve[1] or bool(row["left_place_s"])
            if not curve[1]:
                curve[0] = int(row["boxes"])
        for response in ("single_impulse", "sequential_impulses"):
            best = max(boxes for (name, _), (boxes, _) in highest.items() if name == response)
            self.assertIn(f"{response} up to {best} boxes" if best else f"{response} none", sentences[0])
            self.assertEqual(f"{response} up to {best} boxes (h = 0.0167 s, the highest that was tried)" in sentences[0]
                             or f"{response} up to {best} boxes (h = 0.0333 s, the highest that was tried)" in sentences[0], best == 6)

    def test_a_stack_above_one_that_falls_does_not_count(self):
        sentences, rows = self.study("stack", "--response", "single_impulse", "--dt", "0.0333333333333333", "--vary",
                                     "body.box.repeat=[1,1,2];[1,1,3];[1,1,5]", "--t-end", "60", rows="standing.csv")
        fallen = {int(row["boxes"]): bool(row["left_place_s"]) for row in rows}  # that of 3, and not that of 5
        expected = 0 if fallen[2] else 2 if fallen[3] else 3 if fallen[5] else 5
        self.assertIn(f"single_impulse up to {expected} boxes (h = 0.0333 s" if expected else "single_impulse none", sentences[0])

    def test_the_largest_rise_and_depth_of_piles(self):
        sentences, rows = self.study("pile", "--scenario", "pile_10", "--dt", "0.0166666666666667,0.00833333333333333", "--t-end", "2", rows="piles.csv")
        self.assertIn("In a pile of 10 bodies", sentences[0])
        self.same(re.search(r"by more than (\S+) %", sentences[0])[1], 100 * max(float(row["energy_rise_max_rel"]) for row in rows))
        self.same(re.search(r"at most (\S+) m deep", sentences[1])[1], max(float(row["penetration_max_m"]) for row in rows))

    def test_the_ranges_of_errors_of_impacts(self):
        sentences, rows = self.study("impact", rows="impacts.csv")
        for sentence, column in zip(sentences, ("event_time_error_s", "energy_error_rel")):
            ranges = re.findall(r"by (\S+)(?: s)? \((\w+)\) to (\S+)(?: s)? \((\w+)\) with (\w+)", sentence)
            self.assertEqual(len(ranges), 3, sentence)
            for low, best, high, worst, timing in ranges:
                smallest = {}
                for row in rows:
                    key = (row["motion"], row["integrator"], row["response"])
                    if row["impact_timing"] == timing and (key not in smallest or float(row["dt_s"]) < float(smallest[key]["dt_s"])):
                        smallest[key] = row
                errors = sorted((float(row[column]), row["integrator"]) for row in smallest.values() if row[column])
                self.same(low, errors[0][0])
                self.same(high, errors[-1][0])
                self.assertIn(best, [method for error, method in errors if error == errors[0][0]])
                self.assertIn(worst, [method for error, method in errors if error == errors[-1][0]])

    def test_the_methods_that_follow_the_motion_at_the_largest_steps(self):
        sentences, rows = self.study("stability", "--scenario", "oscillator", "--integrator", "rk4,gauss4,semi_implicit_euler,explicit_euler",
                                     "--dt", "0.02:10:16:log", rows="critical_steps.csv")
        found = re.fullmatch(r"On oscillator the motion is followed up to h\|ω\| (\S+) by (.*); next is (\S+) \((\S+)\)\.", sentences[0])
        limits = sorted(((float(row["largest_following_step_s"]) * float(row["characteristic_rate_rad_per_s"]), row["integrator"])
                         for row in rows), reverse=True)
        self.assertEqual((found[2], found[3]), (limits[0][1], limits[1][1]), sentences)
        self.same(found[1], limits[0][0])
        self.same(found[4], limits[1][0])

    def test_the_steps_at_which_rounding_takes_over(self):
        sentences, rows = self.study("precision", "--integrator", "rk4,explicit_midpoint", "--dt", "0.125,0.0625,0.03125,0.015625,0.0078125",
                                     "--t-end", "32", rows="rounding.csv")
        own = [row for row in rows if row["precision"] == "float" and row["summation"] == "plain" and row["error_of"] == "attitude_error_max_rad"]
        reached = [row for row in own if row["rounding_takes_over_at"]]
        self.assertTrue(reached, "the study is too short to test anything")
        found = re.match(r"In float rounding takes over from dt = (\S+?)(?: to (\S+))? s down, with (\d+) of (\d+) methods and motions; "
                         r"the least attitude error of these is (\S+) rad, with (\S+) at ", sentences[0])
        steps = [float(row["rounding_takes_over_at"]) for row in reached]
        self.same(found[1], min(steps))
        self.same(found[2] or found[1], max(steps))
        self.assertEqual((int(found[3]), int(found[4])), (len(reached), len(own)))
        least = min(reached, key=lambda row: float(row["least_error"]))
        self.same(found[5], float(least["least_error"]))
        self.assertEqual(found[6], least["integrator"])

    def test_the_methods_that_converge_as_declared(self):
        sentences, rows = self.study("convergence", "--scenario", "free_symmetric_top", "--integrator",
                                     "heun,rk4,lie_midpoint,odeint_dopri5,explicit_euler", rows="orders.csv")
        good, bad, steps = set(), set(), set()
        for row in rows:
            if row["against"] == "step":
                steps.add(row["integrator"])
                if row["verdict"] in ("as declared", "exact here"):
                    good.add(row["integrator"])
                if row["verdict"] in ("higher", "lower"):
                    bad.add(row["integrator"])
        self.assertTrue(sentences[0].startswith(f"{len(good - bad)} of {len(steps)} methods with a declared order converge"), sentences)

    def test_the_declared_traits_that_hold(self):
        sentences, rows = self.study("certificate", "--integrator", "rk4,lie_midpoint", "--orientation", "quaternion", rows="certificate.csv")
        holds = sum(row["verdict"] == "holds" for row in rows)
        declared = holds + sum(row["verdict"] == "does not hold" for row in rows)
        self.assertTrue(sentences[0].startswith(f"{holds} of {declared} declared traits of 2 methods"), sentences)


if __name__ == "__main__":
    unittest.main()
