# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios with joints as a user meets them: reactions written, energy accounted for, options refused with the reason."""
import math
import shutil
import unittest

import h5py

from programs import call, read, temporary_folder

LOOSE = """t_end = 1.0
gravity = [0, 0, -9.81]
assemble = true
[[body]]
name = "rod"
mass = 1
inertia = [0.1, 0.1, 0.01]
position = [0.1, 0, -0.5]
[[joint]]
name = "pivot"
kind = "ball"
bodies = ["rod"]
anchor_body = [0, 0, 0.5]
"""


class Joints(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def run_program(self, program, *arguments, status=0):
        return call(program, *arguments, "--no-figures", folder=self.folder, status=status)

    def test_reactions_are_those_of_the_pendulum(self):
        out = self.folder / "out"
        self.run_program("simulate", "--scenario", "rod_pendulum", "--integrator", "rk4", "--dt", "1e-3", "--stabilization", "both",
                         "--out", out)
        motion, reactions = read(out / "trajectory.csv"), read(out / "reactions.csv")
        self.assertEqual(list(reactions[0]), ["t_s", "joint", "body", "fx_N", "fy_N", "fz_N", "tx_N_m", "ty_N_m", "tz_N_m"])
        self.assertEqual(len(reactions), len(motion))
        for place, row in zip(motion[::500], reactions[::500]):
            force = math.hypot(*(float(row[f"f{k}_N"]) for k in "xyz"))
            self.assertAlmostEqual(force, abs(3 * 9.81 * float(place["py_m"])), delta=1e-7)  # 3 m g |y|/L from the horizontal
            self.assertEqual([float(row[f"t{k}_N_m"]) for k in "xyz"], [0, 0, 0])

    def test_both_formats_have_the_same_reactions(self):
        for form in ("csv", "hdf5"):
            self.run_program("simulate", "--scenario", "double_pendulum", "--integrator", "rk4", "--dt", "1e-2", "--trajectory", form,
                             "--out", self.folder / form)
        rows = [[float(x) for x in row.values()] for row in read(self.folder / "csv/reactions.csv")]
        with h5py.File(self.folder / "hdf5/trajectory.h5") as file:
            self.assertEqual([list(row) for row in file["reactions"]], rows)
        self.assertEqual([row[1] for row in rows[:4]], [0, 1, 0, 1])
        self.assertNotIn("reactions.csv", [f.name for f in self.free_run().iterdir()])

    def free_run(self):
        out = self.folder / "free"
        self.run_program("simulate", "--scenario", "dzhanibekov", "--integrator", "rk4", "--dt", "1", "--out", out)
        return out

    def test_errors_of_velocities_and_reactions_have_their_orders(self):
        steps = (2e-3, 5e-4)
        for scenario, more in (("rod_pendulum", ()), ("double_pendulum", ("--reference",))):
            out = self.folder / scenario
            self.run_program("energy_drift", "--scenario", scenario, "--integrator", "rattle,shake,generalized_alpha_index2,rk4", "--dt",
                             ",".join(map(str, steps)), "--t-end", "1", *more, "--out", out)
            rows = {(r["integrator"], float(r["dt_s"])): r for r in read(out / "runs.csv")}
            for method, of_reaction in (("rattle", 1), ("shake", 2), ("generalized_alpha_index2", 2), ("rk4", 4)):
                for column, order in (("velocity_error_max_m_per_s", 4 if method == "rk4" else 2),
                                      ("joint_reaction_error_max_N", of_reaction)):
                    coarse, fine = (float(rows[method, h][column]) for h in steps)
                    if fine > 1e-10:
                        self.assertAlmostEqual(math.log(coarse / fine, 4), order, delta=0.25, msg=f"{scenario} {method} {column}")

    def test_the_experiment_says_what_its_runs_say(self):
        out = self.folder / "out"
        done = self.run_program("joints", "--scenario", "double_pendulum", "--integrator", "rk4", "--stabilization", "none,both", "--dt",
                                "4e-3,1e-3", "--out", out)
        rows, runs = read(out / "joints.csv"), {r["run"]: r for r in read(out / "runs.csv")}
        self.assertEqual(len(rows), 4)
        for row in rows:
            for column in ("joint_gap_max_m", "position_error_max_m", "velocity_error_max_m_per_s", "joint_reaction_error_max_N"):
                self.assertEqual(row[column], runs[row["run"]][column])
            put_in = float(runs[row["run"]]["joint_work_J"]) + float(runs[row["run"]]["projection_J"])
            self.assertAlmostEqual(float(row["put_in_J"]), put_in, delta=1e-15)
        widest = max(float(r["joint_gap_max_m"]) for r in rows if float(r["step_s_or_tolerance"]) == 1e-3)
        self.assertIn(f"Joints stay closed to 1e-12 m with rk4 (both); rk4 (none) lets them open most, by {widest:.3g} m."
                      .replace("e-0", "e-"), done.stdout)
        # The largest force at the start: that of the first joint, which carries both rods where they are let go.
        limit = 1e-3 * max(2 * 9.81 / 1, 9.81)
        cheapest = min(int(r["evaluations"]) for r in rows if float(r["joint_reaction_error_max_N"]) < limit)
        self.assertIn(f"on double_pendulum ({cheapest} right-hand sides).", done.stdout)

    def test_linear_systems_of_joints_are_counted(self):
        out = self.folder / "out"
        for kept in ((), ("--trajectory", "csv")):  # what is written of a run is not its cost
            shutil.rmtree(out, ignore_errors=True)
            self.run_program("energy_drift", "--scenario", "double_pendulum", "--integrator", "rk4,recipe_ode_step,recipe_bullet_joints",
                             "--stabilization", "none,both,augmented_lagrangian", "--where",
                             "integrator == 'rk4' or stabilization == 'none'", "--dt", "1e-2", "--t-end", "1", *kept, "--out", out)
            rows = {(r["integrator"], r["stabilization"]): r for r in read(out / "runs.csv")}
            solves = {key: int(float(r["joint_solves"])) for key, r in rows.items()}
            self.assertEqual(solves["rk4", "none"], int(rows["rk4", "none"]["rhs_evaluations"]))
            self.assertEqual(solves["rk4", "none"], 400)  # four in each of 100 steps
            self.assertGreaterEqual(solves["rk4", "both"], 400 + 100 * 4)  # two of positions at least, two of velocities
            self.assertGreaterEqual(solves["rk4", "augmented_lagrangian"], 800)
            self.assertEqual(solves["recipe_ode_step", "none"], 1 + 100)  # the start, and one in each step
            self.assertEqual(solves["recipe_bullet_joints", "none"], 1)  # sweeps solve none

    def test_joints_are_measured_within_steps_and_iterations_are_counted(self):
        out = self.folder / "out"
        self.run_program("energy_drift", "--scenario", "double_pendulum", "--integrator", "cvode_bdf,ida_ggl,ida_index2,odeint_dopri5",
                         "--stabilization", "none,both", "--where", "integrator != 'ida_ggl' and integrator != 'ida_index2' or "
                         "stabilization == 'none'", "--tolerance", "1e-7", "--t-end", "1", "--out", out)
        rows = {(r["integrator"], r["stabilization"]): r for r in read(out / "runs.csv")}
        at = {key: float(r["joint_gap_max_m"]) for key, r in rows.items()}
        within = {key: float(r["joint_gap_within_steps_m"]) for key, r in rows.items()}
        for key in (("cvode_bdf", "both"), ("odeint_dopri5", "both"), ("ida_ggl", "none")):
            self.assertLess(at[key], 1e-7, key)  # closed at the steps
            self.assertGreater(within[key], at[key], key)  # less so between them
            self.assertLess(within[key], 1e-4, key)
        for key in (("cvode_bdf", "both"), ("odeint_dopri5", "both")):
            self.assertLess(at[key], 1e-13, key)
            self.assertGreater(within[key], 1e-9, key)
        # Drift is in both.
        self.assertGreater(within["odeint_dopri5", "none"], 0.5 * at["odeint_dopri5", "none"])
        for key, r in rows.items():
            self.assertEqual(r["nonlinear_iterations"] == "", key[0] == "odeint_dopri5", key)
            if r["nonlinear_iterations"]:
                self.assertGreaterEqual(int(float(r["nonlinear_iterations"])), int(r["steps"]), key)
        self.run_program("energy_drift", "--scenario", "double_pendulum", "--integrator", "rk4,rattle", "--dt", "1e-2", "--t-end", "1",
                         "--force", "--out", out)
        rows = {r["integrator"]: r for r in read(out / "runs.csv")}
        self.assertEqual([rows["rk4"]["joint_gap_within_steps_m"], rows["rk4"]["nonlinear_iterations"]], ["", ""])
        self.assertGreaterEqual(int(float(rows["rattle"]["nonlinear_iterations"])), 200)  # λ and μ in each of 100 steps

    def test_reactions_at_the_end_do_not_depend_on_the_samples_before(self):
        ends = []
        for samples in ((), ("--samples", "1000"), ("--samples", "3")):
            out = self.folder / ("end" + "_".join(samples))
            self.run_program("simulate", "--scenario", "double_pendulum", "--integrator", "ida_ggl", "--tolerance", "1e-5", "--t-end", "0.5",
                             *samples, "--trajectory", "csv", "--out", out)
            ends.append(read(out / "reactions.csv")[-2:])
        self.assertEqual(ends[1], ends[0])
        self.assertEqual(ends[2], ends[0])

    def test_a_chain_falls_on_a_floor(self):
        out = self.folder / "out"
        self.run_program("energy_drift", "--scenario", "falling_chain", "--integrator", "semi_implicit_euler,rk4", "--stabilization",
                         "none,both", "--dt", "2e-3", "--out", out)
        for r in read(out / "runs.csv"):
            self.assertEqual(r["status"], "ok", r)
            if r["stabilization"] == "both":
                self.assertLess(float(r["joint_gap_max_m"]), 1e-13, r)
            self.assertLess(float(r["energy_drift_max_rel"]), 0.02, r)  # of the ledger: what contact takes is in it
        for more, reason in ((("--integrator", "cvode_bdf"), "chooses its own steps"),
                             (("--integrator", "rk4", "--impact-timing", "event_located"), "follows the flight of single bodies"),
                             (("--integrator", "rattle"), "in a way of its own, without contacts"),
                             (("--integrator", "rk4", "--stabilization", "penalty"), "makes the joints soft")):
            steps = ("--tolerance", "1e-6") if "cvode_bdf" in more else ("--dt", "1e-3")
            done = self.run_program("simulate", "--scenario", "falling_chain", *more, *steps, "--out", self.folder / "refused", status=2)
            self.assertIn(reason, done.stderr)

    def test_all_methods_are_those_that_fit(self):
        for scenario, more, there in (("dzhanibekov", (), False), ("rod_pendulum", ("--stabilization", "both"), False),
                                      ("rod_pendulum", ("--stabilization", "none,both"), True)):
            said = self.run_program("energy_drift", "--scenario", scenario, "--integrator", "all", *more, "--dry-run").stdout
            self.assertEqual("will be refused" in said, there, said)

    def test_methods_of_joints_need_joints(self):
        refused = self.run_program("energy_drift", "--scenario", "dzhanibekov", "--integrator", "rattle", "--dt", "0.01", status=2)
        self.assertIn("rattle: it solves the equations of joints, and the scenario has none", refused.stderr)
        refused = self.run_program("energy_drift", "--scenario", "four_bar", "--integrator", "ida_ggl", "--stabilization", "both", status=2)
        self.assertIn("leave --stabilization out", refused.stderr)
        refused = self.run_program("energy_drift", "--scenario", "bricard", "--integrator", "ida_ggl", status=2)
        self.assertIn("depend on each other", refused.stderr)
        refused = self.run_program("energy_drift", "--scenario", "rolling_disk", "--integrator", "rattle", "--dt", "0.01", status=2)
        self.assertIn("not holonomic", refused.stderr)

    def test_the_ledger_has_what_stabilization_puts_in(self):
        for how in ("none", "baumgarte", "both"):
            out = self.folder / how
            self.run_program("simulate", "--scenario", "double_pendulum", "--integrator", "rk4", "--dt", "2e-3", "--stabilization", how,
                             "--out", out)
            last = read(out / "energy.csv")[-1]
            work, projection = float(last["stabilization_J"]), float(last["projection_J"])
            energy = float(last["kinetic_J"]) + float(last["potential_J"])  # 0 J at the start
            self.assertNotEqual(work, 0)
            self.assertEqual(projection != 0, how == "both")
            self.assertAlmostEqual(energy - work - projection, float(last["drift_J"]), delta=1e-15)
            self.assertLess(abs(float(last["drift_J"])), 1e-6)
            row = read(out / "runs.csv")[0]
            self.assertEqual((float(row["joint_work_J"]), float(row["projection_J"])), (work, projection))
            self.assertEqual(float(row["joint_gap_max_m"]) < 1e-13, how == "both")

    def test_assembly_and_dependent_equations_are_told(self):
        scenario = self.folder / "loose.toml"
        scenario.write_text(LOOSE, encoding="utf-8")
        for name, says in ((scenario, "Assemble moved the body &#39;rod&#39; by"), ("bricard", "rank 29 of 30")):
            out = self.folder / "told"
            self.run_program("simulate", "--scenario", name, "--integrator", "rk4", "--dt", "1e-2", "--t-end", "0.1", "--force", "--out",
                             out)
            page = (out / "report.html").read_text(encoding="utf-8")
            self.assertIn(says.replace("&#39;", "'"), page.replace("&#39;", "'"))

    def test_options_that_make_no_sense_are_refused(self):
        for arguments, says in (
                (["--scenario", "dzhanibekov", "--stabilization", "both"], "no scenario here has joints"),
                (["--scenario", "rod_pendulum", "--baumgarte-alpha", "5"], "no run here is stabilized by Baumgarte's equation"),
                (["--scenario", "rod_pendulum", "--stabilization", "sometimes"], "none, baumgarte, position, velocity, both")):
            done = self.run_program("energy_drift", *arguments, "--integrator", "rk4", "--dt", "1e-2", "--out", self.folder / "x", status=2)
            self.assertIn(says, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        done = self.run_program("energy_drift", "--scenario", "rod_pendulum", "--stabilization", "baumgarte", "--baumgarte-per-step", "0.1",
                                "--integrator", "odeint_dopri5", "--tolerance", "1e-6", "--out", self.folder / "x", status=2)
        self.assertIn("chooses its own steps; leave --baumgarte-per-step out", done.stderr)
        done = self.run_program("energy_drift", "--scenario", "rod_pendulum", "--stabilization", "baumgarte", "--baumgarte-per-step", "0.1",
                                "--baumgarte-beta", "3", "--integrator", "rk4", "--dt", "1e-2", "--out", self.folder / "x", status=2)
        self.assertIn("given twice", done.stderr)


if __name__ == "__main__":
    unittest.main()
