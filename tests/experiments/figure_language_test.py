# SPDX-License-Identifier: BSD-3-Clause
"""--figure-language: the words of figures in another language, for experiments, figures and plot alike."""
import shutil
import unittest

import figure_words
import latex
from programs import call, temporary_folder

STUDY = ["--scenario", "peters_hsu,lagrange_top", "--integrator", "explicit_euler,rk4,dmv,cvode_adams", "--dt", "0.5,0.05,0.005",
         "--tolerance", "1e-5,1e-7"]  # dmv has no solution at the largest step: status 3
BALL = ["--scenario", "bouncing_ball", "--integrator", "rk4", "--dt", "0.005"]


@unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed: no figures are drawn")
class FigureLanguage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        call("energy_drift", *STUDY, "--figure-title", "on", "--out", "study", folder=cls.folder, status=3)
        call("simulate", *BALL, "--no-figures", "--out", "ball", folder=cls.folder)

    def said(self, program, *arguments, status=0):
        return call(program, *arguments, folder=self.folder, status=status)

    def test_every_word_of_a_study_is_translated(self):
        english = figure_words.of_folder(self.folder / "study")
        self.assertIn("time (s)", set().union(*english.values()))
        for language in ("de", "fr", "es"):
            out = self.folder / language
            done = self.said("figures", "study", "--figure-title", "on", "--figure-language", language, "--out", out)
            self.assertEqual(done.stderr, "")
            there = figure_words.of_folder(out)
            self.assertEqual(figure_words.left_in_english(english, there, language), [])
            self.assertIn(figure_words.phrases(language)["time"] + " (s)", set().union(*there.values()))

    def test_a_word_left_in_english_is_found(self):
        english = {"a.svg": {"largest energy drift (relative)", "rk4", "dt = 0.1 s"}}
        self.assertEqual(figure_words.left_in_english(english, english, "de"),
                         ["a.svg: largest energy drift"])

    def test_every_word_of_plot_is_translated(self):
        quantities = [line.split()[0] for line in self.said("plot", "--list").stdout.splitlines() if line.split()]
        for study, where in (("study", "scenario == 'peters_hsu' and dt == 0.05"), ("ball", "dt > 0")):
            look = ["--where", where, "--quantity", ",".join(quantities), "--figure-title", "on"]
            self.said("plot", study, *look, "--out", f"{study}_en", status=3)
            done = self.said("plot", study, *look, "--figure-language", "de", "--out", f"{study}_de", status=3)
            self.assertNotIn("has no words", done.stderr)
            english, german = (figure_words.of_folder(self.folder / f"{study}_{l}") for l in ("en", "de"))
            self.assertGreater(len(english), 8)
            self.assertEqual(figure_words.left_in_english(english, german, "de"), [])

    def test_a_file_of_ones_own_and_what_it_lacks(self):
        (self.folder / "mine.toml").write_text('"time" = "tid"\n"energy drift" = "energidrift"\n', encoding="utf-8")
        done = self.said("figures", "study", "--figure-language", "mine.toml", "--figure", "drift_against_time", "--out", "own")
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("mine.toml has no words for 'diverged or off scale'", done.stderr)
        words = set().union(*figure_words.of_folder(self.folder / "own").values())
        self.assertLessEqual({"tid (s)", "energidrift (relative)"}, words)

    def test_data_are_the_same_in_every_language_and_a_study_takes_the_option(self):
        self.said("energy_drift", *STUDY, "--out", "german", "--figure-language", "de", status=3)
        self.said("energy_drift", *STUDY, "--out", "english", status=3)
        for data in (self.folder / "english/figures").glob("*.dat"):
            self.assertEqual(data.read_bytes(), (self.folder / "german/figures" / data.name).read_bytes())
        page = (self.folder / "german/report.html").read_text(encoding="utf-8")
        self.assertIn("drift_against_time", page)

    def test_an_unknown_language_is_refused(self):
        done = self.said("figures", "study", "--figure-language", "deu", status=2)
        self.assertIn("no language 'deu'; did you mean 'de'?", done.stderr)
        self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1))

    @unittest.skipUnless(latex.PDFLATEX, latex.WITHOUT_PDFLATEX)
    def test_latex_of_each_language_compiles_without_a_complaint(self):
        for language in ("de", "fr", "es"):
            out = self.folder / f"tex_{language}"
            self.said("figures", "study", "--figure-language", language, "--out", out)
            files = sorted((out / "figures").glob("*.tex"))
            self.assertTrue(files)
            self.assertEqual(latex.compiled(latex.document(files), out / "latex"), [], language)


if __name__ == "__main__":
    unittest.main()
