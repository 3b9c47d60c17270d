# SPDX-License-Identifier: BSD-3-Clause
"""The default study of every experiment, carried out once:
- its page is small, in fewer words than gnuplot's, and without a fault in a browser, and its statements are true;
- its article, its tables and the values of a method compile with pdflatex without an error, a warning or an overfull box;
- every word of its figures has a German one.
POLHODE_STUDIES is a folder to keep them in."""
import os
import pathlib
import re
import shutil
import unittest

import default_statements
import figure_words
import latex
from browser import PROGRAM, Browser
from programs import call, temporary_folder
from report_page_test import LARGEST

# The default study of methods takes half an hour and has its own tests.
EXPERIMENTS = ("energy_drift", "simulate", "convergence", "certificate", "work_precision", "precision", "stability", "impact",
               "stack", "pile", "joints", "broad_phase", "narrow_phase")
WITHOUT_FIGURES = ("certificate",)
MAY_HAVE_NONE = ("viewer", "replay", "results", "rerun", "explain", "archive", "judge", "figures",
                 "plot")  # they carry out no study
STATUS = {"work_precision": 3}  # a method has no solution at the largest step
PATIENCE = 1200  # s


class DefaultStudies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        keep = os.environ.get("POLHODE_STUDIES")
        cls.folder = pathlib.Path(keep).resolve() if keep else temporary_folder(cls.addClassCleanup)
        cls.folder.mkdir(exist_ok=True)

    def carry_out(self, experiment, *options):
        return call(experiment, *options, "--out", experiment, folder=self.folder,
                    status=STATUS.get(experiment, 0), patience=PATIENCE).stderr

    def check(self, experiment):
        errors = self.carry_out(experiment, *(["--article"] if latex.PDFLATEX else []))
        self.assertNotIn("pdflatex is not installed", errors)
        in_figures = None if shutil.which("gnuplot") else "gnuplot is not installed"
        in_browser = in_figures or (None if PROGRAM else "chromium is not installed")
        in_latex = None if latex.PDFLATEX else latex.WITHOUT_PDFLATEX
        for check, missing in ((self.check_page, in_browser), (self.check_statements, None), (self.check_article, in_latex),
                               (self.check_tables, in_latex), (self.check_words, in_figures)):
            with self.subTest(check.__name__):
                if missing:
                    self.skipTest(f"skipped, because {missing}")
                check(experiment, self.folder / experiment)

    def check_page(self, _, out):
        page = out / "report.html"
        self.assertLess(page.stat().st_size, LARGEST)
        self.assertNotIn("%3c%3fxml", page.read_text(encoding="utf-8"))  # a picture taken over as gnuplot wrote it
        with Browser() as browser:
            browser.open(page, width=390, height=844, ready="true")
            self.assertEqual(browser.errors, [])
            self.assertEqual([url for url in browser.requests if not url.startswith(("file:", "data:"))], [])
            self.assertLessEqual(browser.run("document.scrollingElement.scrollWidth"), 390)

    def check_statements(self, experiment, out):
        if experiment not in default_statements.OF:
            return  # statements_test.py has it, or it makes none
        wrong, counted = default_statements.faults(experiment, out)
        self.assertEqual(wrong, [])
        self.assertGreaterEqual(counted, 3)

    def check_article(self, _, out):
        log = (out / "article/article.log").read_text(encoding="utf-8", errors="replace")
        self.assertEqual(latex.complaints(log), [])
        self.assertTrue((out / "article/article.pdf").exists())
        for section in (out / "article").glob("*.tex"):
            if section.stem not in ("numbers", "article"):
                self.assertEqual(latex.digits_in_prose(section.read_text(encoding="utf-8")), [], section)

    def check_tables(self, _, out):
        """Tables, those figures that are not in the article, and the two largest files of values."""
        within = {file.read_bytes() for file in (out / "article/figures").glob("*.tex")}
        files = [f for where in ("tables", "figures", "timings") for f in sorted((out / where).glob("*.tex"))
                 if not f.stem.startswith("values") and f.read_bytes() not in within]
        self.assertTrue(files)
        self.assertEqual(latex.compiled(latex.document(files), out / "latex"), [])
        for values in sorted((out / "tables").glob("values*.tex"), key=lambda f: -f.stat().st_size)[:2]:
            name = re.search(r"\\newcommand\{\\(polhode\w+)\}", values.read_text(encoding="utf-8")).group(1)
            text = latex.PREAMBLE + r"\begin{document}\input{%s}It is \%s.\end{document}" % (values, name)
            self.assertEqual(latex.compiled(text, out / "latex", values.stem), [], values)

    def check_words(self, experiment, out):
        english = figure_words.of_folder(out)
        self.assertEqual(english == {}, experiment in WITHOUT_FIGURES)
        self.assertNotIn("has no words", self.carry_out(experiment, "--figure-language", "de"))
        self.assertEqual(figure_words.left_in_english(english, figure_words.of_folder(out), "de"), [])

    def test_no_experiment_is_forgotten(self):
        source = pathlib.Path(__file__).resolve().parents[2] / "experiments"
        for main in source.glob("*/main.cpp"):
            self.assertIn(main.parent.name, (*EXPERIMENTS, *MAY_HAVE_NONE, "methods"))

    @unittest.skipUnless(latex.PDFLATEX, latex.WITHOUT_PDFLATEX)
    def test_a_table_that_pdflatex_refuses_is_found(self):
        bad = self.folder / "bad.tex"
        bad.write_text("\\begin{tabular}{l}ω\\\\\\end{tabular}", encoding="utf-8")
        self.assertTrue(latex.compiled(latex.document([bad]), self.folder / "bad"))


for name in EXPERIMENTS:
    setattr(DefaultStudies, f"test_{name}", lambda self, name=name: self.check(name))


if __name__ == "__main__":
    unittest.main()
