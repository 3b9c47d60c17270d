# SPDX-License-Identifier: BSD-3-Clause
"""The experiment `certificate` as a user meets it: certificate.csv, its tables, its report."""
import re
import unittest

from programs import call, read, temporary_folder

SMALL = ["--integrator", "explicit_euler,rk4,dmv,cvode_adams,recipe_ode", "--orientation", "quaternion",
         "--angular-state", "velocity_world,velocity_body,momentum_world", "--gyroscopic", "on"]
TRAITS = ["order_free", "order_forced", "order_time_dependent", "time_reversibility", "time_reversibility_many",
          "symplecticity", "energy_free", "energy_forced", "angular_momentum", "casimir", "orientation",
          "evaluations_per_step"]
VERDICTS = {"holds", "does not hold", "holds, not declared", "not declared", "undecided", "not applicable"}


class Certificate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out = cls.folder / "out"
        cls.printed = cls.run_program(*SMALL, "--out", cls.out).stdout
        cls.rows = read(cls.out / "certificate.csv")

    @classmethod
    def run_program(cls, *arguments, status=0):
        return call("certificate", *arguments, folder=cls.folder, status=status)

    def row(self, method, trait, state="velocity_body"):
        found = [r for r in self.rows if r["integrator"] == method and r["trait"] == trait
                 and r["angular_state"] == state]
        self.assertEqual(len(found), 1, f"{trait} of {method}")
        return found[0]

    def test_one_row_for_each_method_formulation_and_trait(self):
        self.assertEqual(len(self.rows), 5 * 3 * len(TRAITS))
        for row in self.rows:
            self.assertIn(row["verdict"], VERDICTS)
            if row["verdict"] == "not applicable":
                self.assertTrue(row["note"], row)
        self.assertEqual([r["trait"] for r in self.rows[:len(TRAITS)]], TRAITS)

    def test_what_methods_declare_holds(self):
        self.assertFalse([r for r in self.rows if r["verdict"] == "does not hold"])
        for trait in ("order_free", "order_forced", "order_time_dependent", "time_reversibility", "symplecticity",
                      "energy_free", "angular_momentum", "casimir", "orientation"):
            for state in ("velocity_world", "velocity_body", "momentum_world"):
                self.assertEqual(self.row("dmv", trait, state)["verdict"], "holds", trait)
        self.assertLess(float(self.row("dmv", "symplecticity")["measured"]), 1e-14)
        self.assertAlmostEqual(float(self.row("rk4", "order_forced")["measured"]), 4, delta=0.25)
        self.assertEqual(self.row("rk4", "symplecticity")["verdict"], "not declared")
        self.assertEqual(self.row("rk4", "evaluations_per_step")["measured"], "4")

    def test_energy_under_forces_says_how_it_grows(self):
        self.assertEqual(self.row("dmv", "energy_forced")["note"], "bounded")
        self.assertEqual(self.row("dmv", "energy_forced")["declared"], "")

    def test_what_makes_no_sense_says_why(self):
        adaptive = self.row("cvode_adams", "symplecticity")
        self.assertEqual(adaptive["verdict"], "not applicable")
        self.assertIn("chooses its steps", adaptive["note"])
        refused = self.row("recipe_ode", "order_free", "momentum_world")
        self.assertEqual((refused["verdict"], refused["measured"]), ("not applicable", ""))
        self.assertIn("recipe_ode", refused["note"])

    def test_where_the_momentum_is_the_state_it_is_kept_undeclared(self):
        self.assertEqual(self.row("rk4", "angular_momentum", "momentum_world")["verdict"], "holds, not declared")
        self.assertEqual(self.row("rk4", "angular_momentum")["verdict"], "not declared")

    def test_report_tables_and_terminal_say_the_same(self):
        words = re.sub(r"<[^>]*>", "", (self.out / "report.html").read_text(encoding="utf-8"))
        sentence = re.search(r"\d+ of \d+ declared traits of 5 methods, .*?\.", self.printed)[0]
        self.assertIn(sentence, words)
        order = f"{float(self.row('rk4', 'order_free')['measured']):.2f}"
        for text in (words, (self.out / "tables/certificate_by_formulation.md").read_text(encoding="utf-8"),
                     (self.out / "tables/certificate_by_formulation.tex").read_text(encoding="utf-8")):
            self.assertIn(order, text)
        self.assertIn("In the table: yes", self.printed)

    def test_the_cost_of_a_step_stands_apart(self):
        rows = read(self.out / "timings/cost.csv")
        self.assertEqual(len(rows), 15)
        for row in rows:
            if row["integrator"] != "recipe_ode":
                self.assertGreater(float(row["step_ns"]), 0)

    def test_the_same_input_gives_the_same_bytes(self):
        again = self.folder / "again"
        self.run_program(*SMALL, "--jobs", "1", "--out", again)
        for name in ("runs.csv", "certificate.csv", "tables/certificate.md", "tables/certificate.tex"):
            self.assertEqual((again / name).read_bytes(), (self.out / name).read_bytes(), name)

    def test_a_single_certificate_of_a_scenario_of_ones_own(self):
        out = self.folder / "own"
        own = self.folder / "top.toml"
        own.write_text('t_end = 1\n[[body]]\nmass = 1\ninertia = [1, 2, 2.5]\nangular_velocity = [0.5, 2, 0.3]\n',
                       encoding="utf-8")
        self.run_program("--scenario", own, "--integrator", "rk4", "--orientation", "matrix", "--angular-state",
                         "velocity_world", "--out", out)
        rows = {r["trait"]: r for r in read(out / "certificate.csv")}
        self.assertEqual(rows["order_free"]["verdict"], "holds")
        self.assertEqual(rows["order_forced"]["verdict"], "not applicable")
        self.assertEqual(rows["order_time_dependent"]["verdict"], "holds")
        self.assertFalse((out / "tables/certificate_by_formulation.md").exists())

    def test_without_the_gyroscopic_term_little_is_left(self):
        out = self.folder / "without"
        self.run_program("--integrator", "rk4", "--orientation", "quaternion", "--angular-state", "velocity_body",
                         "--gyroscopic", "off", "--out", out)
        rows = {r["trait"]: r for r in read(out / "certificate.csv")}
        self.assertEqual(rows["symplecticity"]["verdict"], "not applicable")
        self.assertIn("gyroscopic", rows["symplecticity"]["note"])

    def test_methods_of_joints_have_a_scenario_of_joints(self):
        out = self.folder / "jointed"
        self.run_program("--integrator", "rattle,shake,half_explicit4", "--orientation", "quaternion", "--angular-state",
                         "velocity_world", "--out", out)
        verdicts, rows = {}, read(out / "certificate.csv")
        for r in rows:
            verdicts[r["integrator"], r["trait"]] = r["verdict"]
            self.assertNotIn(r["verdict"], ("does not hold", "undecided"), r)
        for method in ("rattle", "shake", "half_explicit4"):
            for trait in ("order_forced", "order_time_dependent"):
                self.assertEqual(verdicts[method, trait], "holds", (method, trait))
        for trait in ("time_reversibility", "time_reversibility_many", "symplecticity"):
            self.assertEqual(verdicts["rattle", trait], "holds", trait)  # on the states that satisfy the joints
            self.assertEqual(verdicts["half_explicit4", trait], "not declared", trait)
        self.assertEqual({r["scenario"] for r in rows if r["trait"] == "order_forced"}, {"double_pendulum"})

    def test_bad_input_is_one_line_and_writes_nothing(self):
        out = self.folder / "bad"
        done = self.run_program("--integrator", "no_such_method", "--out", out, status=2)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
