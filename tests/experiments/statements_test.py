# SPDX-License-Identifier: BSD-3-Clause
"""Every statement of the pages of default studies, counted again from runs.csv and the files of the analyses."""
import re
import unittest

from programs import call, read, temporary_folder
from statements import Recount, Wrong, expect, names, number, statements


def close(said, found):
    return abs(float(said) - found) <= 0.006 * abs(found)


def some(text, found, what):
    Recount([]).some(text, set(found), what)


class OfConvergence:
    def __init__(self, folder):
        self.rows = read(folder / "orders.csv")

    def place(self, row):
        several = {r["error_of"] for r in self.rows if r["scenario"] == row["scenario"]} != {"attitude_error_max_rad"}
        return row["scenario"] + (", position" if several and row["error_of"] == "position_error_max_m" else "")

    def agree(self, against, n, of, listed):
        good, bad, all_methods = set(), set(), set()
        for row in self.rows:
            if row["against"] != against:
                continue
            all_methods.add(row["integrator"])
            (good if row["verdict"] in ("as declared", "exact here") else bad if row["verdict"] in ("higher", "lower") else set()).add(row["integrator"])
        expect((int(n), int(of)) == (len(good - bad), len(all_methods)), f"{n} of {of}: {len(good - bad)} of {len(all_methods)}")
        expect(set(names(listed)) == good - bad, listed)

    def listed(self, against, verdict, text):
        for method, slope, points in re.findall(r"(\w+) on [^(]*\((\S+) ± \S+ over (\d+) points?", text):
            rows = [r for r in self.rows if r["integrator"] == method and r["against"] == against and r["verdict"] == verdict]
            expect(any(abs(float(slope) - float(r["observed_order"])) < 0.006 and r["points"] == points for r in rows), f"{method} {slope}")

    def exact_here(self, place, methods):
        some(methods, {row["integrator"] for row in self.rows if self.place(row) == place and row["verdict"] == "exact here"}, place)

    def tests(self):
        return [(r"(\d+) of (\d+) methods with a declared order (?:is|are) as declared wherever an order is seen: (.*)\.",
                 lambda *found: self.agree("step", *found)),
                (r"(\d+) of (\d+) methods with a tolerance keeps? the error in proportion to it \(slope 1 to within 0\.25\): (.*)\.",
                 lambda *found: self.agree("tolerance", *found)),
                (r"Higher than declared: (.*)\.", lambda text: self.listed("step", "higher", text)),
                (r"Lower than declared: (.*)\.", lambda text: self.listed("step", "lower", text)),
                (r"The error falls faster than the tolerance: (.*)\.", lambda text: self.listed("tolerance", "higher", text)),
                (r"The error falls more slowly than the tolerance: (.*)\.", lambda text: self.listed("tolerance", "lower", text)),
                (r"At round-off at every step or tolerance on (.*?): (.*)\.", self.exact_here)]


class OfWorkPrecision:
    """The envelope against the runs themselves: a run of the method has that error at that cost or above it, no run a
    smaller cost."""

    def __init__(self, folder):
        self.rows, self.envelope = read(folder / "runs.csv"), read(folder / "envelope.csv")

    def cheapest(self, motion, text):
        decades = 0
        exact = {row["integrator"] for row in self.rows if row["integrator"].startswith("exact_rotor")}
        for method, first, last, bound, cost in re.findall(r"(\w+) at (1e-\d+)(?: to (1e-\d+))? rad \((at most )?(\d+) right-hand sides there\)", text):
            last = last or first
            decades += 1
            row = next(r for r in self.envelope if r["motion"] == motion and r["error_at_most_rad"] == last)
            expect(row["method"] == method and close(cost, float(row["rhs_evaluations"])), f"{method} at {last} on {motion}")
            expect(bool(bound) == (row["is_upper_bound"] == "yes"), f"at most of {method} at {last}")
            for run in self.rows:  # no run that follows the motion reaches it at a lower cost
                if run["scenario"] != motion or run["status"] != "ok" or run["integrator"] in exact or not number(run["rhs_evaluations"]):
                    continue
                if self.follows(run) and self.proven(run) <= float(last):
                    expect(float(run["rhs_evaluations"]) >= 0.994 * float(cost), f"{run['integrator']} beats {method} at {last} on {motion}")
        expect(decades > 0, text)

    def below(self, run):
        """The runs of the method at this step or tolerance, and at smaller ones."""
        column = "dt_s" if run["dt_s"] else "tolerance"
        return [r for r in self.rows if r["scenario"] == run["scenario"] and r["integrator"] == run["integrator"]
                and number(r[column]) <= number(run[column])]

    def follows(self, run):
        return all(r["status"] == "ok" and number(r["attitude_error_max_rad"]) < 1 for r in self.below(run))

    def proven(self, run):
        """An error that is smaller than those at smaller steps is rounding, and counts as the largest of these."""
        return max(number(r["attitude_error_max_rad"]) for r in self.below(run))

    def exact(self, methods, motions):
        for row in self.rows:
            if row["integrator"] in names(methods) and row["scenario"] in names(motions) and row["status"] == "ok":
                expect(number(row["attitude_error_max_rad"]) < 1e-8, f"{row['integrator']} on {row['scenario']}")

    def tests(self):
        return [(r"Cheapest by right-hand sides on (\S+), from the largest error down: (.*)\.", self.cheapest),
                (r"(.*) (?:is|are) exact on (.*): no approximation competes, so the envelope is that of the others\.", self.exact)]


class OfImpact:
    def __init__(self, folder):
        self.rows = read(folder / "impacts.csv")

    def smallest(self, motion, timing, text_of_time, text_of_energy):
        rows = [r for r in self.rows if r["motion"] == motion and r["impact_timing"] == timing]
        for text, column in ((text_of_time, "event_time_error_s"), (text_of_energy, "energy_error_rel")):
            for method, said in re.findall(r"(\w+) (\d\S*?)(?: s)?(?: \(order \S+\))?(?:, | and | of it|$)", text):
                own = [r for r in rows if r["integrator"] == method]
                least = min(float(r["dt_s"]) for r in own)
                errors = [float(r[column]) for r in own if float(r["dt_s"]) == least and r[column]]
                expect(any(close(said, e) or e == float(said) for e in errors), f"{method} {said}: {errors}")

    def momentum(self, motion, linear, angular):
        rows = [r for r in self.rows if r["motion"] == motion]
        for said, column in ((linear, "linear_momentum_error_rel"), (angular, "angular_momentum_error_rel")):
            if said is not None:
                most = max(float(r[column]) for r in rows if r[column])
                expect(close(said, most) or float(said) == most, f"{column} {said}: {most}")

    def responses(self, motion, said, one, method, timing, other):
        energy = {(r["integrator"], r["impact_timing"], r["dt_s"], r["response"]): float(r["energy_error_rel"]) for r in self.rows
                  if r["motion"] == motion and r["energy_error_rel"]}
        expect(any(key[:2] == (method, timing) and key[3] == one for key in energy), f"{one} of {method}")
        expect(any(key[3] == other for key in energy), other)
        expect(float(said) <= 2.01 * max(energy.values()), said)

    def tests(self):
        return [(r"On (\S+) with (\S+), at the smallest step, the first impact is wrong by (.*?)(?:; and the energy by (.*) of it)?\.",
                 lambda motion, timing, time, energy: self.smallest(motion, timing, time, energy or "")),
                (r"On (\S+) the momentum is off by at most (\S+?),? and the angular momentum by (\S+), by whatever method, timing and response\.",
                 self.momentum),
                (r"On (\S+) responses differ in the energy by (\S+) of it at most: (\S+) \((\S+), (\S+)\) from (\S+)\.", self.responses)]


class Statements(unittest.TestCase):
    def check(self, program, *arguments, of=None):
        folder = temporary_folder(self.addCleanup)
        call(program, *arguments, "--no-figures", "--out", "out", folder=folder, status=self.status)
        recount = Recount(read(folder / "out/runs.csv"), of(folder / "out").tests() if of else ())
        said = statements((folder / "out/report.html").read_text(encoding="utf-8"))
        self.assertTrue(said)
        wrong = []
        for sentence in said:
            try:
                recount.check(sentence)
            except Wrong as fault:
                wrong.append(f"{fault} << {sentence[:300]}")
        self.assertEqual(wrong, [])
        return recount.counted

    status = 0

    def test_energy_drift(self):
        self.assertGreaterEqual(self.check("energy_drift")["at a step"], 15)

    def test_simulate(self):
        self.check("simulate")

    def test_convergence(self):
        self.assertGreaterEqual(self.check("convergence", of=OfConvergence)["analysis"], 4)

    def test_work_precision(self):
        self.status = 3  # a run of dmv has no solution
        self.assertGreaterEqual(self.check("work_precision", of=OfWorkPrecision)["analysis"], 3)

    def test_impact(self):
        self.assertGreaterEqual(self.check("impact", of=OfImpact)["analysis"], 4)

    def test_a_gyroscopic_term_left_out(self):
        counted = self.check("energy_drift", "--gyroscopic", "off", "--integrator", "rk4,heun", "--dt", "0.01,0.005,0.0025")
        self.assertGreaterEqual(counted["at a step"], 3)

    def test_several_motions(self):
        counted = self.check("energy_drift", "--scenario", "oscillator,projectile,physical_pendulum,free_symmetric_top,spring_box", "--integrator",
                             "explicit_euler,rk4,lie_midpoint", "--dt", "0.1,0.05,0.02,0.01", "--t-end", "3")
        self.assertGreaterEqual(counted["class"], 1)

    def test_diverged_runs(self):
        counted = self.check("energy_drift", "--scenario", "oscillator", "--integrator", "explicit_euler", "--dt", "30,20", "--t-end", "3000")
        self.assertEqual(counted["diverged"], 1)


if __name__ == "__main__":
    unittest.main()
