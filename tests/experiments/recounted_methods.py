# SPDX-License-Identifier: BSD-3-Clause
"""Counts the comparison of methods again from the rows of costs.csv, by the rules of experiments/methods/README.md."""
import math
import random
from collections import defaultdict

ERRORS = [f"1e-{k}" for k in range(2, 11)]


class Costs:
    """Costs by group, motion, contender (method, formulation) and error."""

    def __init__(self, rows):
        self.motions, self.contenders = defaultdict(list), []
        self.cost, self.exact = {}, set()
        for row in rows:
            contender = (row["method"], row["formulation"])
            if row["motion"] not in self.motions[row["group"]]:
                self.motions[row["group"]].append(row["motion"])
            if contender not in self.contenders:
                self.contenders.append(contender)
            if row["is_exact"] == "yes":
                self.exact.add((row["motion"], contender))
            for error in ERRORS:
                if row[f"rhs_per_time_to_{error}"]:
                    self.cost[row["motion"], contender, error] = float(row[f"rhs_per_time_to_{error}"])

    def ranking(self, motions, errors, allowed=lambda contender: True):
        """(-solved, mean log ratio, contender), best first."""
        competing = [c for c in self.contenders if allowed(c) and not all((m, c) in self.exact for m in motions)]
        least = {(m, e): min((self.cost.get((m, c, e), math.inf) for c in competing if (m, c) not in self.exact),
                             default=math.inf) for m in motions for e in errors}
        found = []
        for c in competing:
            logs = []
            for m in motions:
                for e in errors:
                    if (m, c) in self.exact:
                        logs.append(0.0)
                    elif (m, c, e) in self.cost:
                        logs.append(math.log(self.cost[m, c, e] / least[m, e]))
            if logs:
                found.append((-len(logs), sum(logs) / len(logs), c))
        return sorted(found, key=lambda r: (r[0], round(r[1], 6)))

    def regrets(self):
        """(group, motion, error, contender, ratio) of each motion left out in turn."""
        for group, motions in self.motions.items():
            if len(motions) < 3:
                continue
            for error in ERRORS:
                for left_out in motions:
                    known = self.ranking([m for m in motions if m != left_out], [error])
                    best = self.ranking([left_out], [error])
                    if not known or not best:
                        continue
                    contender = known[0][2]
                    least = self.cost[left_out, best[0][2], error]
                    if (left_out, contender) in self.exact:
                        ratio = 1.0
                    else:
                        ratio = self.cost.get((left_out, contender, error), math.inf) / least
                    yield group, left_out, error, contender, ratio

    def pair(self, group, first, second):
        """Mean of the logarithm of the cost ratio by motion, tasks, and those that one alone solves."""
        means, tasks, only = [], 0, [0, 0]
        for m in self.motions[group]:
            if (m, first) in self.exact or (m, second) in self.exact:
                continue
            logs = []
            for e in ERRORS:
                a, b = self.cost.get((m, first, e)), self.cost.get((m, second, e))
                if a and b:
                    logs.append(math.log(a / b))
                elif a:
                    only[0] += 1
                elif b:
                    only[1] += 1
            if logs:
                means.append(sum(logs) / len(logs))
                tasks += len(logs)
        return means, tasks, only


def interval(means, samples=4000):
    """Ends of the 95 % bootstrap interval of the mean, with random numbers of its own."""
    dice = random.Random(7)
    found = sorted(sum(dice.choice(means) for _ in means) / len(means) for _ in range(samples))
    return found[samples // 40], found[-samples // 40]


def check_recommended(case, costs, rows):
    seen = 0
    for group, motions in costs.motions.items():
        for error in ERRORS:
            expected = costs.ranking(motions, [error])
            printed = [r for r in rows if r["group"] == group and r["error_at_most"] == error]
            case.assertEqual(len(printed), len(expected), (group, error))
            for row, (solved, log_ratio, _) in zip(printed, expected):
                case.assertEqual(int(row["solved"]), -solved, row)
                case.assertAlmostEqual(math.log(float(row["mean_cost_over_least"])), log_ratio, delta=1e-5, msg=str(row))
            by_name = {c: (s, r) for s, r, c in expected}
            for row in printed:
                solved, log_ratio = by_name[row["method"], row["formulation"]]
                case.assertAlmostEqual(math.log(float(row["mean_cost_over_least"])), log_ratio, delta=1e-5, msg=str(row))
                seen += 1
    case.assertEqual(seen, len(rows))


def check_regrets(case, costs, rows):
    printed = {(r["group"], r["left_out"], r["error_at_most"]): r for r in rows}
    expected = list(costs.regrets())
    case.assertEqual(len(expected), len(rows))
    for group, motion, error, contender, ratio in expected:
        row = printed[group, motion, error]
        own = math.inf if row["reaches_it"] == "no" else float(row["cost_over_least"])
        if (row["recommended_method"], row["recommended_formulation"]) == contender:
            case.assertTrue(own == ratio or math.isclose(own, ratio, rel_tol=1e-5), row)
        else:  # two contenders that agree to the last digits
            known = costs.ranking([m for m in costs.motions[group] if m != motion], [error])
            tied = [c for s, r, c in known if s == known[0][0] and abs(r - known[0][1]) < 1e-5]
            case.assertIn((row["recommended_method"], row["recommended_formulation"]), tied)


def check_pairs(case, costs, rows):
    for row in rows:
        first, second = ((row[f"{who}_method"], row[f"{who}_formulation"]) for who in ("first", "second"))
        means, tasks, only = costs.pair(row["group"], first, second)
        case.assertEqual((int(row["motions"]), int(row["tasks"])), (len(means), tasks), row)
        case.assertEqual([int(row["only_first"]), int(row["only_second"])], only, row)
        if not means:
            case.assertEqual(row["cost_ratio"], "", row)
            continue
        mean = sum(means) / len(means)
        case.assertAlmostEqual(math.log(float(row["cost_ratio"])), mean, delta=1e-5, msg=str(row))
        low, high = interval(means)
        spread = max(means) - min(means)
        case.assertAlmostEqual(math.log(float(row["low_95"])), low, delta=0.12 * spread + 1e-5, msg=str(row))
        case.assertAlmostEqual(math.log(float(row["high_95"])), high, delta=0.12 * spread + 1e-5, msg=str(row))


def quantile(numbers, share):
    return sorted(numbers)[max(math.ceil(share * len(numbers)), 1) - 1]
