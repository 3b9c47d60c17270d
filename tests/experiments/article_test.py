# SPDX-License-Identifier: BSD-3-Clause
"""The article of a study (--article), and tables in LaTeX, Markdown and CSV with what is best in them marked."""
import os
import re
import shutil
import subprocess
import unittest

import latex
from programs import BIN, call, read, temporary_folder

STUDY = ["--integrator", "explicit_euler,rk4,dmv,cvode_adams", "--dt", "0.02,0.01,0.005", "--tolerance", "1e-6,1e-8",
         "--no-figures"]
SECTIONS = ("answer", "results", "figures", "methods", "scenarios", "provenance")


class Article(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out = cls.folder / "out"
        cls.done = call("energy_drift", *STUDY, "--article", "--out", cls.out, folder=cls.folder)
        cls.article = cls.out / "article"

    def text(self, name):
        return (self.article / f"{name}.tex").read_text(encoding="utf-8")

    def test_every_number_of_the_prose_is_a_command(self):
        for section in (*SECTIONS, "article"):
            with self.subTest(section=section):
                text = self.text(section)
                if section == "article":
                    text = text[text.index(r"\title"):]
                self.assertEqual(latex.digits_in_prose(text), [])
        used = set(re.findall(r"\\(polhode[A-Z]\w*)", "".join(map(self.text, (*SECTIONS, "article")))))
        defined = re.findall(r"\\newcommand\{\\(polhode\w+)\}", self.text("numbers"))
        self.assertEqual(len(defined), len(set(defined)))
        self.assertGreater(len(used), 20)
        self.assertLessEqual(used, set(defined))

    def test_a_digit_in_prose_is_found(self):
        self.assertEqual(latex.digits_in_prose(r"\name{rk4} at \polhodeAnswerA{} s $y_1$ \cite{a2000} % 5"), [])
        self.assertEqual(latex.digits_in_prose("about 7 times"), ["about 7 times"])

    def test_the_answer_is_that_of_the_report(self):
        """With its commands put in, the answer reads as the report's does."""
        page = (self.out / "report.html").read_text(encoding="utf-8")
        said = re.sub("<[^>]*>", "", re.search(r'<p class="answer first">(.*?)</p>', page).group(1))
        text = self.text("answer")
        for name, value in re.findall(r"\\newcommand\{\\(polhode\w+)\}\{\\ensuremath\{(.*)\}\}", self.text("numbers")):
            value = re.sub(r"^10\^\{(.*)\}$", r"1e\1", value)
            value = re.sub(r"\\times10\^\{(.*)\}$", r"e\1", value)
            text = text.replace("\\" + name + "{}", value)
        text = re.sub(r"\\name\{((?:[^{}]|\{[^{}]*\})*)\}", r"\1", text).replace(r"\allowbreak{}", "").replace("\\_", "_")
        self.assertIn(said, text)

    def test_methods_with_equations_and_sources_scenario_and_provenance(self):
        methods = self.text("methods")
        bibliography = (self.article / "references.bib").read_text(encoding="utf-8")
        for method in ("explicit\\_\\allowbreak{}euler", "rk4", "dmv"):
            self.assertIn(f"\\name{{{method}}}", methods)
        self.assertIn(r"y_{n+1} &= y_n + h\,f(t_n, y_n)", methods)
        for keys in re.findall(r"\\cite\{([^}]*)\}", methods):
            for key in keys.split(","):
                self.assertIn("{" + key + ",", bibliography)
        self.assertIn(r"\input{tables/bodies_", self.text("scenarios"))
        self.assertIn("10 & (", (self.article / "tables" / "bodies_1.tex").read_text(encoding="utf-8").replace("$", ""))
        provenance = self.text("provenance")
        for what in ("Command", "Compiler", "Processor", "Hash of the study"):
            self.assertIn(f"[{what}]", provenance)
        self.assertIn("energy_drift", provenance.replace(r"\_\allowbreak{}", "_"))

    def test_the_same_command_gives_the_same_bytes(self):
        before = {f: f.read_bytes() for f in self.article.rglob("*.tex")}
        again = call("energy_drift", *STUDY, "--article", "--out", self.out, folder=self.folder)
        self.assertEqual(again.stdout, self.done.stdout)
        self.assertEqual({f: f.read_bytes() for f in self.article.rglob("*.tex")}, before)

    @unittest.skipUnless(latex.PDFLATEX, latex.WITHOUT_PDFLATEX)
    def test_the_article_compiles_without_a_complaint(self):
        self.assertTrue((self.article / "article.pdf").read_bytes().startswith(b"%PDF"))
        log = (self.article / "article.log").read_text(encoding="utf-8", errors="replace")
        self.assertEqual(latex.complaints(log), [])

    @unittest.skipUnless(latex.PDFLATEX, latex.WITHOUT_PDFLATEX)
    def test_the_values_are_commands_of_a_document(self):
        values = self.out / "tables" / "values.tex"
        name = re.search(r"(polhode\w+EnergyDriftMax)\}", values.read_text(encoding="utf-8")).group(1)
        text = latex.PREAMBLE + r"\begin{document}\input{%s}The drift is \%s.\end{document}" % (values, name)
        self.assertEqual(latex.compiled(text, self.folder / "values"), [])

    def test_without_pdflatex_it_says_so(self):
        shutil.copytree(self.out, self.folder / "copy")
        empty = self.folder / "empty"
        empty.mkdir()
        done = subprocess.run([str(BIN / "energy_drift"), *STUDY, "--article", "--out", str(self.folder / "copy")],
                              capture_output=True, text=True, env={**os.environ, "PATH": str(empty)}, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("pdflatex is not installed", done.stderr)
        self.assertIn("texlive-latex-recommended", done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)
        self.assertFalse((self.folder / "copy/article/article.pdf").exists())
        self.assertTrue((self.folder / "copy/article/article.tex").exists())


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out = cls.folder / "out"
        call("energy_drift", *STUDY[:-1], "--out", cls.out, folder=cls.folder)

    def test_what_is_best_is_marked_alike_in_all_three(self):
        rows = read(self.out / "tables/summary.csv")
        header = "attitude error (rad)"
        least = min(float(row[header]) for row in rows)
        best = [row for row in rows if "attitude error" in row["best"].split("; ")]
        self.assertTrue(best)
        self.assertEqual({float(row[header]) for row in best}, {least})
        self.assertEqual(len(best), sum(float(row[header]) == least for row in rows))
        markdown = (self.out / "tables/summary.md").read_text(encoding="utf-8")
        bold = re.findall(r"\*\*(.*?)\*\*", markdown)
        self.assertIn(best[0][header], bold)
        marks = sum(len(row["best"].split("; ")) for row in rows if row["best"])
        self.assertEqual(len(bold), marks)
        tex = (self.out / "tables/summary.tex").read_text(encoding="utf-8")
        self.assertEqual(tex.count(r"\mathbf"), marks)

    def test_the_runs_agree_with_runs_csv(self):
        runs = read(self.out / "runs.csv")
        rows = read(self.out / "tables/summary.csv")
        self.assertEqual(len(rows), len(runs))
        for row, run in zip(rows, runs):
            self.assertEqual(row["method"], run["integrator"])
            self.assertAlmostEqual(float(row["attitude error (rad)"]) / float(run["attitude_error_max_rad"]), 1, delta=0.01)

    def test_method_by_method_is_a_table_of_its_own(self):
        rows = read(self.out / "tables/methods.csv")
        self.assertEqual({row["method"] for row in rows}, {"explicit_euler", "rk4", "dmv", "cvode_adams"})
        for ending in ("tex", "md"):
            self.assertTrue((self.out / f"tables/methods.{ending}").exists())

    @unittest.skipUnless(latex.PDFLATEX, latex.WITHOUT_PDFLATEX)
    def test_tables_and_figures_compile_without_a_complaint(self):
        files = [*sorted((self.out / "tables").glob("[!v]*.tex")), *sorted((self.out / "figures").glob("*.tex"))]
        self.assertEqual(latex.compiled(latex.document(files), self.folder / "tex"), [])

    @unittest.skipUnless(latex.PDFLATEX, latex.WITHOUT_PDFLATEX)
    def test_a_table_that_is_too_wide_is_found(self):
        wide = self.folder / "wide.tex"
        wide.write_text(r"\begin{tabular}{%s}%s\\\end{tabular}" % ("l" * 40, " & ".join(["word"] * 40)), encoding="utf-8")
        self.assertTrue(any("Overfull" in c for c in latex.compiled(latex.document([wide]), self.folder / "wide")))


if __name__ == "__main__":
    unittest.main()
