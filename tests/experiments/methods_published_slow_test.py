# SPDX-License-Identifier: BSD-3-Clause
"""The published comparison of methods: every number of its tables and every claim of its page is counted again from its
costs.csv, apart from the program that wrote it."""
import math
import pathlib
import re
import unittest

import recounted_methods
from programs import read

PAPER = pathlib.Path(__file__).resolve().parents[2] / "papers/methods_compared"
NAMES = {"Free tops": "free_tops", "Fast tops": "fast_tops", "Other heavy tops": "heavy_tops", "Translation": "translation",
         "Bodies on springs": "springs", "Impacts": "impacts", "Stacks": "stacks"}


def close(printed, value, relative=0.006):
    return math.isclose(float(printed), value, rel_tol=relative)


class Published(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.costs = recounted_methods.Costs(read(PAPER / "costs.csv"))
        cls.page = (PAPER / "README.md").read_text(encoding="utf-8").replace("\\_", "_")
        cls.claims = re.findall(r"^- (.*)$", cls.page, re.M)

    def test_all_methods_groups_and_formulations_are_in_it(self):
        self.assertEqual(set(self.costs.motions), set(NAMES.values()))
        self.assertGreaterEqual(len({m for m, _ in self.costs.contenders}), 45)
        self.assertEqual({f.rsplit(", ", 1)[0] if f.count(", ") == 2 else f for _, f in self.costs.contenders},
                         {f"{o}, {a}" for o in ("quaternion", "matrix")
                          for a in ("velocity_world", "velocity_body", "momentum_world")})

    def test_regrets(self):
        recounted_methods.check_regrets(self, self.costs, read(PAPER / "regret.csv"))

    def test_recommendations_hold_on_motions_that_they_were_not_chosen_for(self):
        """What the method costs that the other motions of a group recommend, over the least cost on the one left out."""
        ratios = [r[4] for r in self.costs.regrets()]
        self.assertGreater(len(ratios), 300)
        self.assertLessEqual(recounted_methods.quantile(ratios, 0.5), 1.3)
        self.assertLessEqual(recounted_methods.quantile(ratios, 0.9), 2)

    def test_every_claim_of_the_page(self):
        known = (self.winners, self.held_out, self.exact_ones, self.duel, self.changes)
        prose = ("Costs are right-hand sides", "The error is the largest", "A recommendation is", "A group holds few", "A task is a motion", "The cost over the least cost")  # how it was done, without results
        counted = 0
        for claim in self.claims:
            if claim.startswith(prose):
                continue
            with self.subTest(claim):
                self.assertTrue(any(check(claim) for check in known), "a claim that no rule recounts")
                counted += 1
        self.assertGreaterEqual(counted, 8)

    def best_overall(self, group):
        """The best contender of each method by its own costs, ranked among each other."""
        motions, errors = self.costs.motions[group], recounted_methods.ERRORS
        chosen = []
        for method in dict.fromkeys(m for m, _ in self.costs.contenders):
            own = self.costs.ranking(motions, errors, lambda c, method=method: c[0] == method)
            chosen += [c for s, r, c in own if own and s == own[0][0] and abs(r - own[0][1]) < 1e-5]
        return self.costs.ranking(motions, errors, lambda c: c in chosen)

    @staticmethod
    def contender(text):
        method, formulation = re.fullmatch(r"(\S+) \((.*)\)", text).groups()
        return method, formulation

    def exact_methods(self, group):
        return {m for m, f in self.costs.contenders if all((q, (m, f)) in self.costs.exact for q in self.costs.motions[group])}

    def winners(self, claim):
        found = re.fullmatch(r"(?:Exact methods aside, an|(An)) error of (1e-\d+) is reached at the least cost by "
                             r"(.*)\.", claim)
        if not found:
            return False
        plain, error, listed = found.groups()
        self.assertEqual(bool(plain), not any(self.exact_methods(group) for group in self.costs.motions))
        groups = []
        for part in listed.split("; "):
            method, titles = part.split(" for ", 1)
            for title in re.split(r", | and ", titles):
                group = NAMES[title[0].upper() + title[1:]]
                groups.append(group)
                ranked = self.costs.ranking(self.costs.motions[group], [error])
                tied = {c[0] for s, r, c in ranked if s == ranked[0][0] and abs(r - ranked[0][1]) < 1e-5}
                self.assertIn(method, tied or {"no method"})
        self.assertEqual(sorted(groups), sorted(NAMES.values()))
        return True

    def held_out(self, claim):
        found = re.fullmatch(
            r"On a motion that it was not chosen for, the recommended method costs at most (\S+) times the least cost in "
            r"half of (\d+) tasks and (?:at most (\S+) times the least cost|(more than the budget)) in nine of ten"
            r"(?:; in (\d+) of them it does not reach the error)?\.", claim)
        if not found:
            return False
        ratios = [r[4] for r in self.costs.regrets()]
        self.assertEqual(int(found[2]), len(ratios))
        self.assertTrue(close(found[1], recounted_methods.quantile(ratios, 0.5)))
        nine = recounted_methods.quantile(ratios, 0.9)
        self.assertTrue(math.isinf(nine) if found[4] else close(found[3], nine), nine)
        self.assertEqual(int(found[5] or 0), sum(math.isinf(r) for r in ratios))
        return True

    def exact_ones(self, claim):
        found = re.fullmatch(r"Exact at every step, and so outside the comparison: (.*)\.", claim)
        if not found:
            return False
        for part in found[1].split("; "):
            names, title = part.rsplit(" on all ", 1)
            group = next(g for t, g in NAMES.items() if t.lower() == title.lower())
            exact = self.exact_methods(group)
            named = re.split(r", | and ", names)
            more = re.fullmatch(r"(\d+) more", named[-1])
            listed = named[:-1] if more else named
            self.assertLessEqual(set(listed), exact)
            self.assertEqual(len(listed) + (int(more[1]) if more else 0), len(exact))
        return True

    def duel(self, claim):
        found = re.fullmatch(
            r"(.*): over all errors (\S+ \(.*?\)) comes first(?:; (\S+ \(.*?\)) costs|, but these motions do not decide "
            r"between it and (\S+ \(.*?\)), which costs) (\S+) times as much \(95 % interval (\S+) to (\S+) over (\d+) "
            r"motions\)\.", claim)
        if not found:
            return self.undecided(claim)
        group = NAMES[found[1]]
        first, other = self.contender(found[2]), self.contender(found[3] or found[4])
        ranked = self.best_overall(group)
        self.assertEqual(ranked[0][2][0], first[0])
        self.assertEqual(next(c for _, _, c in ranked if c[0] != first[0])[0], other[0])
        means, _, _ = self.costs.pair(group, other, first)
        self.assertEqual(int(found[8]), len(means))
        self.assertTrue(close(found[5], math.exp(sum(means) / len(means))))
        spread = max(means) - min(means)
        for printed, end in zip(found.groups()[5:7], recounted_methods.interval(means)):
            self.assertAlmostEqual(math.log(float(printed)), end, delta=0.12 * spread + 0.006)
        self.assertEqual(bool(found[3]), float(found[6]) > 1)
        return True

    def undecided(self, claim):
        found = re.fullmatch(r"(.*): (\S+ \(.*?\)) and then (\S+ \(.*?\)) come first over all errors; that both compete on "
                             r"(\d+) motions? is too little for an interval of their ratio\.", claim)
        if not found:
            return False
        first, other = self.contender(found[2]), self.contender(found[3])
        ranked = self.best_overall(NAMES[found[1]])
        self.assertEqual(ranked[0][2][0], first[0])
        self.assertEqual(next(c for _, _, c in ranked if c[0] != first[0])[0], other[0])
        self.assertEqual(int(found[4]), len(self.costs.pair(NAMES[found[1]], other, first)[0]))
        self.assertLess(int(found[4]), 3)
        return True

    def changes(self, claim):
        found = re.fullmatch(r"(.*): in (\d+) of (\d+) tasks another method is recommended if the motion is left out "
                             r"\((.*)\)\.", claim)
        if not found:
            return False
        group = NAMES[found[1]]
        rows = [r for r in read(PAPER / "regret.csv") if r["group"] == group]
        changed = [r for r in rows if r["other_method_than_with_it"] == "yes"]
        self.assertEqual((int(found[2]), int(found[3])), (len(changed), len(rows)))
        self.assertEqual(set(re.split(r", | and ", found[4])), {r["left_out"] for r in changed})
        for row in changed:  # and it is another one indeed
            with_it = self.costs.ranking(self.costs.motions[group], [row["error_at_most"]])
            tied = {c[0] for s, r, c in with_it if s == with_it[0][0] and abs(r - with_it[0][1]) < 1e-5}
            self.assertNotEqual(tied, {row["recommended_method"]})
        return True


if __name__ == "__main__":
    unittest.main()
