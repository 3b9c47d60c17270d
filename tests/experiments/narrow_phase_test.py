# SPDX-License-Identifier: BSD-3-Clause
"""The experiment `narrow_phase --pairs` as a user meets it: published cases, other headers, and what it refuses."""
import csv
import math
import pathlib
import unittest

from programs import call, read, temporary_folder

CASES = pathlib.Path(__file__).resolve().parents[1] / "collision" / "narrow" / "collision_cases.csv"
NAMES = "id,class,ahx,ahy,ahz,apx,apy,apz,aqw,aqx,aqy,aqz,bhx,bhy,bhz,bpx,bpy,bpz,bqw,bqx,bqy,bqz"
ROW = "7,kissing,1,1,1,0,0,0,1,0,0,0,1,1,1,3,0,0,2,0,0,0"


class NarrowPhase(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def run_program(self, *arguments, status=0):
        done = call("narrow_phase", *arguments, folder=self.folder, status=status)
        return done.stderr if status else done.stdout

    def answer(self, text, *arguments, status=0):
        (self.folder / "pairs.csv").write_text(text, encoding="utf-8")
        said = self.run_program("--pairs", "pairs.csv", "--out", "results.csv", *arguments, status=status)
        if status:
            self.assertEqual(said.count("\n"), 1, said)
            self.assertFalse((self.folder / "results.csv").exists())
            return said
        return read(self.folder / "results.csv")

    def test_published_cases(self):
        lines = [line for line in CASES.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
        cases = list(csv.DictReader(lines))
        for name, at_least in (("sat", 0), ("gjk", 1e-8)):
            self.run_program("--pairs", CASES, "--narrow-phase", name, "--out", "results.csv")
            results = read(self.folder / "results.csv")
            self.assertEqual([r["id"] for r in results], [c["id"] for c in cases])
            for case, result in zip(cases, results):
                self.assertEqual(list(result), ["id", "overlap", "sdist", "nx", "ny", "nz"])
                normal = [float(result[k]) for k in ("nx", "ny", "nz")]
                self.assertAlmostEqual(math.hypot(*normal), 1, delta=1e-12)
                expected = float(case["sdist"])
                if math.isnan(expected):
                    continue
                tolerance = max(float(case["tol"]), at_least * float(case["bhx"]))
                self.assertLessEqual(abs(float(result["sdist"]) - expected), tolerance, (name, case["class"]))
                if abs(expected) > 1e-11:
                    self.assertEqual(result["overlap"], "1" if expected < 0 else "0", (name, case["class"]))

    def test_one_pair_under_any_header(self):
        expected = [{"id": "7", "overlap": "0", "sdist": "1", "nx": "1", "ny": "0", "nz": "0"}]
        self.assertEqual(self.answer(f"{NAMES}\n{ROW}\n"), expected)
        self.assertEqual(self.answer(f"# a comment\n{NAMES},more\r\n{ROW},x\r\n"), expected)
        other = ",".join(f"column{k}" for k in range(22))
        self.assertEqual(self.answer(f"{other}\n{ROW}\n"), expected)
        cells, names = ROW.split(","), NAMES.split(",")
        self.assertEqual(self.answer(",".join(names[::-1]) + "\n" + ",".join(cells[::-1]) + "\n"), expected)
        self.assertEqual(self.answer(f"{NAMES}\n"), [])

    def test_bad_input_is_one_line_with_its_place(self):
        for bad, said in (("0", "not positive"), ("-1", "not positive"), ("x", "not a number"), ("", "empty"), ("nan", "ahx is 'nan'"),
                          ("inf", "infinite"), ("1e400", "double")):
            row = ROW.replace(",1,1,1,0", f",{bad},1,1,0", 1)
            message = self.answer(f"{NAMES}\n{row}\n", status=2)
            self.assertIn("pairs.csv:2:11: ", message)
            self.assertIn(said, message)
        self.assertIn("pairs.csv:2:23: ", self.answer(f"{NAMES}\n{ROW.replace('0,0,0,1,', '0,0,0,0,', 1)}\n", status=2))
        self.assertIn("pairs.csv:2:", self.answer(f"{NAMES}\n{ROW},1\n", status=2))
        self.assertIn("ahx", self.answer(f"{NAMES.replace('ahx', 'ahxx')}\n{ROW}\n", status=2))
        self.assertIn("22", self.answer("a,b,c\n1,2,3\n", status=2))
        self.assertIn("sat", self.answer(f"{NAMES}\n{ROW}\n", "--narrow-phase", "satt", status=2))
        self.assertIn("nothing.csv", self.run_program("--pairs", "nothing.csv", status=2))

    def test_side_by_side(self):
        said = self.run_program("--count", 200, "--out", "out")
        self.assertIn("sat_course_report calls up to", said)
        rows = read(self.folder / "out/comparison.csv")
        for row in rows:
            if row["narrow_phase"] == "sat":
                self.assertEqual((row["wrong_overlaps"], row["missed_overlaps"]), ("0", "0"))
            if row["narrow_phase"] == "sat_course_report":
                self.assertEqual(row["missed_overlaps"], "0")
        wrong = {r["class"]: int(r["wrong_overlaps"]) for r in rows if r["narrow_phase"] == "sat_course_report"}
        self.assertGreater(wrong["edge to edge"], 20)
        with open(self.folder / "out/course_report.csv", newline="", encoding="utf-8") as file:
            shares = [float(r["share_of_pairs_apart"]) for r in csv.DictReader(file)]
        self.assertEqual(shares[0], 0)  # parallel cubes are told apart by A's faces alone
        self.assertGreater(max(shares), 0.2)
        self.assertGreater((self.folder / "out/figures/course_report_errors.svg").stat().st_size, 1000)
        made = {str(p.relative_to(self.folder / "out")) for p in (self.folder / "out").rglob("*") if p.is_file()}
        drawn = {f"{name}.{ending}" for name in ("figures/course_report_errors", "timings/cost_of_questions")
                 for ending in ("dat", "gp", "pdf", "svg", "tex")}
        self.assertEqual(made - drawn, {"report.html", "comparison.csv", "course_report.csv", "figures/style.gnuplot", "timings/style.gnuplot",
                                        *(f"{name}.{ending}" for name in ("tables/agreement", "timings/costs")
                                          for ending in ("csv", "md", "tex"))})
        page = (self.folder / "out/report.html").read_text(encoding="utf-8")
        for word in ("vertex to vertex", "data:image/svg+xml", "narrow_phase --count 200 --out out"):
            self.assertIn(word, page)
        self.assertNotIn("runs.csv", page)
        self.run_program("--count", 200, "--no-figures", "--out", "again")
        for name in ("comparison.csv", "course_report.csv"):
            self.assertEqual((self.folder / "again" / name).read_bytes(), (self.folder / "out" / name).read_bytes())

    def test_the_catalogue_is_listed(self):
        said = self.run_program("--list", "narrow-phases")
        for name in ("sat", "gjk", "sat_course_report"):
            self.assertIn(f"  {name} ", said)


if __name__ == "__main__":
    unittest.main()
