# SPDX-License-Identifier: BSD-3-Clause
"""The statements below the answer of a report, counted again from runs.csv, apart from the code that writes them.

Each kind of sentence has a pattern and a function; a sentence of no known kind is a fault. What the data cannot tell
again (the line through the points of an order) is tested as far as they go.
"""
import html
import math
import re
import subprocess

from programs import BIN

EPSILON = {"float": 2.0 ** -23, "double": 2.0 ** -52, "long_double": 2.0 ** -63}
COLUMN = {"energy drift": "energy_drift_max_rel", "angular momentum drift": "angular_momentum_drift_max_rel",
          "linear momentum drift": "linear_momentum_drift_max_rel", "orientation defect": "orientation_defect_max",
          "attitude error": "attitude_error_max_rad", "position error": "position_error_max_m"}
LEAST_ROUND_OFF = {"position error": 1e-10}
CLASSES = {"stays bounded in": "bounded", "grows like a random walk, ∝ √t, in": "random walk",
           "grows one way, more slowly than t, in": "sublinear", "grows linearly in": "linear",
           "grows quadratically in": "quadratic", "grows faster than that in": "faster",
           "has come to rest, or is as large as the energy that moves, in": "saturated",
           "changes at impacts, and not between them, in": "jumps", "never leaves round-off in": "round-off"}
TRENDS = {"gained or lost, depending on the step,": "gains or loses", "gained": "gains", "lost": "loses",
          "neither gained nor lost for good (the drift is bounded, or back below a tenth of its largest value)": "comes back",
          "not told from an oscillation": "undecided", "kept to round-off": "round-off"}
NUMBER = r"(\S+?)"


def plain(text):
    return html.unescape(re.sub(r"<[^>]*>", "", text)).strip()


def number(text):
    try:
        x = float(text)
    except ValueError:
        return None
    return x if math.isfinite(x) else None


def names(text):
    """The items of "a, b and c"."""
    return [item for item in re.split(r", | and ", text) if item]


def statements(page):
    """The sentences below the answer: the outcome, cautions and items of lists."""
    section = re.search(r'<section id="seen">(.*?)</section>', page, re.DOTALL)[1]
    outcome = re.search(r'<p class="outcome">(.*?)</p>', section, re.DOTALL)
    found = [plain(outcome[1])] if outcome else []
    found += [plain(text) for text in re.findall(r'<div class="caution".*?</strong>(.*?)</div>', section, re.DOTALL)]
    return found + [plain(text) for text in re.findall(r"<li>(.*?)</li>", section, re.DOTALL)]


class Wrong(AssertionError):
    pass


def expect(true, what):
    if not true:
        raise Wrong(what)


def orders():
    """The declared order of each method, as --list prints it."""
    text = subprocess.run([str(BIN / "energy_drift"), "--list", "integrators"], capture_output=True, text=True, check=True).stdout
    return {found[1]: int(found[2]) for found in re.finditer(r"^ *(\S+) .*, order (\d+)", text, re.MULTILINE)}


class Recount:
    """The runs of a study. `of_analysis`: patterns of further sentences, with functions that test them.
    `durations_follow_steps`: runs of a curve differ in their duration too."""

    def __init__(self, rows, of_analysis=(), durations_follow_steps=False):
        self.rows = rows
        self.varied = [name for name in (rows[0] if rows else {}) if "." in name]
        self.durations_follow_steps = durations_follow_steps
        self.of_analysis = [(re.compile(pattern), test) for pattern, test in of_analysis]
        self.counted = {}
        self.declared = None

    # Runs and their values.

    def column(self, quantity):
        return COLUMN.get(quantity) or quantity.removesuffix(" drift") + "_drift_max_rel"

    def value(self, row, quantity):
        return number(row.get(self.column(quantity)) or "") if row["status"] == "ok" else None

    def level(self, row, quantity):
        level = 16 * EPSILON[row["precision"]] * math.sqrt(max(int(row["steps"] or 1), 1))
        level = max(level, LEAST_ROUND_OFF.get(quantity, 0))
        if quantity == "energy drift" and number(row["energy_round_off_J"]) and number(row["energy_scale_J"]):
            level = max(level, number(row["energy_round_off_J"]) / number(row["energy_scale_J"]))
        return level

    def quiet(self, row, quantity):
        return self.value(row, quantity) <= self.level(row, quantity)

    def measured(self, quantity, rows=None):
        return [row for row in (self.rows if rows is None else rows) if self.value(row, quantity) is not None]

    def case(self, row):
        """The motion of a run: "hairer_vilmart, body.0.inertia.1 = 0.42"."""
        return row["scenario"] + "".join(f", {key} = {float(row[key]):.5g}" for key in self.varied if row[key])

    def curves(self, rows=None):
        """Runs of one method, case and formulation, from the largest step on."""
        found = {}
        for row in self.rows if rows is None else rows:
            key = tuple(row[name] for name in row if name in self.keys_of_curve())
            found.setdefault(key, []).append(row)
        for runs in found.values():
            runs.sort(key=lambda row: -(number(row["dt_s"]) or number(row["tolerance"]) or 0))
        return list(found.values())

    def keys_of_curve(self):
        names_of_columns = list(self.rows[0])
        options = names_of_columns[1:names_of_columns.index("status")]
        ignored = ("dt_s", "tolerance", "t_end_s") if self.durations_follow_steps else ("dt_s", "tolerance")
        return [name for name in options if name not in ignored]

    def same(self, said, found, what, within=0.006):
        said = float(said)
        if not (abs(said - found) <= within * abs(found) + 1e-300):
            raise Wrong(f"{what}: {said} is said, {found} is found")

    def equal(self, said, found, what):
        if said != found:
            raise Wrong(f"{what}: {said} is said, {found} is found")

    # All statements.

    def check(self, sentence):
        for kind, pattern, test in self.kinds():
            found = re.fullmatch(pattern, sentence, re.DOTALL)
            if found:
                self.counted[kind] = self.counted.get(kind, 0) + 1
                test(*found.groups())
                return kind
        for pattern, test in self.of_analysis:
            found = pattern.fullmatch(sentence)
            if found:
                self.counted["analysis"] = self.counted.get("analysis", 0) + 1
                test(*found.groups())
                return "analysis"
        raise Wrong(f"no test knows this kind of sentence: {sentence}")

    def kinds(self):
        quantity = r"(\w[\w ]*?(?:drift|defect|error))"
        return [
            ("all completed", r"(\d+) runs, all completed\.", self.all_completed),
            ("outcome", r"(\d+) runs?: (.*)\.", self.outcome),
            ("at a step", r"(?:(.*): )?[Aa]t (dt|tolerance) = (\S+?)(?: s)?(, the (?:largest step|smallest step|loosest|tightest))?: (.*)\.",
             self.at_a_step),
            ("energy", r"Energy over the runs: (.*)\.", self.trends_by_name),
            ("energy in numbers", r"Energy over the runs, of (\d+) curves: (.*)\. The table method by method says which\.",
             self.trends_by_number),
            ("undecided", r"How (?:it|the energy drift) grows cannot be told from (\d+) runs?: (.*)\.", self.undecided),
            ("class", r"(?:It|The energy drift) (" + "|".join(map(re.escape, CLASSES)) + r") (\d+) runs?: (.*)\.", self.drift_class),
            ("would decide", r"(Some|Between) (\S+?)(?: and (\S+))? s would decide (.*), by estimate\.", self.would_decide),
            ("falls", r"Against the step, the " + quantity + r" falls at least as fast as the declared order wherever a slope can be "
             r"seen \((\d+) curves?\)\.", self.falls),
            ("falls slowly", r"Against the step, the " + quantity + r" falls more slowly than the declared order for (.*)\.", self.falls_slowly),
            ("no order", r"The data do not tell the order of the " + quantity + r" of (.*?): (.*)\.", self.no_order),
            ("all quiet", r"The " + quantity + r" is at round-off in all runs that have one\.", self.all_quiet),
            ("quiet cases", r"The " + quantity + r" is at round-off in all runs of (.*)\.", self.quiet_cases),
            ("quiet methods", r"The " + quantity + r" is at round-off at every step for (.*)\.", self.quiet_methods),
            ("no invariant", r"In (\S+) the (angular|linear) momentum is no invariant: .* so it has no drift\.", self.no_invariant),
            ("not known", r"No exact solution is known for (.*), so (?:its|their) runs have no errors against it\.", self.not_known),
            ("phase alone", r"The error of (.*) in the body is one of phase alone: the momentum stays on its polhode and is early or "
             r"late there\.", lambda methods: self.polhode(methods, False)),
            ("leaves the polhode", r"(.*) leaves? the polhode too, since energy or \|L\| change\.", lambda methods: self.polhode(methods, True)),
            ("diverged", r"(\S+)(?: \((.*?)\))?(?: on (.*?))? diverged in (\d+) of (\d+) runs?; (?:it did so|the first to do so), at "
             r"(dt|tolerance) = (\S+?)(?: s)?, at t = (\S+) s\.", self.diverged),
            ("more diverged", r"(\d+) more curves diverged\.", lambda n: None),
            ("perfect energy", r"([^:]+): energy alone would call (?:this run|these runs) perfect \((\d+) runs? of (.*?)\), since it (does "
             r"not drift at all|drifts by no more than (\S+)); but the angular momentum drifts by (\S+?)(?: to (\S+))?(?: at every step "
             r"size| at every tolerance| at every step size and tolerance)?\. .*", self.perfect_energy),
            ("least, counted", r"Least " + quantity + r", or at round-off, counted over motions and formulations: (.*)\.",
             lambda quantity, text: self.counted_ends(quantity, text, True)),
            ("most, counted", r"Most " + quantity + r": (at the (?:largest|smallest|loosest|tightest).*)\.",
             lambda quantity, text: self.counted_ends(quantity, text, False)),
            ("none follows", r"No run follows the motion of (\S+): (?:all (\d+) that ended are|the one that ended is) off by more than a "
             r"radian, or by more than the motion goes\. .*", self.none_follows),
            ("one run", r"(\S+) at (dt|tolerance) = (\S+?)(?: s)?: (.*)\.", self.one_run),
            ("reference", r"(\S+): no exact solution is known; in its place stands a reference in extended precision, (.*)\.",
             lambda scenario, rest: self.reference(scenario)),
        ]

    def all_completed(self, n):
        self.equal((int(n), {"ok"}), (len(self.rows), {row["status"] for row in self.rows}), "outcome")

    def outcome(self, n, parts):
        self.equal(int(n), len(self.rows), "runs")
        words = {"completed": "ok"}
        for part in names(parts):
            if part == "none completed":
                return self.equal(0, sum(row["status"] == "ok" for row in self.rows), part)
            count, status = part.split()
            self.equal(int(count), sum(row["status"] == words.get(status, status) for row in self.rows), status)

    # One step: the least and the most.

    def chosen(self, prefix):
        """The rows that a prefix "scenario, variant" names: each part is a value of some option of the run."""
        rows = self.rows
        for part in (prefix or "").split(", "):
            key, _, x = part.partition(" = ")
            if x:
                rows = [row for row in rows if number(row[key]) is not None and math.isclose(number(row[key]), float(x), rel_tol=1e-4)]
            elif part:
                rows = [row for row in rows if any(part in (cell, f"{name} {cell}") or cell == part.split()[-1] for name, cell in row.items())]
        if not rows:
            raise Wrong(f"no run is of {prefix}")
        return rows

    def at_a_step(self, prefix, kind, step, place, text):
        if "evaluations of the right-hand side" in text:
            return self.one_run(prefix, kind, step, text)
        column = "dt_s" if kind == "dt" else "tolerance"
        rows = [row for row in self.chosen(prefix) if number(row[column])]
        here = [row for row in rows if math.isclose(number(row[column]), float(step), rel_tol=1e-4)]
        quantities = [*COLUMN, *(name.removesuffix("_max_rel").replace("_drift", " drift") for name in self.rows[0]
                                 if name.endswith("_drift_max_rel") and name not in COLUMN.values())]
        found = next((q for q in sorted(quantities, key=len, reverse=True) if q in text), None)
        if "the attitude of" in text and not found:
            found = "attitude error"
        if "the position of" in text and not found:
            found = "position error"
        if found is None and "did not reach the end" not in text:
            raise Wrong(f"no quantity in: {text}")
        if place and found:
            steps = [number(row[column]) for row in rows if self.value(row, found) is not None or row["status"] in ("diverged", "failed")]
            wanted = max(steps) if place in (", the largest step", ", the loosest") else min(steps)
            self.equal(math.isclose(float(step), wanted, rel_tol=1e-4), True, f"{place} of {found}")
        lost = []
        for part in text.split("; "):
            if one := re.fullmatch(r"(?:no run follows the motion: )?the (?:attitude|position) of (.*) is off by more than (?:a radian|the motion goes)", part):
                lost += names(one[1])
        for part in text.split("; "):
            self.part_at_a_step(part, found, here, lost)

    def part_at_a_step(self, part, quantity, here, lost):
        clear = [row for row in self.measured(quantity, here) if not self.quiet(row, quantity)] if quantity else []
        kept = [row for row in clear if row["integrator"] not in lost]
        unit = r"(?: rad| m)?"
        if one := re.fullmatch(rf"the .*? of (.*) is at round-off \((?:at most )?{NUMBER}{unit}\)", part):
            quiet = [row for row in self.measured(quantity, here) if self.quiet(row, quantity)]
            self.equal(sorted(names(one[1])), sorted(row["integrator"] for row in quiet), "at round-off")
            return self.same(one[2], max(self.value(row, quantity) for row in quiet), part)
        if one := re.fullmatch(rf"(\S+) has the least .*? \({NUMBER}{unit}(, but does not follow the motion)?\) and (\S+) the most \({NUMBER}{unit}\)", part):
            order = sorted(kept, key=lambda row: self.value(row, quantity))
            self.is_end(one[1], one[2], order, quantity, 0, part)
            return self.is_end(one[4], one[5], order, quantity, -1, part)
        if one := re.fullmatch(rf"(\S+) has the most \({NUMBER}{unit}\)", part):
            return self.is_end(one[1], one[2], sorted(kept, key=lambda row: self.value(row, quantity)), quantity, -1, part)
        if one := re.fullmatch(r"(?:no run follows the motion: )?the attitude of (.*) is off by more than a radian", part):
            return self.equal(sorted(names(one[1])), sorted(row["integrator"] for row in clear if self.value(row, quantity) >= 1), part)
        if one := re.fullmatch(r"(?:no run follows the motion: )?the position of (.*) is off by more than the motion goes", part):
            off = {row["integrator"]: self.value(row, quantity) for row in clear if row["integrator"] in lost}
            self.equal(sorted(names(one[1])), sorted(off), part)
            return self.equal(True, not kept or min(off.values()) >= max(self.value(row, quantity) for row in kept), part)
        if one := re.fullmatch(r"(.*) did not reach the end", part):
            ended = sorted(row["integrator"] for row in here if row["status"] in ("diverged", "failed"))
            return self.equal(sorted(names(one[1])), ended, part)
        if one := re.fullmatch(rf"no run keeps it: the .*? of (.*) is 1 or more(?: \({NUMBER}\)|, of (\S+) the most \({NUMBER}\))", part):
            self.equal(sorted(names(one[1])), sorted(row["integrator"] for row in clear), part)
            self.equal(True, all(self.value(row, quantity) >= 1 for row in clear), part)
            return self.same(one[2] or one[4], max(self.value(row, quantity) for row in clear), part)
        if one := re.fullmatch(rf"the .*? of (.*?) is {NUMBER}{unit}", part):
            self.equal(sorted(names(one[1])), sorted(row["integrator"] for row in kept), part)
            for row in kept:
                self.same(one[2], self.value(row, quantity), part, within=0.016)
            return None
        raise Wrong(f"no test knows this part of a sentence: {part}")

    def is_end(self, method, said, order, quantity, end, part):
        if not order:
            raise Wrong(f"{part}: no run has one")
        self.same(said, self.value(order[end], quantity), part)
        of_method = [self.value(row, quantity) for row in order if row["integrator"] == method]
        self.equal(True, self.value(order[end], quantity) in of_method, part)

    def counted_ends(self, quantity, text, least):
        """How often a method has the least value, or one at round-off, or the most, at one end of the steps."""
        for part in text.split("; "):
            end, adaptive, counts = re.fullmatch(r"at the (largest step|smallest step|loosest|tightest)( tolerance)? (.*)", part).groups()
            column = "tolerance" if adaptive else "dt_s"
            groups = {}
            for runs in self.curves([row for row in self.rows if row[column]]):
                if self.measured(quantity, runs) or any(row["status"] in ("diverged", "failed") for row in runs):
                    key = tuple(runs[0][name] for name in self.keys_of_curve() if name != "integrator")
                    groups.setdefault(key, []).extend(runs)
            found, total = {}, 0
            for rows in groups.values():
                steps = [number(row[column]) for row in rows]
                step = max(steps) if end in ("largest step", "loosest") else min(steps)
                here = self.measured(quantity, [row for row in rows if number(row[column]) == step])
                if not self.measured(quantity, rows) or self.case(rows[0]) in self.quiet_case_names(quantity):
                    continue
                error = quantity.endswith("error")
                quiet = [row for row in here if self.quiet(row, quantity)]
                clear = sorted((row for row in here if row not in quiet), key=lambda row: self.value(row, quantity))
                above = [row for row in clear if self.value(row, quantity) < 1]
                if not quiet + above or len(quiet) + (len(above) if error else len(clear)) < 2:
                    continue
                total += 1
                best = quiet or above[:1]
                worst = above[-1:] if error else clear[-1:]
                for row in best if least else worst:
                    found[row["integrator"]] = found.get(row["integrator"], 0) + 1
            said = {method: total if all_of else int(n) for method, n, all_of in re.findall(r"(\w+) \((?:(\d+) of \d+|all (\d+))\)", counts)}
            if quantity != "position error":  # how far the motion goes, beyond which a run is lost, is not in runs.csv
                self.equal(said, found, part)

    # The energy.

    def trend(self, row):
        most = self.value(row, "energy drift")
        if most is None:
            return ""
        kind, end = row["drift_class"], number(row["energy_drift_final_rel"]) or 0
        if self.quiet(row, "energy drift") or kind == "round-off":
            return "round-off"
        if kind == "bounded":
            return "comes back"
        if kind == "undecided":
            return "undecided"
        if kind in ("sublinear", "linear", "quadratic", "faster"):
            rate = number(row["energy_drift_rate_W"])
            return "gains" if (end if rate is None else rate) > 0 else "loses"
        if abs(end) < 0.1 * most:
            return "comes back"
        return "gains" if end > 0 else "loses"

    def trend_of_curve(self, runs):
        found = {self.trend(row) for row in runs} - {""}
        for weak in ("round-off", "undecided", "comes back"):
            if len(found) > 1:
                found.discard(weak)
        return " or ".join(sorted(found))

    def curves_by_trend(self):
        trends = [(runs, trend) for runs in self.curves() if (trend := self.trend_of_curve(runs))]
        quiet = {self.case(runs[0]) for runs, _ in trends}
        quiet -= {self.case(runs[0]) for runs, trend in trends if trend != "round-off"}
        return [(runs[0]["integrator"], trend) for runs, trend in trends if self.case(runs[0]) not in quiet]

    def trends_by_name(self, text):
        found = self.curves_by_trend()
        said = set()
        for part in re.sub(r" \((?!the drift)[^)]*\)", "", text).split("; "):
            words = next(words for words in TRENDS if part.startswith(words + " by "))
            trend = TRENDS[words]
            said.add(trend)
            self.equal(sorted(set(names(part[len(words) + 4:]))), sorted({method for method, t in found if t == trend}), part)
        self.equal(said, {trend for _, trend in found}, "trends")

    def trends_by_number(self, n, text):
        found = self.curves_by_trend()
        self.equal(int(n), len(found), "curves")
        for part in text.split("; "):
            words, count = re.fullmatch(r"(.*) in (\d+)", part).groups()
            self.equal(int(count), sum(trend == TRENDS[words] for _, trend in found), part)

    def some(self, text, found, what):
        """A list that may end in "and 3 more"."""
        items = names(text)
        rest = re.fullmatch(r"(\d+) more", items[-1])
        if rest:
            items.pop()
            self.equal(len(items) + int(rest[1]), len(found), what)
        self.equal(True, set(items) <= set(found) and (bool(rest) or len(items) == len(found)), f"{what}: {items} of {sorted(found)}")

    def of_class(self, kind):
        return [row for row in self.rows if row["drift_class"] == kind]

    def drift_class(self, words, n, methods):
        rows = self.of_class(CLASSES[words])
        self.equal(int(n), len(rows), words)
        self.some(methods, {row["integrator"] for row in rows}, words)
        if CLASSES[words] != "round-off":  # a class is never claimed from round-off
            for row in rows:
                self.equal(False, number(row["energy_drift_max_J"]) <= number(row["energy_round_off_J"]), f"{words} in {row['run']}")

    def undecided(self, n, methods):
        rows = self.of_class("undecided")
        self.equal(int(n), len(rows), "undecided")
        self.some(methods, {row["integrator"] for row in rows}, "undecided")

    def would_decide(self, words, low, high, which):
        durations = [number(row["drift_decided_after_s"]) for row in self.rows if row.get("drift_decided_after_s")]
        self.same(low, min(durations), words, within=0.06)
        self.same(high or low, max(durations), words, within=0.06)
        n = re.match(r"(\d+) of them", which)
        self.equal(int(n[1]) if n else len(self.of_class("undecided")), len(durations), which)

    # Orders.

    def points(self, runs, quantity):
        """The runs of a curve from the smallest step on, as (step, value) above round-off and not lost."""
        found = []
        for row in reversed(runs):
            x = self.value(row, quantity)
            if x is None or x <= 10 * self.level(row, quantity) or (COLUMN.get(quantity) != "position_error_max_m" and x > 0.5):
                continue
            found.append((number(row["dt_s"]), x))
        return found

    def slope(self, points):
        x, y = [math.log(p[0]) for p in points], [math.log(p[1]) for p in points]
        mx, my = sum(x) / len(x), sum(y) / len(y)
        return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)

    def fixed_step_curves(self, quantity):
        return [runs for runs in self.curves() if runs[0]["dt_s"] and runs[0]["gyroscopic"] == "on" and len(runs) >= 3 and self.measured(quantity, runs)]

    def falls(self, quantity, n):
        curves = self.fixed_step_curves(quantity)
        self.equal(True, 1 <= int(n) <= len(curves), f"{n} of {len(curves)} curves")

    def falls_slowly(self, quantity, text):
        self.declared = self.declared or orders()
        for part in re.findall(r"(\w+)(?: \([^)]*\))?(?: on (\w+(?:, \S+ = [^ ,]+)?))? \((\S+) over (\d+) points, declared (?:order (\S+)|exact)\)", text):
            method, case, slope, n, order = part
            near = []
            for runs in self.fixed_step_curves(quantity):
                if runs[0]["integrator"] != method or (case and self.case(runs[0]) != case):
                    continue
                points = self.points(runs, quantity)
                if len(points) >= int(n):
                    near.append(self.slope(points[:int(n)]))
            self.equal(True, any(abs(float(slope) - found) < 0.02 for found in near), f"slope {slope} of {method}: {near}")
            if order:
                self.equal(True, float(slope) < float(order), f"{method} falls more slowly than {order}")

    def no_order(self, quantity, methods, reason):
        methods = re.sub(r", [\w.]+ = [^ ,]+| \([^)]*\)", "", methods)
        listed = [re.match(r"\S+", item)[0] for item in names(re.sub(r" on \w+", "", methods)) if not item.endswith("more")]
        for method in listed:
            curves = [runs for runs in self.fixed_step_curves(quantity) if runs[0]["integrator"] == method]
            self.equal(True, bool(curves), f"{method} has a curve")
            if reason == "errors at round-off":
                self.equal(True, any(len(self.points(runs, quantity)) < 3 or any(
                    self.value(row, quantity) is not None and self.value(row, quantity) <= 10 * self.level(row, quantity) for row in runs)
                    for runs in curves), f"{method}: {reason}")
            elif reason.startswith("steps too large"):
                lost = [row for runs in curves for row in runs if row["status"] != "ok" or (self.value(row, quantity) or 0) > 0.5]
                self.equal(True, bool(lost), f"{method}: {reason}")
            elif reason not in ("the points lie on no line", "too few points for a line within ±0.5", "fewer than three steps"):
                self.equal(True, reason.startswith("errors at round-off, or steps too large"), reason)

    # Round-off, momenta, exact motions.

    def all_quiet(self, quantity):
        rows = self.measured(quantity)
        self.equal(True, bool(rows) and all(self.quiet(row, quantity) for row in rows), f"{quantity} at round-off")

    def quiet_case_names(self, quantity):
        found = {}
        for row in self.measured(quantity):
            found[self.case(row)] = found.get(self.case(row), True) and self.quiet(row, quantity)
        return {case for case, quiet in found.items() if quiet}

    def quiet_cases(self, quantity, cases):
        found = self.quiet_case_names(quantity)
        if count := re.fullmatch(r"(\d+) of (\d+) motions", cases):
            return self.equal((int(count[1]), int(count[2])), (len(found), len({self.case(row) for row in self.rows})), cases)
        return self.equal(set(names(cases)), found, f"{quantity} at round-off")

    def quiet_methods(self, quantity, text):
        quiet_cases = self.quiet_case_names(quantity)
        said = {}
        for method, cases in re.findall(r"(\w+)(?: \(([^)]*)\))?(?:, | and |$)", text):
            said[method] = set(names(cases)) if cases else None
        found = {}
        for runs in self.curves():
            rows = self.measured(quantity, runs)
            if rows and self.case(rows[0]) not in quiet_cases:
                of = found.setdefault(rows[0]["integrator"], {})
                of.setdefault(self.case(rows[0]), []).append(all(self.quiet(row, quantity) for row in rows))
        expected = {method for method, cases in found.items() if any(any(q) for q in cases.values())}
        self.equal(set(said), expected, f"{quantity} at round-off at every step")
        scenarios = {self.case(row) for row in self.rows}
        for method, cases in said.items():
            quiet = {case for case, q in found[method].items() if all(q)}
            count = re.fullmatch(r"(\d+) of (\d+) motions", next(iter(cases))) if cases and len(cases) == 1 else None
            if cases is None:
                self.equal(set(found[method]), quiet, method)
            elif count:
                self.equal(int(count[1]), len(quiet), f"{method}: motions")
            elif cases <= scenarios:
                self.equal(cases, quiet, method)

    def no_invariant(self, scenario, momentum):
        rows = [row for row in self.rows if row["scenario"] == scenario]
        self.equal([], self.measured(f"{momentum} momentum drift", rows), f"{momentum} momentum of {scenario}")

    def not_known(self, scenarios):
        for scenario in names(scenarios):
            rows = [row for row in self.rows if row["scenario"] == scenario]
            self.equal([], self.measured("attitude error", rows) + self.measured("position error", rows), scenario)

    def reference(self, scenario):
        rows = [row for row in self.rows if row["scenario"] == scenario]
        self.equal(True, any(row.get("attitude_reference_rad") or row.get("position_reference_m") for row in rows), scenario)

    def polhode(self, methods, leaves):
        phase, both = set(), set()
        for row in self.rows:
            off, late = number(row["polhode_off_error_max_rel"]), number(row["polhode_phase_error_max_rad"])
            if row["status"] != "ok" or off is None or late is None:
                continue
            level = 160 * EPSILON[row["precision"]] * math.sqrt(max(int(row["steps"]), 1))
            if max(off, late) > level:
                (both if off > level else phase).add(row["integrator"])
        self.some(methods, both if leaves else phase - both, "polhode")

    # Runs that are lost, or deceive.

    def diverged(self, method, variant, case, n, of, kind, step, at):
        rows = [row for row in self.rows if row["integrator"] == method and (not case or self.case(row) == case)]
        if variant:
            rows = [row for row in rows if set(variant.split(", ")) & set(row.values())]
        self.equal((int(n), int(of)), (sum(row["status"] == "diverged" for row in rows), len(rows)), f"{method} diverged")
        column = "dt_s" if kind == "dt" else "tolerance"
        self.equal(True, any(row["status"] == "diverged" and math.isclose(number(row[column]), float(step), rel_tol=1e-4) for row in rows), step)

    def perfect_energy(self, case, n, methods, _, energy, low, high):
        rows = [row for row in self.chosen(case) if (self.value(row, "energy drift") if self.value(row, "energy drift") is not None else 1) < 1e-10
                and (self.value(row, "angular momentum drift") or 0) > 1e-6]
        self.equal(int(n), len(rows), "deceived runs")
        self.equal(set(names(methods)), {row["integrator"] for row in rows}, "deceived methods")
        if energy:
            self.same(energy, max(self.value(row, "energy drift") for row in rows), "energy")
        drifts = [self.value(row, "angular momentum drift") for row in rows]
        self.same(low, min(drifts) if high else max(drifts), "momentum")
        if high:
            self.same(high, max(drifts), "momentum")

    def none_follows(self, case, n):
        rows = [row for row in self.rows if self.case(row) == case and row["gyroscopic"] == "on"
                and (self.value(row, "attitude error") is not None or self.value(row, "position error") is not None)]
        self.equal(int(n or 1), len(rows), "runs that ended")
        for row in rows:
            self.equal(True, (self.value(row, "attitude error") or 0) >= 1 or self.value(row, "position error") is not None, "off the motion")

    def one_run(self, method, kind, step, text):
        column = "dt_s" if kind == "dt" else "tolerance"
        rows = [row for row in self.rows if row["integrator"] == method.split()[0] and number(row[column])
                and math.isclose(number(row[column]), float(step), rel_tol=1e-4)]
        self.equal(True, bool(rows), f"a run of {method}")
        if len(rows) > 1 or rows[0]["status"] != "ok":
            return
        row = rows[0]
        for quantity, pattern in [("energy drift", r"largest energy drift is (\S+)"), ("angular momentum drift", r"angular momentum drift is (\S+)"),
                                  ("linear momentum drift", r"linear momentum drift is (\S+)"), ("orientation defect", r"orientation defect is (\S+)"),
                                  ("attitude error", r"attitude is off .*? by up to (\S+) rad"), ("position error", r"position by up to (\S+) m")]:
            said = re.search(pattern, text)
            self.equal(said is not None, self.value(row, quantity) is not None, quantity)
            if said:
                self.same(said[1].rstrip(";,"), self.value(row, quantity), quantity)
        self.equal("which is round-off" in text, self.quiet(row, "energy drift") or row["drift_class"] == "round-off", "round-off")
        work = re.search(r"it took (\d+) steps and (\d+) evaluations", text)
        self.equal((work[1], work[2]), (row["steps"], row["rhs_evaluations"]), "work")
