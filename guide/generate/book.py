# SPDX-License-Identifier: BSD-3-Clause
"""Makes the guide: generates its pages, calls sphinx-build with warnings as errors, and prints the path of its first page.

usage: python3 -B guide/generate/book.py FOLDER_OF_PROGRAMS FOLDER_OF_THE_BOOK
The book is FOLDER_OF_THE_BOOK/html; the pages that it was made from are beside it.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "guide"))
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")  # of node-normalize.css, which furo needs
MATHJAX_PARTS = ("MathJax.js", "config/TeX-AMS_SVG-full.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/SVG/autoload",
                 "jax/output/SVG/fonts/TeX", "jax/output/SVG/config.js", "jax/output/SVG/jax.js")


def catalogues(programs):
    listed = subprocess.run([programs / "simulate", "--list", "json"], capture_output=True, text=True, check=True)
    return json.loads(listed.stdout)


def with_parts(text, readmes, page, out):
    """The text with each line `<!-- README "START" to "END" -->` replaced by that part of the README (its path may differ)."""
    from generate.readmes import between

    def part(match):
        source = (ROOT / match[1]).read_text(encoding="utf-8")
        return readmes.text(match[1], page, out, between(source, match[2], match[3]).rstrip())
    return re.sub(r'^<!-- (\S+README\.md|README\.md) "(.*?)" to "(.*?)" -->$', part, text, flags=re.MULTILINE)


def read_alone(html):
    """Makes the theme's files work from a folder: Debian's package names a style of the server, and a module, which browsers do not
    load from files."""
    def change(path, old, new):
        text = path.read_text(encoding="utf-8")
        if old not in text:
            raise SystemExit(f"guide: {path.name} of the theme is not as expected; it has no {old}")
        path.write_text(text.replace(old, new), encoding="utf-8")
    change(html / "_static/styles/furo.css", "@import url(/javascript/normalize.css/normalize.css);", NORMALIZE.read_text(encoding="utf-8"))
    scripts = html / "_static/scripts"
    change(scripts / "furo.js", 'import Gumshoe from "./gumshoe-patched.js";', (scripts / "gumshoe-patched.js").read_text(encoding="utf-8"))


def toctree(entries):
    return "\n```{toctree}\n:hidden:\n\n" + "\n".join(entries) + "\n```\n"


# The study whose figures the book shows: made when the book is, so that they look as those of the reader's own studies.
STUDY = ["--scenario", "hairer_vilmart", "--integrator", "explicit_euler,rk4,mclachlan_reich,dmv,gauss4", "--dt", "1e-2:0.5:7:log",
         "--t-end", "50"]


def shell(words):
    return " ".join(["./run energy_drift", *words]).replace(" --dt", " \\\n    --dt")


class Book:
    def __init__(self, programs, folder):
        from generate.bibliography import Bibliography
        from generate.readmes import Readmes
        self.programs, self.pages = programs, folder / "pages"
        shutil.rmtree(self.pages, ignore_errors=True)
        self.pages.mkdir(parents=True)
        self.readmes = Readmes(ROOT)
        self.bibliography = Bibliography(ROOT / "papers/references.bib")
        self.catalogues = catalogues(programs)

    def write(self, page, text):
        path = self.pages / f"{page}.md"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def study(self):
        """Carries out the study of the figures. A run whose step is too long for its method is a result."""
        folder = self.pages.parent / "study"
        shutil.rmtree(folder, ignore_errors=True)
        done = subprocess.run([self.programs / "energy_drift", *STUDY, "--out", folder], capture_output=True, text=True, check=False)
        if done.returncode not in (0, 3):
            raise SystemExit(f"guide: the study of its figures was not carried out: {done.stderr}")
        return folder / "figures"

    def with_figures(self, page, text, figures):
        """The text with each line `<!-- figure NAME "what is seen" -->` replaced by the figure, and `<!-- figures -->` by the command."""
        def figure(match):
            source = figures / f"{match[1]}.svg"
            if not source.exists():
                return f"*No picture of `{match[1]}`: gnuplot was not there when this book was made.*"
            copy = self.pages / "pictures/study" / source.name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, copy)
            return f"![{match[2]}]({os.path.relpath(copy, (self.pages / page).parent)})"
        text = re.sub(r'^<!-- figure (\w+) "(.*?)" -->$', figure, text, flags=re.MULTILINE)
        return text.replace("<!-- figures -->", f"```sh\n{shell(STUDY)}\n```")

    def written_pages(self):
        """The pages that stand in guide/, with the parts of READMEs that they name."""
        figures = self.study()
        for source in sorted((ROOT / "guide").rglob("*.md")):
            page = source.relative_to(ROOT / "guide").with_suffix("").as_posix()
            if page != "README" and not (page.startswith("methods/") and page.removeprefix("methods/") in self.methods()):
                text = with_parts(source.read_text(encoding="utf-8"), self.readmes, page, self.pages)
                self.write(page, self.with_figures(page, text, figures))

    def methods(self):
        return {m["name"]: m for m in self.catalogues["integrators"]}

    def method_pages(self):
        from generate import methods
        for name, m in self.methods().items():
            source = ROOT / "guide/methods" / f"{name}.md"
            if not source.exists():
                raise SystemExit(f"guide: the method {name} has no text; write guide/methods/{name}.md")
            self.write(f"methods/{name}", methods.page(m, source.read_text(encoding="utf-8"), self.bibliography))
        index = (ROOT / "guide/methods/index.md").read_text(encoding="utf-8")
        families = sorted(p.stem for p in (ROOT / "guide/methods/family").glob("*.md"))
        self.write("methods/index", index + "\n" + methods.overview(list(self.methods().values()))
                   + toctree(["notation", *(f"family/{f}" for f in families), *self.methods()]))

    def readme_pages(self):
        below = {"experiments": [], "papers": [], "inside": [], "inside/core": [], "inside/integrators": [], "inside/collision": []}
        for readme, page in self.readmes.pages.items():
            if page == "index":
                continue
            folder, name = page.rsplit("/", 1)
            if folder in below and name != "index":
                below[folder].append(name)
            self.write(page, self.readmes.text(readme, page, self.pages))
        self.append("experiments/index", toctree(sorted(below["experiments"])))
        self.append("papers/index", toctree(sorted(below["papers"])))
        self.append("inside/index", toctree(below["inside"]))
        for room in ("core", "integrators", "collision"):
            self.append(f"inside/{room}", toctree([f"{room}/{name}" for name in below[f"inside/{room}"]]))

    def append(self, page, text):
        path = self.pages / f"{page}.md"
        path.write_text(path.read_text(encoding="utf-8") + "\n" + text, encoding="utf-8")

    def reference_pages(self):
        from generate import reference
        self.write("reference/options", reference.options(self.catalogues))
        self.write("reference/scenario_keys", reference.scenario_keys(self.catalogues))
        self.write("reference/columns", reference.columns(self.catalogues))
        self.write("reference/names", reference.catalogue_pages(self.catalogues))
        self.write("reference/sources", "# Sources\n\n" + self.bibliography.items(self.bibliography.keys()))
        names = sorted(main.parent.name for main in (ROOT / "experiments").glob("*/main.cpp"))
        for name in names:
            program = self.programs / name
            if program.exists():
                told = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
                self.write(f"reference/programs/{name}", reference.program(name, told))
            else:
                self.write(f"reference/programs/{name}", f"# `./run {name}`\n\nThis program was not built when the guide was made, because its "
                           f"packages are not installed. `./run {name} --help` installs them and prints its options.\n")
        self.write("reference/programs/index", "# Programs\n\nWhat `./run PROGRAM --help` prints.\n\n"
                   + "".join(f"- [`{name}`]({name}.md)\n" for name in names) + toctree(names))

    def copy_rest(self):
        for name in ("conf.py", "theme", "static"):
            source = ROOT / "guide" / name
            (shutil.copytree if source.is_dir() else shutil.copyfile)(source, self.pages / name)
        for part in MATHJAX_PARTS:
            to = self.pages / "static/mathjax" / part
            to.parent.mkdir(parents=True, exist_ok=True)
            (shutil.copytree if (MATHJAX / part).is_dir() else shutil.copyfile)(MATHJAX / part, to)

    def make(self):
        self.written_pages()
        self.method_pages()
        self.readme_pages()
        self.reference_pages()
        self.copy_rest()
        html = self.pages.parent / "html"
        shutil.rmtree(html, ignore_errors=True)
        done = subprocess.run([sys.executable, "-m", "sphinx", "-b", "html", "-q", "-W", "--keep-going", "-j", str(os.cpu_count()),
                               "-d", str(self.pages.parent / "doctrees"), str(self.pages), str(html)], stdin=subprocess.DEVNULL, check=False,
                              stdout=sys.stderr)
        if done.returncode:
            raise SystemExit(f"guide: sphinx-build ended with status {done.returncode}; the pages are in {self.pages}")
        read_alone(html)
        return html / "index.html"


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    if not MATHJAX.exists():
        raise SystemExit("guide: MathJax is missing; install libjs-mathjax")
    try:
        import pybtex  # noqa: F401
        import sphinx  # noqa: F401
        import myst_parser  # noqa: F401
        import furo  # noqa: F401
    except ImportError as error:
        raise SystemExit(f"guide: {error}; install the packages of guide/packages.txt") from error
    print(Book(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()).make())


if __name__ == "__main__":
    main()
