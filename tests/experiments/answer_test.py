# SPDX-License-Identifier: BSD-3-Clause
"""The answer with which a report begins, counted again from runs.csv, apart from the code that writes it."""
import html
import random
import re
import subprocess
import unittest

from programs import BIN, PATIENCE, read, temporary_folder

SCENARIOS = ["free_symmetric_top", "peters_hsu", "hairer_vilmart", "oscillator", "projectile", "two_bodies", "lagrange_top",
             "spring_box", "dzhanibekov", "simo_wong", "physical_pendulum", "kovalevskaya_top"]
METHODS = ["explicit_euler", "semi_implicit_euler", "heun", "rk4", "lie_midpoint", "dmv", "rkmk4", "gauss4", "exact_rotor",
           "cvode_adams", "odeint_dopri5", "odeint_fehlberg78"]
LADDER = ["0.2", "0.1", "0.05", "0.02", "0.01", "0.005"]
TOLERANCES = ["1e-3", "1e-5", "1e-7", "1e-9"]
TARGET = r"For an? (attitude|position) error of at most (\S+) (?:rad|m) over (\S+) s, "
DECIDED = re.compile(TARGET + r"(\S+) needs the fewest right-hand sides, about (\d+); (dt|tolerance) = (\S+?)(?: s)? has an "
                     r"error of (\S+) (?:rad|m)\.")
CHEAPEST = re.compile(TARGET + r"the cheapest of these runs is (\S+) at (dt|tolerance) = (\S+?)(?: s)?, with (\d+) right-hand sides "
                      r"and an error of (\S+) (?:rad|m)\.")
NEXT = re.compile(r"(?:Next is (\S+) with|(\S+) ties with it:) (\S+) times as many\.")
ENERGY = re.compile(r"(\S+) keeps the energy to round-off, but its (attitude|position) error is up to (\S+) (?:rad|m):")
SEVERAL = re.compile(r"For an error of at most (\S+) \(rad, or m where no attitude is compared\), the method with the fewest "
                     r"right-hand sides is (.*) of (\d+) motions\.")
ROUNDED = 0.006  # rounding of numbers with three digits
COLUMN = {"attitude": "attitude_error_max_rad", "position": "position_error_max_m"}


def number(text):
    return float(text) if text else None


def answer(page):
    """The sentences of the answer, as plain text."""
    section = re.search(r'<section id="answer">(.*?)</section>', page, re.DOTALL)[1]
    sentences = re.findall(r'<p class="answer[^"]*">(.*?)</p>', section, re.DOTALL)
    return [html.unescape(re.sub(r"<[^>]*>", "", sentence)) for sentence in sentences]


class Answers(unittest.TestCase):
    seed, studies = 5, 25

    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def study(self, *arguments):
        done = subprocess.run([str(BIN / "energy_drift"), *arguments, "--no-figures", "--out", "out"], cwd=self.folder,
                              capture_output=True, text=True, timeout=PATIENCE, stdin=subprocess.DEVNULL)
        self.assertIn(done.returncode, (0, 3), done.stderr)  # 3: some runs failed or are refused
        page = (self.folder / "out/report.html").read_text(encoding="utf-8")
        return answer(page), read(self.folder / "out/runs.csv")

    def runs_of(self, rows, method, column):
        """Costs and errors of the runs of a method, by cost, below the smallest step that is off the motion by a radian."""
        own = [row for row in rows if row["integrator"] == method]
        runs = []
        for row in sorted(own, key=lambda row: number(row["dt_s"]) or number(row["tolerance"])):
            if row["status"] == "failed":
                continue
            if row["status"] != "ok" or (column == COLUMN["attitude"] and number(row[column]) >= 1):
                break
            runs.append((number(row["rhs_evaluations"]), number(row[column])))
        return sorted(runs)

    def compared(self, sentences, rows):
        """The methods that count right-hand sides and are not said to be exact."""
        exact = next((sentence for sentence in sentences if sentence.startswith("Not among them: ")), "")
        return {row["integrator"] for row in rows if number(row["rhs_evaluations"]) and row["integrator"] not in exact}

    def check_run(self, rows, method, kind, step, t_end, column, target, error):
        named = [row for row in rows if row["integrator"] == method
                 and number(row["dt_s" if kind == "dt" else "tolerance"]) == float(step)]
        self.assertEqual(len(named), 1)
        self.assertEqual(number(named[0]["t_end_s"]), float(t_end))
        found = number(named[0][column])
        self.assertLessEqual(found, float(target))
        self.assertAlmostEqual(float(error) / found if found else 1, 1, delta=ROUNDED)
        return named[0]

    def check_decided(self, found, sentences, rows):
        quantity, target, t_end, method, cost, kind, step, error = found.groups()
        column, target, cost = COLUMN[quantity], float(target), float(cost)
        self.check_run(rows, method, kind, step, t_end, column, target, error)
        brackets = {}
        for name in self.compared(sentences, rows):
            runs = self.runs_of(rows, name, column)
            if not any(e <= target for _, e in runs):
                continue
            high = min(c for c, e in runs if e <= target)
            low = max((c for c, e in runs if c < high), default=None)
            self.assertIsNotNone(low, f"{name}: its cheapest run is better than {target}, which decides nothing")
            brackets[name] = (low, high)
            self.assertGreaterEqual(high, cost * (1 - ROUNDED), (found[0], name))
        low, high = brackets[method]
        self.assertTrue(low * (1 - ROUNDED) <= cost <= high * (1 + ROUNDED), found[0])
        runner_up = NEXT.fullmatch(sentences[1])
        self.assertEqual(bool(runner_up), len(brackets) > 1, sentences)
        if runner_up:
            low, high = brackets[runner_up[1] or runner_up[2]]
            ratio = float(runner_up[3])
            self.assertTrue(low * (1 - 2 * ROUNDED) <= ratio * cost <= high * (1 + 2 * ROUNDED), sentences)
            self.assertEqual("ties" in runner_up[0], ratio <= 1.2, runner_up[0])

    def check_cheapest(self, found, sentences, rows):
        quantity, target, t_end, method, kind, step, cost, error = found.groups()
        column, target = COLUMN[quantity], float(target)
        named = self.check_run(rows, method, kind, step, t_end, column, target, error)
        self.assertEqual(named["rhs_evaluations"], cost)
        better = set()
        for name in self.compared(sentences, rows):
            runs = self.runs_of(rows, name, column)
            reaching = [c for c, e in runs if e <= target]
            self.assertTrue(all(c >= float(cost) for c in reaching), (found[0], name))
            if reaching and min(reaching) == runs[0][0]:
                better.add(name)
        said = re.search(r"(?:steps|tolerances) of (.*) would decide", sentences[1])[1]
        self.assertTrue(better, found[0])
        if "more" not in said:
            self.assertEqual(set(re.split(", | and ", said)), better)

    def check_one_motion(self, sentences, rows):
        self.check_energy(sentences, rows)
        if found := DECIDED.fullmatch(sentences[0]):
            self.check_decided(found, sentences, rows)
            return "decided"
        if found := CHEAPEST.fullmatch(sentences[0]):
            self.check_cheapest(found, sentences, rows)
            return "cheapest"
        self.assertRegex(sentences[0], r"\A(These runs do not |No run |On \S+ over |\S+ at \S+ = .* did not come to its end)")
        return "none"

    def check_energy(self, sentences, rows):
        for found in filter(None, map(ENERGY.match, sentences)):
            own = [row for row in rows if row["integrator"] == found[1]]
            for row in own:
                self.assertLessEqual(number(row["energy_drift_max_J"]), number(row["energy_round_off_J"]), found[0])
            largest = max(number(row[COLUMN[found[2]]]) for row in own)
            self.assertAlmostEqual(float(found[3]) / largest, 1, delta=ROUNDED)

    def test_answers_of_random_studies_are_those_of_their_runs(self):
        chance, answers = random.Random(self.seed), []
        for k in range(self.studies):
            with self.subTest(study=k):
                methods = chance.sample(METHODS, chance.randint(1, 5))
                steps = chance.sample(LADDER, chance.randint(1, 5))
                words = ["--scenario", chance.choice(SCENARIOS), "--integrator", ",".join(methods), "--dt", ",".join(steps),
                         "--tolerance", ",".join(chance.sample(TOLERANCES, chance.randint(1, 3))), "--t-end", chance.choice("1 2 5".split())]
                if set(methods) <= {"cvode_adams", "odeint_dopri5", "odeint_fehlberg78"}:
                    del words[4:6]
                elif not set(methods) & {"cvode_adams", "odeint_dopri5", "odeint_fehlberg78"}:
                    del words[6:8]
                sentences, rows = self.study(*words, *(["--reference"] if chance.random() < 0.5 else []), "--force")
                self.assertTrue(1 <= len(sentences) <= 3, sentences)
                answers.append(self.check_one_motion(sentences, rows))
        for kind in ("decided", "cheapest", "none"):
            self.assertGreaterEqual(answers.count(kind), 3, answers)

    def test_several_motions_are_counted(self):
        sentences, rows = self.study("--scenario", "free_symmetric_top,peters_hsu,oscillator", "--integrator", "rk4,heun,dmv",
                                     "--dt", "0.1,0.05,0.02,0.01", "--t-end", "2")
        found = SEVERAL.match(sentences[0])
        self.assertTrue(found, sentences)
        wins = [int(n) for n in re.findall(r" on (\d+)", found[2])]
        self.assertEqual(found[3], "3")
        on = [int(n) for n in re.findall(r"[Oo]n (\d+) (?:the cheapest|no run)", " ".join(sentences[1:]))]
        self.assertEqual(sum(wins) + sum(on), 3, sentences)

    def test_a_study_without_errors_says_which_run_would_decide(self):
        sentences, rows = self.study("--scenario", "spring_box", "--integrator", "rk4,heun", "--dt", "0.02,0.01", "--t-end", "1")
        self.assertTrue(all(not row["attitude_error_max_rad"] for row in rows))
        self.assertIn("do not tell which method is right", sentences[0])
        self.assertIn("--reference", sentences[1])

    def test_a_study_of_diverged_runs_recommends_nothing(self):
        sentences, rows = self.study("--scenario", "oscillator", "--integrator", "explicit_euler", "--dt", "30,20", "--t-end", "3000")
        self.assertEqual({row["status"] for row in rows}, {"diverged"})
        self.assertEqual(sentences, ["No run came to its end, so that the study recommends no method."])

    def test_one_run_is_no_comparison(self):
        sentences, rows = self.study("--scenario", "peters_hsu", "--integrator", "rk4", "--dt", "0.005", "--t-end", "2")
        found = re.fullmatch(r"On peters_hsu over 2 s the attitude is off by at most (\S+) rad and the position by at most (\S+) m "
                             r"with rk4 at dt = 0.005 s\.", sentences[0])
        for text, column in zip(found.groups(), COLUMN.values()):
            self.assertAlmostEqual(float(text) / number(rows[0][column]), 1, delta=ROUNDED)
        drift, round_off = number(rows[0]["energy_drift_max_J"]), number(rows[0]["energy_round_off_J"])
        self.assertEqual("kept to round-off" in sentences[1], drift <= round_off, sentences)
        self.assertIn("several runs tell", sentences[2])

    def test_one_run_without_an_exact_motion_says_so(self):
        sentences, _ = self.study("--scenario", "spring_box", "--integrator", "rk4", "--dt", "0.01", "--t-end", "1")
        self.assertIn("no exact motion is known; --reference makes one", sentences[0])


if __name__ == "__main__":
    unittest.main()
