# SPDX-License-Identifier: BSD-3-Clause
"""The guide: it builds without a warning, stands alone, and has a page for each method and a line for each option, key and column.

POLHODE_BIN_DIR is the folder of the programs.
"""
import concurrent.futures
import html.parser
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/experiments"), str(ROOT / "tests/guide"), str(ROOT / "guide")]
import blocks_slow_test  # noqa: E402
import browser  # noqa: E402
from programs import BIN, temporary_folder  # noqa: E402

BUILD = [sys.executable, "-B", str(ROOT / "guide/generate/book.py")]
SECTIONS = ("Derivation", "What it conserves, and why", "When to use it", "Try it", "Sources")


def missing():
    """Why the book cannot be made here, or an empty text."""
    if not (BIN / "simulate").exists():
        return "there is no simulate"
    done = subprocess.run([sys.executable, "-c", "import sphinx, myst_parser, furo, pybtex"], capture_output=True, text=True, check=False)
    if done.returncode:
        return done.stderr.strip().splitlines()[-1]
    return "" if pathlib.Path("/usr/share/javascript/mathjax/MathJax.js").exists() else "there is no MathJax"


class Page(html.parser.HTMLParser):
    """The anchors and references of a page, and its text."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.references, self.text = set(), [], ""
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            if name in ("href", "src", "action", "data", "poster", "srcset") and value and not (tag == "use" and value.startswith("#")):
                self.references.append(value)

    def handle_data(self, data):
        self.text += data


def broken(folder, pages):
    """The references of pages that lead out of the folder or nowhere, as lines."""
    found = []
    for path, page in pages.items():
        for reference in page.references:
            place = urllib.parse.urlsplit(reference)
            if place.scheme or place.netloc:
                found.append(f"{path}: {reference} leads out of the book")
                continue
            there = os.path.normpath(folder / pathlib.Path(path).parent / urllib.parse.unquote(place.path)) if place.path else str(folder / path)
            name = os.path.relpath(there, folder)
            if not os.path.exists(there) or name.startswith(".."):
                found.append(f"{path}: {reference} leads nowhere")
            elif place.fragment and name in pages and urllib.parse.unquote(place.fragment) not in pages[name].anchors:
                found.append(f"{path}: {reference}: there is no such anchor")
    return found


class Book(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        why = missing()
        if why:
            raise unittest.SkipTest(f"skipped, because {why}")
        cls.folder = temporary_folder(cls.addClassCleanup)
        done = subprocess.run([*BUILD, str(BIN), str(cls.folder)], capture_output=True, text=True, timeout=600, check=False)
        if done.returncode:
            raise AssertionError(f"the book was not made: {done.stderr[-3000:]}")
        cls.said, cls.html = done, cls.folder / "html"
        cls.pages = {path.relative_to(cls.html).as_posix(): Page(path) for path in cls.html.rglob("*.html")
                     if "_static" not in path.relative_to(cls.html).parts}
        listed = subprocess.run([str(BIN / "simulate"), "--list", "json"], capture_output=True, text=True, check=True).stdout
        cls.catalogues = json.loads(listed)

    def test_it_builds_without_a_warning_and_prints_its_first_page(self):
        self.assertEqual(self.said.stderr, "")
        self.assertEqual(self.said.stdout, f"{self.html / 'index.html'}\n")
        self.assertGreaterEqual(len(self.pages), 120)

    def test_references_stay_in_the_book_and_lead_somewhere(self):
        self.assertEqual(broken(self.html, self.pages), [])

    def test_styles_ask_nothing_of_a_network(self):
        for path in self.html.rglob("*.css"):
            with self.subTest(path.name):
                self.assertEqual(re.findall(r"(?:url\(|@import)\s*['\"]?(?:https?:|/)[^)'\"]*", path.read_text(encoding="utf-8")), [])

    def test_broken_references_are_found(self):
        (self.html / "planted.html").write_text('<a href="https://example.org">a</a><a href="nowhere.html">b</a><a href="index.html#no">c</a>'
                                                '<img src="//x/y.png"><a href="index.html">d</a>', encoding="utf-8")
        self.addCleanup((self.html / "planted.html").unlink)
        self.assertEqual(len(broken(self.html, {**self.pages, "planted.html": Page(self.html / "planted.html")})), 4)

    def test_every_method_has_a_page_in_full(self):
        for method in self.catalogues["integrators"]:
            with self.subTest(method["name"]):
                page = self.pages[f"methods/{method['name']}.html"]
                for section in SECTIONS:
                    self.assertIn(section, page.text)
                equation = re.sub(r"\s+", "", method["equation"])
                self.assertIn(equation, re.sub(r"\s+", "", page.text))
                own = (ROOT / "guide/methods" / f"{method['name']}.md").read_text(encoding="utf-8")
                for section in SECTIONS[:3]:
                    part = re.search(rf"^## {section}\n(.*?)(?=^## |\Z)", own, re.DOTALL | re.MULTILINE)[1]
                    self.assertGreater(len(part.split()), 15, section)
                self.assertGreater(len(own.split()), 100)

    def test_the_reference_has_every_option_key_and_column(self):
        def text(page):
            return self.pages[f"reference/{page}.html"].text
        for option in self.catalogues["options"]:
            self.assertIn(option["option"], text("options"))
            self.assertIn(option["column"], text("columns"))
        for metric in self.catalogues["metrics"]:
            self.assertIn(metric["column"], text("columns"))
        for kind in ("scenario-keys", "body-keys"):
            for key in self.catalogues[kind]:
                self.assertIn(key["key"], text("scenario_keys"))
                self.assertIn(f"{key['key']}", text("scenarios"))
        for kind in ("forces", "shapes", "invariants"):
            for entry in self.catalogues[kind]:
                self.assertIn(entry["name"], text("scenario_keys"))
                for key in entry.get("keys", []):
                    self.assertIn(key["key"], text("scenario_keys"))
        for main in (ROOT / "experiments").glob("*/main.cpp"):
            self.assertIn(f"reference/programs/{main.parent.name}.html", self.pages)

    def test_commands_of_method_pages_are_carried_out(self):
        """The studies are made small as in blocks_slow_test.py; the certificates, which take minutes, are planned."""
        from generate import methods

        def fault(line):
            words = blocks_slow_test.made_small(line.split())
            if words[1] == "certificate":
                words = line.split() + ["--dry-run"]
            if not (BIN / words[1]).exists():
                return ""
            folder = temporary_folder(self.addCleanup)
            done = subprocess.run([str(BIN / words[1]), *words[2:]], cwd=folder, capture_output=True, text=True, timeout=300, check=False)
            return f"{line}: {done.stderr}" if done.returncode else ""
        lines = [line for method in self.catalogues["integrators"] for line in methods.trial(method).splitlines()]
        self.assertEqual(len(lines), 2 * len(self.catalogues["integrators"]))
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            self.assertEqual([told for told in pool.map(fault, lines) if told], [])

    def test_it_opens_without_a_network_and_is_searched(self):
        if not browser.PROGRAM:
            self.skipTest("skipped, because there is no Chromium")
        with browser.Browser() as tab:
            for page in ("methods/dmv.html", "methods/notation.html"):
                tab.do("Page.navigate", url=(self.html / page).as_uri())
                tab.wait_for(f"location.pathname.endsWith('{page}') && document.querySelectorAll('.math').length > 9 && "
                             "[...document.querySelectorAll('.math')].every((formula) => formula.querySelector('svg'))")
                self.assertEqual(tab.run("document.querySelectorAll('.MathJax_Error, .merror, [fill=\"red\"]').length"), 0)
            tab.do("Page.navigate", url=(self.html / "search.html").as_uri() + "?q=Casimir")
            tab.wait_for("document.querySelectorAll('#search-results li').length > 5")
            self.assertEqual([error for error in tab.errors], [])
            self.assertEqual([url for url in tab.requests if not url.startswith(("file:", "data:", "about:"))], [])


class Warnings(unittest.TestCase):
    def test_a_link_that_leads_nowhere_is_an_error(self):
        why = missing()
        if why:
            self.skipTest(f"skipped, because {why}")
        folder = temporary_folder(self.addCleanup)
        (folder / "conf.py").write_text('extensions = ["myst_parser"]\n', encoding="utf-8")
        for text, status in (("# A\n\n[b](nowhere.md)\n", 1), ("# A\n", 0)):
            (folder / "index.md").write_text(text, encoding="utf-8")
            done = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", str(folder), str(folder / "html")],
                                  capture_output=True, check=False)
            self.assertEqual(done.returncode, status)


if __name__ == "__main__":
    unittest.main()
