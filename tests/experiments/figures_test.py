# SPDX-License-Identifier: BSD-3-Clause
"""figures and plot on the folders of studies, and the options that choose figures and their look, as a user calls them."""
import contextlib
import re
import shutil
import sqlite3
import unittest

from programs import call, read, temporary_folder

STUDY = ["--scenario", "peters_hsu", "--integrator", "rk4,heun,dmv", "--dt", "0.02,0.01,0.005", "--t-end", "1"]
NAMES = {"drift_against_time", "drift_against_step", "momentum", "orientation_defect", "error_against_step", "error_against_cost"}


def names(folder):
    return {path.stem for path in folder.glob("*.gp")}


def files(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def blocks(path):
    """The blocks of a data file of gnuplot: the lines of each that are no comment, as lists of words."""
    found = []
    for text in path.read_text(encoding="utf-8").split("\n\n\n"):
        found.append([line.split() for line in text.splitlines() if line and not line.startswith("#")])
    return found


def size_in_points(pdf):
    box = re.search(rb"/MediaBox \[ *0 0 ([0-9.]+) ([0-9.]+)", pdf.read_bytes())
    return float(box[1]), float(box[2])


@unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed: no figures are drawn")
class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        call("energy_drift", *STUDY, "--out", "study", folder=cls.folder)
        call("energy_drift", *STUDY, "--orientation", "matrix", "--no-figures", "--out", "matrices", folder=cls.folder)
        call("energy_drift", *STUDY[:-4], "--dt", "0.02,0.01", *STUDY[-2:], "--orientation", "matrix", "--no-figures", "--out",
             "matrix_of_two", folder=cls.folder)

    def said(self, program, *arguments, status=0):
        return call(program, *arguments, folder=self.folder, status=status)

    def refused(self, program, *arguments, say):
        done = self.said(program, *arguments, status=2)
        self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1), done.stderr)
        self.assertIn(say, done.stderr)

    # Redrawing.

    def test_figures_are_drawn_again_with_the_same_bytes(self):
        done = self.said("figures", "study", "--out", "again")
        self.assertEqual(done.stderr, "")
        self.assertEqual(names(self.folder / "study/figures"), NAMES)
        self.assertEqual(files(self.folder / "again/figures"), files(self.folder / "study/figures"))
        self.assertEqual(len(done.stdout.splitlines()), len(NAMES))

    def test_the_look_is_that_of_the_study_with_the_same_options(self):
        look = ["--figure", "momentum,drift_against_step", "--figure-width", "one_column", "--figure-font", "DejaVu Serif,8",
                "--figure-title", "on"]
        self.said("energy_drift", *STUDY, *look, "--out", "narrow")
        self.said("figures", "study", *look, "--out", "narrow_again")
        self.assertEqual(names(self.folder / "narrow/figures"), {"momentum", "drift_against_step"})
        self.assertEqual(files(self.folder / "narrow_again/figures"), files(self.folder / "narrow/figures"))
        width, _ = size_in_points(self.folder / "narrow/figures/momentum.pdf")
        self.assertAlmostEqual(width, 8.6 / 2.54 * 72, delta=1)
        svg = (self.folder / "narrow/figures/momentum.svg").read_text(encoding="utf-8")
        self.assertIn("DejaVu Serif", svg)
        self.assertIn("Drift of the momenta", svg)
        default, _ = size_in_points(self.folder / "study/figures/momentum.pdf")
        self.assertAlmostEqual(default, 17 / 2.54 * 72, delta=1)
        self.assertNotIn("Drift of the momenta", (self.folder / "study/figures/momentum.svg").read_text(encoding="utf-8").split("</title>", 1)[1])

    def test_other_figures_in_the_folder_stay(self):
        shutil.copytree(self.folder / "study", self.folder / "copy")
        self.said("figures", "copy", "--figure", "momentum", "--figure-width", "12")
        self.assertEqual(names(self.folder / "copy/figures"), NAMES)
        width, _ = size_in_points(self.folder / "copy/figures/momentum.pdf")
        self.assertAlmostEqual(width, 12 / 2.54 * 72, delta=1)

    def test_two_studies_stand_in_one_figure(self):
        self.said("figures", "study", "matrices", "--figure", "drift_against_step", "--out", "both")
        script = (self.folder / "both/figures/drift_against_step.gp").read_text(encoding="utf-8")
        for variant in ("matrix", "quaternion"):
            self.assertIn(f"title '{variant}'", script)
        curves = [block for block in blocks(self.folder / "both/figures/drift_against_step.dat") if block]
        rows = read(self.folder / "study/runs.csv") + read(self.folder / "matrices/runs.csv")
        drawn = sorted((float(x), float(y)) for block in curves for x, y, _, mark in block if mark == "value")
        self.assertEqual(drawn, sorted((float(r["dt_s"]), float(r["energy_drift_max_rel"])) for r in rows))
        self.refused("figures", "study", "matrices", say="--out")

    def test_runs_are_chosen_by_a_condition(self):
        self.said("figures", "study", "--where", "integrator == 'rk4'", "--figure", "drift_against_step", "--out", "one")
        style = (self.folder / "one/figures/style.gnuplot").read_text(encoding="utf-8")
        self.assertIn("# rk4", style)
        self.assertNotIn("# heun", style)
        self.refused("figures", "study", "--where", "integrator == 'rk5'", "--out", "none", say="no run")

    def test_a_method_looks_the_same_alone(self):
        self.said("figures", "study", "--where", "integrator == 'rk4'", "--out", "alone")
        looks = []
        for folder in ("study", "alone"):
            style = (self.folder / folder / "figures/style.gnuplot").read_text(encoding="utf-8")
            line = style.split("# rk4\n")[1].splitlines()[0]
            looks.append(re.findall(r"linecolor rgb '(#\w+)'|dashtype (\S+)|pointtype (\d+)", line))
        self.assertEqual(looks[0], looks[1])
        self.assertEqual(len(looks[0]), 3)

    def test_what_cannot_be_drawn_is_refused(self):
        self.refused("energy_drift", *STUDY, "--figure", "momentums", "--out", "x", say="did you mean 'momentum'?")
        self.refused("energy_drift", *STUDY, "--figure", "none", "--out", "x", say="--no-figures")
        self.refused("energy_drift", *STUDY, "--figure-width", "3", "--out", "x", say="one_column")
        self.refused("figures", "nowhere", say="no such folder")
        self.refused("figures", say="no folder")
        listed = self.said("energy_drift", "--list", "figures").stdout
        self.assertEqual({line.split()[0] for line in listed.splitlines()}, NAMES | {"invariants"})

    def test_runs_that_cannot_be_read_are_said_where_none_is_left(self):
        runs = len(read(self.folder / "study/runs.csv"))
        for sql, why in (("UPDATE runs SET steps = steps + 1", "it is damaged (runs.checksum)"),
                         ("UPDATE runs SET id = 'row ' || number", "it is damaged (runs.id)"),
                         ("DELETE FROM configurations", "it is damaged (its configuration)")):
            for where in ([], ["--where", "integrator == 'rk4'"]):
                with self.subTest(sql, where=where):
                    shutil.rmtree(self.folder / "lost", ignore_errors=True)
                    shutil.copytree(self.folder / "study", self.folder / "lost")
                    with contextlib.closing(sqlite3.connect(self.folder / "lost/results.sqlite")) as store:
                        store.executescript(sql)
                    nothing = "--where: no run satisfies the conditions" if where else "there is no run to draw in lost"
                    self.refused("figures", "lost", *where, "--out", "x", say=f"{nothing}; {runs} runs left out, which cannot be read; the first: r")
                    self.refused("figures", "lost", *where, "--out", "x", say=why)

    def test_a_figure_that_the_study_does_not_have_is_said(self):
        done = self.said("figures", "study", "--figure", "invariants", "--out", "absent", status=3)
        self.assertIn("no figure 'invariants'", done.stderr)

    def test_figures_of_an_analysis_are_named_with_the_command_that_draws_them(self):
        self.said("work_precision", "--scenario", "peters_hsu", "--integrator", "rk4,heun", "--dt", "0.02,0.01,0.005", "--t-end", "0.5",
                  "--out", "orders")
        own = names(self.folder / "orders/figures") - NAMES
        self.assertTrue(own)
        done = self.said("figures", "orders")
        for name in own:
            self.assertIn(name, done.stderr)
            self.assertTrue((self.folder / "orders/figures" / f"{name}.svg").exists())
        self.assertIn("./run work_precision", done.stderr)

    # One run.

    def test_omega_is_that_of_the_trajectory(self):
        self.said("simulate", "--scenario", "peters_hsu", "--integrator", "rk4", "--dt", "0.01", "--t-end", "2", "--no-figures", "--out", "run")
        self.said("plot", "run", "--quantity", "omega_world,energy,position")
        trajectory = read(self.folder / "run/trajectory.csv")
        for quantity, columns in (("omega_world", ("wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s")),
                                  ("position", ("px_m", "py_m", "pz_m"))):
            drawn = blocks(self.folder / f"run/plots/{quantity}.dat")
            self.assertEqual(len(drawn), 3)
            for column, block in zip(columns, drawn):
                self.assertEqual([(float(t), float(y)) for t, y, _, _ in block],
                                 [(float(row["t_s"]), float(row[column])) for row in trajectory])
        energy = blocks(self.folder / "run/plots/energy.dat")[2]
        self.assertEqual([float(y) for _, y, _, _ in energy], [float(row["energy_J"]) for row in trajectory])

    def test_every_quantity_of_a_free_body_is_drawn_the_same_twice(self):
        quantities = [line.split()[0] for line in self.said("plot", "--list").stdout.splitlines()]
        self.assertGreaterEqual(len(quantities), 15)
        drawn = ",".join(q for q in quantities if q != "events")
        for out in ("first", "second"):
            self.said("plot", "study", "--where", "dt == 0.02", "--quantity", drawn, "--out", out)
        self.assertEqual(names(self.folder / "first/plots"), set(quantities) - {"events"})
        self.assertEqual(files(self.folder / "first/plots"), files(self.folder / "second/plots"))
        for path in (self.folder / "first/plots").glob("*.svg"):
            self.assertGreater(path.stat().st_size, 2000, path)

    def test_the_polhode_lies_on_its_ellipsoid(self):
        self.said("simulate", "--scenario", "dzhanibekov", "--integrator", "rk4", "--dt", "0.02", "--t-end", "120", "--no-figures", "--out", "flip")
        self.said("plot", "flip", "--quantity", "polhode")
        script = (self.folder / "flip/plots/polhode.gp").read_text(encoding="utf-8")
        grid, *curve = blocks(self.folder / "flip/plots/polhode.dat")[0:3]
        semi = [max(abs(float(row[k])) for row in grid) for k in range(3)]
        for block in curve:
            for row in block:
                self.assertAlmostEqual(sum((float(x) / a) ** 2 for x, a in zip(row, semi)), 1, delta=0.02)
        self.assertIn("dashtype (2,4)", script)

    def test_figures_in_space_have_all_of_their_labels_and_lines_in_sight(self):
        for width in ("one_column", "17"):
            self.said("plot", "study", "--where", "dt >= 0.01", "--quantity", "polhode,herpolhode", "--figure-width", width, "--out",
                      f"space_{width}")
            for name, axes in (("polhode", "ω₁ ω₂ ω₃"), ("herpolhode", "first second along")):
                svg = (self.folder / f"space_{width}/plots/{name}.svg").read_text(encoding="utf-8")
                wide, high = (float(x) for x in re.search(r'viewBox="0 0 (\d+) (\d+)"', svg).groups())
                said = re.findall(r'translate\(([-\d.]+),([-\d.]+)\)[^<]*<text>(.*?)</text>', svg, re.DOTALL)
                texts = " ".join(re.sub(r"<[^>]*>", "", text) for _, _, text in said)
                for word in (*axes.split(), "rk4, dt = 0.02 s", "heun, dt = 0.01 s", "dmv, dt = 0.02 s"):
                    self.assertIn(word, texts)
                places = [place[:2] for place in said] + re.findall(r"[ML](-?[\d.]+),(-?[\d.]+)", svg.split("</defs>")[-1])
                for x, y in places:
                    self.assertTrue(0 <= float(x) <= wide and 0 <= float(y) <= high, (name, width, x, y))

    def test_figures_of_a_study_whose_durations_follow_its_steps_are_drawn_again_with_the_same_bytes(self):
        self.said("stability", "--scenario", "hairer_vilmart", "--integrator", "heun,rk4", "--t-end", "5", "--out", "stable")
        before = files(self.folder / "stable/figures")
        self.said("figures", "stable", "--figure", "drift_against_step")
        for ending in ("svg", "dat"):
            self.assertEqual(files(self.folder / "stable/figures")[f"drift_against_step.{ending}"], before[f"drift_against_step.{ending}"])

    def test_no_step_stands_twice_beside_more_steps_of_another_study(self):
        self.said("figures", "study", "matrix_of_two", "--figure", "drift_against_time", "--out", "uneven")
        titles = re.findall(r"set title (.*) noenhanced", (self.folder / "uneven/figures/drift_against_time.gp").read_text(encoding="utf-8"))
        self.assertEqual(len(titles), 5)
        self.assertEqual(len(set(titles)), 5)

    def test_the_stacked_energies_and_the_impacts_of_a_ball(self):
        self.said("simulate", "--scenario", "bouncing_ball", "--dt", "0.005", "--no-figures", "--out", "ball")
        self.said("plot", "ball", "--quantity", "ledger,events")
        impacts = [r for r in read(self.folder / "ball/events.csv") if r["kind"] == "impact"]
        drawn = blocks(self.folder / "ball/plots/events.dat")[0]
        self.assertEqual(len(drawn), len(impacts))
        for (left, right, _, _), impact in zip(drawn, impacts):
            self.assertLessEqual(float(left) - 1e-9, float(impact["t_s"]))
            self.assertGreaterEqual(float(right) + 1e-9, float(impact["t_s"]))
        stacks = {}
        for block in blocks(self.folder / "ball/plots/ledger.dat")[:-1]:  # the last one: impacts
            for left, _, _, top in block:
                stacks[left] = max(stacks.get(left, 0), float(top))
        self.assertGreater(len(stacks), 100)
        self.assertLess(max(stacks.values()) - min(stacks.values()), 1e-6 * max(stacks.values()))

    def test_what_cannot_be_plotted_is_refused(self):
        self.refused("plot", "study", "--quantity", "omegas", say="did you mean 'omega'?")
        self.refused("plot", "study", "--body", "wing", say="no moving body 'wing'")
        self.refused("plot", "0000", "study", say="no run")
        self.refused("plot", "study", "matrices", say="--out")
        done = self.said("plot", "study", "--quantity", "events", "--out", "quiet", status=3)
        self.assertIn("no run had an impact", done.stderr)


if __name__ == "__main__":
    unittest.main()
