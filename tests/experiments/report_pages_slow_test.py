# SPDX-License-Identifier: BSD-3-Clause
"""The pages of default studies: small, in fewer words than gnuplot's, and without a fault in a browser."""
import shutil
import unittest

from browser import PROGRAM, Browser
from programs import call, temporary_folder
from report_page_test import LARGEST

PATIENCE = 1400  # s
# The default study of methods takes half an hour and has its own tests.
EXPERIMENTS = ["broad_phase", "certificate", "convergence", "energy_drift", "impact", "joints", "narrow_phase", "pile", "precision",
               "simulate", "stability", "stack", "work_precision"]
STATUS = {"work_precision": 3}  # a run of dmv has no solution


@unittest.skipUnless(PROGRAM and shutil.which("gnuplot"), "skipped, because chromium or gnuplot is not installed")
class ReportPages(unittest.TestCase):
    def test_they_are_small_and_without_a_fault(self):
        folder = temporary_folder(self.addCleanup)
        for experiment in EXPERIMENTS:
            with self.subTest(experiment):
                call(experiment, "--out", experiment, folder=folder, status=STATUS.get(experiment, 0), patience=PATIENCE)
                page = folder / experiment / "report.html"
                self.assertLess(page.stat().st_size, LARGEST)
                text = page.read_text(encoding="utf-8")
                self.assertNotIn("%3c%3fxml", text)  # a picture that was taken over as gnuplot wrote it
                with Browser() as browser:
                    browser.open(page, width=390, height=844, ready="true")
                    self.assertEqual(browser.errors, [])
                    self.assertEqual([url for url in browser.requests if not url.startswith(("file:", "data:"))], [])
                    self.assertLessEqual(browser.run("document.scrollingElement.scrollWidth"), 390)


if __name__ == "__main__":
    unittest.main()
