# SPDX-License-Identifier: BSD-3-Clause
"""The default study of every experiment in LaTeX: its article, every table, every figure and the values of a method compile
with pdflatex without an error, a warning or an overfull box; and every word of its figures has a German one.
POLHODE_ARTICLES is a folder to keep them in."""
import os
import pathlib
import re
import unittest

import figure_words
import latex
from programs import call, temporary_folder
import programs

# Default studies; broad_phase with fewer boxes than by default, which take minutes.
EXPERIMENTS = {"energy_drift": [], "simulate": [], "convergence": [], "certificate": [], "work_precision": [],
               "precision": [], "stability": [], "impact": [], "stack": [], "pile": [], "joints": [],
               "broad_phase": ["--bodies", "100,1000"], "narrow_phase": ["--count", "200"]}
programs.PATIENCE = 1200
MAY_HAVE_NONE = ("viewer", "replay", "results", "rerun", "explain", "archive", "judge", "figures",
                 "plot")  # they carry out no study
FAILING_RUNS = ("work_precision",)  # a method has no solution at the largest step: status 3


@unittest.skipUnless(latex.PDFLATEX, latex.WITHOUT_PDFLATEX)
class Everything(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        keep = os.environ.get("POLHODE_ARTICLES")
        cls.folder = pathlib.Path(keep).resolve() if keep else temporary_folder(cls.addClassCleanup)

    def test_no_experiment_is_forgotten(self):
        source = pathlib.Path(__file__).resolve().parents[2] / "experiments"
        for main in source.glob("*/main.cpp"):
            self.assertIn(main.parent.name, (*EXPERIMENTS, *MAY_HAVE_NONE, "methods"))

    def test_a_table_that_pdflatex_refuses_is_found(self):
        bad = self.folder / "bad.tex"
        bad.write_text("\\begin{tabular}{l}ω\\\\\\end{tabular}", encoding="utf-8")
        self.assertTrue(latex.compiled(latex.document([bad]), self.folder / "bad"))


def everything(experiment, options):
    def test(self):
        out = self.folder / experiment
        status = 3 if experiment in FAILING_RUNS else 0
        done = call(experiment, *options, "--article", "--out", out, folder=self.folder, status=status)
        self.assertEqual(done.stderr.count("pdflatex is not installed"), 0)
        log = (out / "article/article.log").read_text(encoding="utf-8", errors="replace")
        self.assertEqual(latex.complaints(log), [], "article")
        self.assertTrue((out / "article/article.pdf").exists())
        for section in (out / "article").glob("*.tex"):
            if section.stem not in ("numbers", "article"):
                self.assertEqual(latex.digits_in_prose(section.read_text(encoding="utf-8")), [], section)
        files = [f for where in ("tables", "figures", "timings") for f in sorted((out / where).glob("*.tex"))
                 if not f.stem.startswith("values")]
        self.assertTrue(files)
        self.assertEqual(latex.compiled(latex.document(files), out / "latex"), [], "tables and figures")
        for values in sorted((out / "tables").glob("values*.tex"), key=lambda f: -f.stat().st_size)[:2]:
            name = re.search(r"\\newcommand\{\\(polhode\w+)\}", values.read_text(encoding="utf-8")).group(1)
            text = latex.PREAMBLE + r"\begin{document}\input{%s}It is \%s.\end{document}" % (values, name)
            self.assertEqual(latex.compiled(text, out / "latex", values.stem), [], values)
        english = figure_words.of_folder(out)
        done = call(experiment, *options, "--figure-language", "de", "--out", out, folder=self.folder, status=status)
        self.assertNotIn("has no words", done.stderr)
        self.assertEqual(figure_words.left_in_english(english, figure_words.of_folder(out), "de"), [])
    return test


for name, arguments in EXPERIMENTS.items():
    setattr(Everything, f"test_{name}", everything(name, arguments))


if __name__ == "__main__":
    unittest.main()
