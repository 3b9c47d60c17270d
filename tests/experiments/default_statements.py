# SPDX-License-Identifier: BSD-3-Clause
"""Statements of the default studies of default_studies_slow_test.py, counted again."""
import re

from programs import read
from statements import Recount, Wrong, expect, names, number, statements


def close(said, found):
    return abs(float(said) - found) <= 0.006 * abs(found) + 1e-12


class OfStack:
    def __init__(self, folder):
        self.rows = read(folder / "standing.csv")

    def standing(self, response, step, highest, still, deep, too_deep, fallen, after):
        rows = sorted((r for r in self.rows if r["response"] == response and close(step, number(r["step_s_or_tolerance"]))), key=lambda r: int(r["boxes"]))
        standing = []
        for row in rows:
            if row["left_place_s"]:
                break
            standing.append(row)
        expect(standing and int(standing[-1]["boxes"]) == int(highest), f"{response} {step}: {highest}")
        if still != "all":
            expect(int(still.split()[-1]) == len(standing), f"{still} of {len(standing)}")
        depth = max(number(r["penetration_end_m"]) for r in standing), max(number(r["penetration_max_m"]) for r in standing)
        expect(any(close(deep, 1000 * d) for d in depth), f"{deep} mm: {depth}")
        expect(bool(too_deep) == (float(deep) > 5), f"more than 5 mm: {deep}")
        if fallen:
            row = next(r for r in rows if r["boxes"] == fallen)
            expect(row is rows[len(standing)] and close(after, number(row["left_place_s"])), f"{fallen} after {after}")

    def tests(self):
        return [(r"(\S+), h = (\S+) s: stacks of up to (\d+) stand to the end, (all|\d+ of \d+) still, with boxes at most (\S+) mm in each "
                 r"other there(, more than 5 mm)?(?:; that of (\d+) leaves its place after (\S+) s)?\.", self.standing)]


class OfPile:
    def __init__(self, folder):
        self.rows = read(folder / "piles.csv")

    def pile(self, bodies, response, step, rise, deep, end):
        row = next(r for r in self.rows if r["bodies"] == bodies and r["response"] == response and close(step, number(r["dt_s"])))
        expect(close(rise, 100 * number(row["energy_rise_max_rel"])), f"rise {rise}")
        expect(close(deep, number(row["penetration_max_m"])) and close(end, number(row["penetration_end_m"])), f"depth {deep}, {end}")

    def tests(self):
        return [(r"(\d+) bodies \((\S+), h = (\S+) s\): the energy never rises by more than (\S+) % of what it was at the start; bodies are at "
                 r"most (\S+) m deep in each other, and (\S+) m at the end\.", self.pile)]


class OfCertificate:
    def __init__(self, folder):
        self.rows = read(folder / "certificate.csv")

    def holds(self, n, of, methods):
        holds = sum(r["verdict"] == "holds" for r in self.rows)
        fails = sum(r["verdict"] == "does not hold" for r in self.rows)
        expect((int(n), int(of)) == (holds, holds + fails), f"{n} of {of}: {holds} of {holds + fails}")
        expect(int(methods) == len({r["integrator"] for r in self.rows}), f"{methods} methods")

    def not_declared(self, n):
        verdicts = {}
        for row in self.rows:
            if row["verdict"] != "not applicable":
                verdicts.setdefault((row["integrator"], row["trait"]), set()).add(row["verdict"])
        found = sum("holds, not declared" in of_trait and len(of_trait) > 1 for of_trait in verdicts.values())
        expect(int(n) == found, f"{n} traits: {found}")

    def tests(self):
        return [(r"(\d+) of (\d+) declared traits of (\d+) methods, counted in every formulation, that were decided by a measurement holds?\.", self.holds),
                (r"In some formulations only, (\d+) traits hold that are not declared: .*", self.not_declared),
                (r"In the table: yes, declared and measured to hold; .*", lambda: None)]


class OfStability:
    """Each limit is that of a row of critical_steps.csv, of each method that is named beside it."""

    def __init__(self, folder):
        self.rows = read(folder / "critical_steps.csv")

    def limits(self, scenario, text):
        parts = re.findall(r"(\d\S*)(?: … (\d\S*))? \(((?:[^()]|\([^()]*\))*)\)", text)
        expect(parts, text)
        for low, high, listed in parts:
            for method in names(re.sub(r" with varied keys(?: \([^)]*\))?", "", listed)):
                own = [r for r in self.rows if r["scenario"] == scenario and r["integrator"] == method]
                expect(own, f"{method} on {scenario}")
                found = [x for r in own for x in self.numbers(r)]
                for said in filter(None, (low, high)):
                    expect(any(close(said, x) for x in found), f"{method}: {said}")

    def numbers(self, row):
        rate = number(row["characteristic_rate_rad_per_s"])
        steps = [number(row[name]) for name in row if name.endswith("_s")]
        return [rate * x for x in steps if x] + [number(row[name]) for name in row if "h_omega" in name and row[name]]

    def without(self, scenario, listed):
        for method in names(re.sub(r" with varied keys(?: \([^)]*\))?", "", listed)):
            own = [r for r in self.rows if r["scenario"] == scenario and r["integrator"] == method]
            expect(any(not r["critical_step_s"] for r in own), f"{method} on {scenario}")

    def energy(self, scenario, change, listed):
        word = {"gained slowly, not by an instability,": "gaining slowly", "lost": "damped"}[change]
        for method in re.findall(r"(\w+) \(\S+ at h", listed):
            own = [r["energy_below"] for r in self.rows if r["scenario"] == scenario and r["integrator"] == method]
            expect(word in own, f"{method} on {scenario}: {own}")

    def named(self, scenario, listed):
        for method in names(re.sub(r" with varied keys(?: \([^)]*\))?", "", listed)):
            expect(any(r["scenario"] == scenario and r["integrator"] == method for r in self.rows), f"{method} on {scenario}")

    def linear(self, scenario, agree, of):
        own = [r for r in self.rows if r["scenario"] == scenario and r["linear_theory"] not in ("", "none")]
        expect(int(agree) <= int(of) <= len([r for r in self.rows if r["scenario"] == scenario]), f"{agree} of {of}: {len(own)}")

    def tests(self):
        return [(r"(\w+), the motion is followed for .*? s: (.*)\.", self.limits),
                (r"(\w+), critical h\|ω\| of the energy: (.*)\.", self.limits),
                (r"(\w+), the energy grows before the run breaks down, which it does from h\|ω\|: (.*)\.", self.limits),
                (r"(\w+), no critical step up to the largest tried: (.*)\.", self.without),
                (r"(\w+), the energy grows at the smallest step tried already: (.*)\.", self.named),
                (r"(\w+), the energy stays bounded again at some larger step: (.*)\.", self.named),
                (r"(\w+), energy is (gained slowly, not by an instability,|lost) below the critical step, over its scale in a turn: (.*)\.", self.energy),
                (r"(\w+) is linear: the spectral radius of the step map gives the same limit to 1 % for (\d+) of (\d+) cases\.", self.linear),
                (r"Left out, since they choose their own steps: (.*)\.",
                 lambda listed: expect(not set(names(listed)) & {r["integrator"] for r in self.rows}, listed))]


class OfPrecision:
    """Each number is one of the method's rows."""

    def __init__(self, folder):
        self.rows = read(folder / "rounding.csv") + read(folder / "growth.csv") + read(folder / "runs.csv")

    def occur(self, method, text):
        found = [x for row in self.rows if row["integrator"] == method for cell in row.values() if (x := number(cell or "")) is not None]
        for said in re.findall(r"(?<![\w.])\d+\.?\d*(?:e-?\d+)?(?![\w.])", text):
            expect(any(close(said, abs(x)) for x in found), f"{method}: {said}")

    def laws(self, text):
        for method, precision, exponent, runs in re.findall(r"(\w+) in (float|double|long_double)(?:, compensated)?, t\^\((\S+) ± [^)]*\).*?\((\d+) runs?\)", text):
            own = [r for r in self.rows if r["integrator"] == method and r.get("growth_of") and r["precision"] == precision]
            expect(any(abs(float(exponent) - number(r["exponent"])) < 0.006 and r["runs"] == runs for r in own), f"{method} {precision} {exponent}")

    def tests(self):
        return [(r"(\w+): rounding takes over in (.*)\.", self.occur), (r"(\w+): compensated summation brings in (.*)\.", self.occur),
                (r"Brouwer’s law is seen, an energy drift of rounding as a random walk, ∝ √t: (.*)\.", self.laws),
                (r"An energy drift of rounding that does not grow: (.*)\.", self.laws),
                (r"There is no higher precision against which to tell the rounding of (.*)\.",
                 lambda listed: expect(all(item.endswith(" in long_double") for item in names(listed)), listed))]


DURATIONS_FOLLOW_STEPS = ("stability",)  # runs of a curve differ in their duration too
OF = {"stack": OfStack, "pile": OfPile, "certificate": OfCertificate, "stability": OfStability, "precision": OfPrecision}


def faults(experiment, folder):
    """The statements of a page that are not what the files beside it say, and the number of statements of the analysis."""
    recount = Recount(read(folder / "runs.csv"), OF[experiment](folder).tests(), experiment in DURATIONS_FOLLOW_STEPS)
    wrong = []
    for sentence in statements((folder / "report.html").read_text(encoding="utf-8")):
        try:
            recount.check(sentence)
        except Wrong as fault:
            wrong.append(f"{fault} << {sentence[:300]}")
    return wrong, recount.counted["analysis"]
