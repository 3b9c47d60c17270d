# SPDX-License-Identifier: BSD-3-Clause
"""The experiment `work_precision` as a user meets it: its envelope against the runs, and times kept apart."""
import math
import re
import unittest

from programs import call, read, temporary_folder

SMALL = ["--scenario", "hairer_vilmart,detest_b5", "--integrator", "explicit_euler,explicit_midpoint,rk4,cvode_adams",
         "--dt", "0.2,0.1,0.05,0.025,0.0125", "--tolerance", "1e-3,1e-6,1e-9"]


def cost_to_reach(error, runs, column):
    """By the definition, from the rows of runs.csv: the first run that is as good, and the line from the one before."""
    runs = sorted(((float(r[column]), float(r["attitude_error_max_rad"])) for r in runs))
    runs = [r for r in runs if r[1] < 1]
    for k, (cost, at) in enumerate(runs):
        if at <= error:
            if k == 0:
                return cost
            before, was = runs[k - 1]
            return before * (cost / before) ** (math.log(was / error) / math.log(was / at))
    return math.inf


class WorkPrecision(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out, cls.again = cls.folder / "out", cls.folder / "again"
        cls.printed = cls.run_program(*SMALL, "--out", cls.out)
        cls.run_program(*SMALL, "--jobs", "1", "--out", cls.again)
        cls.runs, cls.envelope = read(cls.out / "runs.csv"), read(cls.out / "envelope.csv")

    @classmethod
    def run_program(cls, *arguments, status=0):
        return call("work_precision", *arguments, folder=cls.folder, status=status).stdout

    def check_envelope(self, envelope, runs, column):
        for row in envelope:
            costs = {}
            for method in {r["integrator"] for r in runs}:
                mine = [r for r in runs if r["integrator"] == method and r["scenario"] == row["scenario"]]
                costs[method] = cost_to_reach(float(row["error_at_most_rad"]) * (1 + 1e-9), mine, column)
            least = min(costs.values())
            self.assertAlmostEqual(costs[row["method"]], least, delta=1e-9 * least, msg=str(row))
            self.assertAlmostEqual(float(row[column]), least, delta=1e-6 * least, msg=str(row))

    def test_the_envelope_is_the_least_cost_at_each_decade(self):
        self.assertEqual({r["scenario"] for r in self.envelope}, {"hairer_vilmart", "detest_b5"})
        self.assertGreaterEqual(len(self.envelope), 8)
        self.check_envelope(self.envelope, self.runs, "rhs_evaluations")

    def test_so_is_the_one_by_time(self):
        wall = {r["run"]: r["wall_s"] for r in read(self.out / "timings.csv")}
        timed = [dict(r, wall_s=wall[r["run"]]) for r in self.runs]
        self.check_envelope(read(self.out / "timings/envelope_time.csv"), timed, "wall_s")

    def test_decades_go_down_one_by_one(self):
        for scenario in ("hairer_vilmart", "detest_b5"):
            decades = [int(r["error_at_most_rad"].removeprefix("1e")) for r in self.envelope if r["scenario"] == scenario]
            self.assertEqual(decades, list(range(decades[0], decades[0] - len(decades), -1)))

    def test_the_cheapest_is_named_in_words_and_in_the_figure(self):
        report = re.sub(r"<[^>]*>", "", (self.out / "report.html").read_text(encoding="utf-8"))
        script = (self.out / "figures/error_against_evaluations.gp").read_text(encoding="utf-8")
        sentence = re.search(r"Cheapest by right-hand sides on hairer_vilmart.*", self.printed)[0]
        self.assertIn(sentence, report)
        self.assertIn("Cheapest by wall time on hairer_vilmart", self.printed)
        self.assertIn("lower envelope", script)
        for row in self.envelope:
            if row["scenario"] == "hairer_vilmart":
                self.assertIn(row["method"], sentence)
                self.assertIn(f"set label '{row['method']}'", script)

    def test_times_are_kept_apart_from_what_is_the_same_at_every_call(self):
        different = {"timings.csv", "manifest.json", "results.sqlite"}
        files = {str(p.relative_to(self.out)) for p in self.out.rglob("*") if p.is_file()}
        self.assertIn("timings/error_against_time.svg", files)
        for name in sorted(files):
            if name in different or name.startswith("timings/") or name.startswith("results.sqlite"):
                continue
            one, two = ((folder / name).read_bytes() for folder in (self.out, self.again))
            if name == "report.html":  # the commands differ, in --out and --jobs
                one, two = (re.sub(rb"<pre><code>.*?</code></pre>", b"", text, flags=re.S) for text in (one, two))
            self.assertEqual(one, two, name)
        report = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertIn('src="timings/error_against_time.svg"', report)
        self.assertIn("Wall times differ from call to call", report)

    def test_without_an_exact_solution_it_says_so(self):
        out = self.folder / "none"
        printed = self.run_program("--scenario", "kovalevskaya_top", "--integrator", "rk4", "--dt", "0.1,0.05", "--out", out)
        self.assertIn("No error was measured", printed)
        self.assertEqual(len((out / "envelope.csv").read_text(encoding="utf-8").splitlines()), 1, "the header alone")
        self.assertFalse((out / "timings").exists())


class Meaning(unittest.TestCase):
    """Errors that are wrapped, or rounding, tell no order and win nothing: the box of Peters and Hsu, at the default steps."""

    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out = cls.folder / "out"
        call("work_precision", "--scenario", "peters_hsu", "--integrator", "heun,crouch_grossman3,exact_rotor,rk4", "--no-figures",
             "--out", cls.out, folder=cls.folder, status=0)
        cls.runs = read(cls.out / "runs.csv")
        cls.page = cls.text_of(cls.out)

    @staticmethod
    def text_of(out):
        return re.sub(r"<[^>]*>", "", (out / "report.html").read_text(encoding="utf-8"))

    def test_no_method_falls_more_slowly_for_wrapped_angles_or_rounding(self):
        wrapped = [float(r["attitude_error_max_rad"]) for r in self.runs if r["integrator"] == "heun"]
        self.assertGreater(max(wrapped), 1, "there is something to leave out")
        self.assertNotIn("the attitude error falls more slowly", self.page)
        self.assertIn("The data do not tell the order of the attitude error of exact_rotor: errors at round-off.", self.page)
        self.assertIn("The data do not tell the order of the attitude error of heun: too few points", self.page)
        self.assertIn("the attitude error falls at least as fast as the declared order wherever a slope can be seen (2 curves)",
                      self.page)

    def test_a_run_that_diverged_has_no_error(self):
        diverged = [r for r in self.runs if r["status"] == "diverged"]
        self.assertEqual({r["integrator"] for r in diverged}, {"crouch_grossman3"})
        for row in diverged:
            for column in ("attitude_error_max_rad", "position_error_max_m", "angular_velocity_error_max_rel",
                           "polhode_phase_error_max_s", "polhode_off_error_max_rel"):
                self.assertEqual(row[column], "", column)

    def test_where_no_run_follows_the_motion_nothing_is_cheapest(self):
        out = self.folder / "lost"
        printed = call("work_precision", "--scenario", "peters_hsu", "--integrator", "explicit_euler,lie_euler,recipe_bullet",
                       "--dt", "0.05,0.025,0.0125", "--no-figures", "--out", out, folder=self.folder, status=0).stdout
        errors = [float(r["attitude_error_max_rad"]) for r in read(out / "runs.csv")]
        self.assertLess(min(errors), 1, "one is nearer by chance, at a step larger than one that is lost")
        self.assertEqual(len(read(out / "envelope.csv")), 0)
        self.assertIn("No run follows peters_hsu: the attitude is off by more than a radian", printed)


if __name__ == "__main__":
    unittest.main()
