# SPDX-License-Identifier: BSD-3-Clause
"""The experiment `broad_phase` as a user meets it: recorded motion answered, bad files refused, costs measured."""
import csv
import random
import unittest

from programs import call, read, temporary_folder

PHASES = ["all_pairs", "sweep_and_prune", "uniform_grid", "quadtree", "octree", "bsp_tree", "bvh"]
HEADER = "step,id,hx,hy,hz,px,py,pz\n"


class BroadPhaseTest(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def call(self, *arguments, status=0):
        return call("broad_phase", *arguments, folder=self.folder, status=status)

    def write(self, text):
        (self.folder / "boxes.csv").write_text(text, encoding="utf-8")

    def answer(self, phase="all_pairs"):
        done = self.call("--boxes", "boxes.csv", "--broad-phase", phase, "--out", "pairs.csv")
        return done.stdout, (self.folder / "pairs.csv").read_text(encoding="utf-8")


class RecordedMotion(BroadPhaseTest):
    def test_every_broad_phase_reports_the_pairs_of_brute_force(self):
        numbers = random.Random(1)
        rows = []
        for step in range(5):
            for body in range(60):
                half = [numbers.uniform(0.1, 1) for _ in range(3)]
                centre = [numbers.uniform(0, 6) for _ in range(3)]
                rows.append((step, 3 * body + 7, *half, *centre))
        expected = ["step,a,b"]
        for step in range(5):
            here = [r for r in rows if r[0] == step]
            for i, a in enumerate(here):
                for b in here[i + 1:]:
                    if all(a[5 + k] - a[2 + k] <= b[5 + k] + b[2 + k] and b[5 + k] - b[2 + k] <= a[5 + k] + a[2 + k]
                           for k in range(3)):
                        expected.append(f"{step},{a[1]},{b[1]}")
        self.assertGreater(len(expected), 50)
        numbers.shuffle(rows)
        self.write(HEADER + "".join(",".join(map(repr, r)) + "\n" for r in rows))
        for phase in PHASES:
            printed, pairs = self.answer(phase)
            self.assertEqual(pairs.splitlines(), expected, phase)
            table = list(csv.DictReader(line for line in printed.splitlines() if not line.startswith("#")))
            self.assertEqual([row["step"] for row in table], ["0", "1", "2", "3", "4"])
            self.assertTrue(all(float(row["time_s"]) > 0 and row["boxes"] == "60" for row in table))

    def test_columns_go_by_name_and_bodies_may_come_and_go(self):
        self.write('note,px,py,pz,hx,hy,hz,id,step\r\n"a, b",0,0,0,1,1,1,5,2\r\n"say ""x""",2,0,0,1,1,1,-3,2\r\n\r\n'
                   ',0,0,0,1,1,1,5,9\r\n,9,9,9,inf,inf,9,1,9\r\n,1e2,1e2,0,0,0,0,4,9\r\n')
        self.assertEqual(self.answer()[1], "step,a,b\n2,-3,5\n9,1,4\n9,1,5\n")

    def test_no_rows_no_pairs(self):
        self.write(HEADER)
        self.assertEqual(self.answer()[1], "step,a,b\n")

    def test_bad_files_are_refused_with_their_place(self):
        good = "0,0,1,1,1,0,0,0\n"
        for text, said in (
                ("", ["boxes.csv: ", "nothing in it"]),
                ("step,id,hx,hy,hz,px,py\n", ["boxes.csv:1:1: ", "no column pz"]),
                ("step,id,hx,hx,hy,hz,px,py,pz\n", ["boxes.csv:1:12: ", "hx stands twice"]),
                (HEADER + "0,0,1,1,1,0,0\n", ["boxes.csv:2:13: ", "7 cells under 8"]),
                (HEADER + good + "0,1,1,x,1,0,0,0\n", ["boxes.csv:3:7: ", "hy is 'x'"]),
                (HEADER + "0,1,1,,1,0,0,0\n", ["boxes.csv:2:7: ", "hy is empty"]),
                (HEADER + "0,1,1,1,-1,0,0,0\n", ["boxes.csv:2:9: ", "negative"]),
                (HEADER + "0,1,1,1,1,nan,0,0\n", ["boxes.csv:2:11: ", "px is 'nan'"]),
                (HEADER + "0,1,1,1,1,0,inf,0\n", ["boxes.csv:2:13: ", "infinite centre"]),
                (HEADER + "0,1,1,1,1,0,1e999,0\n", ["boxes.csv:2:13: ", "1e999"]),
                (HEADER + "0.5,1,1,1,1,0,0,0\n", ["boxes.csv:2:1: ", "step is '0.5'", "whole number"]),
                (HEADER + "0,1 2,1,1,1,0,0,0\n", ["boxes.csv:2:3: ", "id is '1 2'"]),
                (HEADER + good + good, ["boxes.csv:3:1: ", "id 0 stands twice in step 0", "line 2"]),
                (HEADER + '0,"1,1,1,1,0,0,0\n', ["boxes.csv:2:3: ", "quote"])):
            with self.subTest(text=text):
                self.write(text)
                done = self.call("--boxes", "boxes.csv", "--broad-phase", "all_pairs", "--out", "pairs.csv", status=2)
                self.assertEqual(done.stdout, "")
                self.assertEqual(done.stderr.count("\n"), 1)
                for word in said:
                    self.assertIn(word, done.stderr)
                self.assertFalse((self.folder / "pairs.csv").exists())

    def test_bad_options_are_refused_with_the_remedy(self):
        self.write(HEADER)
        boxes = ["--boxes", "boxes.csv"]
        for arguments, said in (
                (boxes + ["--out", "p.csv"], "--broad-phase is missing"),
                (boxes + ["--broad-phase", "all_pairs"], "--out is missing"),
                (boxes + ["--broad-phase", "all_pears", "--out", "p.csv"], "did you mean 'all_pairs'"),
                (boxes + ["--broad-phase", "all", "--out", "p.csv"], "one name"),
                (boxes + ["--broad-phase", "all_pairs", "--out", "p.csv", "--bodies", "5"], "--bodies has no meaning"),
                (["--boxes", "none.csv", "--broad-phase", "all_pairs", "--out", "p.csv"], "none.csv: no such file"),
                (["--boxes", ".", "--broad-phase", "all_pairs", "--out", "p.csv"], "is a folder"),
                (["--bodies", "0"], "--bodies"), (["--filling", "-1"], "--filling"), (["--magic"], "--help")):
            with self.subTest(arguments=arguments):
                done = self.call(*arguments, status=2)
                self.assertEqual(done.stderr.count("\n"), 1)
                self.assertIn(said, done.stderr)
                self.assertEqual([p.name for p in self.folder.iterdir()], ["boxes.csv"])


class Costs(BroadPhaseTest):
    def test_every_broad_phase_is_measured_at_every_number_of_bodies(self):
        done = self.call("--bodies", "50,200,800", "--out", "out", "--no-figures")
        self.assertIn("All report the same pairs", done.stdout)
        rows = read(self.folder / "out" / "cost.csv")
        self.assertEqual({(r["broad_phase"], r["bodies"]) for r in rows},
                         {(p, n) for p in PHASES for n in ("50", "200", "800")})
        for row in rows:
            self.assertGreater(float(row["ns_per_box"]), 0)
            self.assertGreater(float(row["pairs_per_box"]), 0)
        self.assertEqual(len({r["pairs_per_box"] for r in rows if r["bodies"] == "800"}), 1)
        for table in ("cost.csv", "cost.md", "cost.tex"):
            self.assertIn("bvh", (self.folder / "out" / "tables" / table).read_text(encoding="utf-8"))

    def test_pairs_are_those_of_the_same_steps_on_a_machine_of_any_speed(self):
        rows = []
        for phases in ("bvh", "bvh,all_pairs"):
            self.call("--bodies", "6000", "--broad-phase", phases, "--out", "out", "--no-figures")
            rows += [r for r in read(self.folder / "out" / "cost.csv") if r["broad_phase"] == "bvh"]
        self.assertEqual(rows[0]["pairs_per_box"], rows[1]["pairs_per_box"])
        if rows[0]["steps"] == rows[1]["steps"]:
            self.skipTest("this machine takes as many steps with all_pairs as without")

    def test_the_figure_is_drawn(self):
        self.call("--bodies", "50,200", "--broad-phase", "bvh,octree", "--out", "out")
        for ending in ("gp", "dat", "svg", "tex"):
            self.assertTrue((self.folder / "out" / "figures" / f"cost_against_bodies.{ending}").exists(), ending)
        self.assertIn("data:image/svg+xml", (self.folder / "out" / "report.html").read_text(encoding="utf-8"))
        self.assertEqual(sorted(p.name for p in (self.folder / "out" / "tables").iterdir()), ["cost.csv", "cost.md", "cost.tex"])

    def test_what_takes_too_long_is_left_out_and_said(self):
        done = self.call("--bodies", "100,4000", "--patience", "1e-3", "--broad-phase", "all_pairs,bvh", "--out", "out",
                         "--no-figures")
        self.assertIn("all_pairs is left out", done.stdout)


class Asking(BroadPhaseTest):
    def test_lists_the_catalogue(self):
        listed = self.call("--list", "broad-phases").stdout
        self.assertEqual([line.split()[0] for line in listed.splitlines()], PHASES)
        self.assertIn("sweep_and_prune", self.call("--list").stdout)


if __name__ == "__main__":
    unittest.main()
