# SPDX-License-Identifier: BSD-3-Clause
"""Every README.md of the checkout: its links and paths lead somewhere, its C++ and its commands are those of the code. So are
those of the pages of the guide, whose links Sphinx checks (tests/guide).

POLHODE_BIN_DIR is the folder of the programs; commands of programs that are not there are skipped.
"""
import concurrent.futures
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("POLHODE_BIN_DIR", "."))
READMES = sorted(path for path in ROOT.rglob("README.md") if path.relative_to(ROOT).parts[0] not in ("build", "results"))
PAGES = sorted(page for page in (ROOT / "guide").rglob("*.md") if page.name != "README.md")
SOURCE_FOLDERS = ("core", "integrators", "collision", "experiments", "tests", "papers", "scripts")
SOURCE_SUFFIXES = (".hpp", ".cpp", ".py", ".sh", "README.md")
# Files that commands of READMEs name as the reader's, made here.
SCENARIO = "t_end = 1\n[[body]]\nmass = 1\ninertia = [1, 2, 3]\nangular_velocity = [0.01, 1, 0.01]\n"
STACK = "t_end = 1\ncontact = true\n" + "[[body]]\nmass = 1\nshape = { kind = 'sphere', radius = 1 }\n" * 2
OWN_FILES = {"my_top.toml": SCENARIO, "my_stack.toml": STACK, "my_robot_arm.toml": SCENARIO}
# Pages and files about an example that tests/recipes adds to the catalogues, compiles and runs; the programs do not know it.
WORKED_PAGE = ROOT / "guide/own/joint.md"
WORKED_FILES = {"my_screw.toml"}
# Commands that need more than the checkout has, and why.
NOT_RUN = {
    "certificate --integrator my_method": "the method is the reader's",
}
# Of these the options alone are looked up in --help.
WITHOUT_DRY_RUN = {"archive", "broad_phase", "explain", "figures", "narrow_phase", "judge", "plot", "replay", "rerun", "results",
                   "viewer"}


def name(readme):
    return readme.relative_to(ROOT).as_posix()


def text_of(readme):
    return readme.read_text(encoding="utf-8")


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)


def saved_files(text):
    """The files that a document tells its reader to save: "Save this as `NAME`:" and a block."""
    return dict(re.findall(r"Save\s+this\s+as\s+`([^`]+)`:\n\n```\w+\n(.*?)^```$", text, re.DOTALL | re.MULTILINE))


def anchors(text):
    """The anchors of a document's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(readme, text):
    found = []
    for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)):
        if target.startswith(("http://", "https://")):
            continue
        path, _, anchor = target.partition("#")
        there = (readme.parent / path).resolve() if path else readme
        if not there.exists():
            found.append(f"{name(readme)}: the link {target} leads nowhere")
        elif anchor and anchor not in anchors(text if there == readme else text_of(there)):
            found.append(f"{name(readme)}: {path or 'it'} has no heading #{anchor}")
    return found


def broken_paths(readme, text):
    """Paths in backticks: of sources, and of anything below a top folder. Those that the text says to make are not there."""
    to_make = set(re.findall(r"Save it as `([^`]+)`", text))
    found = []
    for path in re.findall(r"`([\w./*-]+/[\w./*-]*)`", text):
        is_source = path.endswith(SOURCE_SUFFIXES) or path.split("/")[0] in SOURCE_FOLDERS
        if not is_source or "NAME" in path or path in to_make:
            continue
        if not any(any(base.glob(path.removeprefix("./"))) if "*" in path else (base / path).exists() for base in (ROOT, readme.parent)):
            found.append(f"{name(readme)}: there is no {path}")
    return found


def wrong_functions(readme, text):
    """Rows of a table `step | function | file`: each function stands in that file."""
    found = []
    for table in re.findall(r"^\| step \| function \| file \|\n\|[-|]+\|\n((?:\|.*\n)+)", text, re.MULTILINE):
        for row in table.splitlines():
            functions, file = row.strip("| ").split(" | ")[-2:]
            there = ROOT / file.strip("`")
            source = text_of(there) if there.exists() else ""
            for function in re.findall(r"`([^`]+)`", functions):
                if not re.search(rf"\b{function}\b", source):
                    found.append(f"{name(readme)}: {function} does not stand in {file}")
    return found


def sources():
    return [text_of(path) for folder in SOURCE_FOLDERS for path in sorted((ROOT / folder).rglob("*.[ch]pp"))]


def commands(text):
    """The lines of the shell blocks that run an experiment, and those in backticks with an option, as lists of words."""
    found = []
    for block in blocks(text, "sh"):
        for line in block.replace("\\\n", " ").splitlines():
            found.append(shlex.split(line, comments=True))
    for line in re.findall(r"`(\./run [^`]*--[^`]*)`", text):
        found.append(shlex.split(line))
    return [words for words in found if words and words[0] == "./run"]


def long_options(words):
    return [word for word in words if re.fullmatch(r"--[a-z][a-z-]*", word)]


def unknown_options(words, help_text):
    """What is wrong with the options, or an empty text."""
    unknown = [option for option in long_options(words) if not re.search(rf"(?<![\w-]){option}(?![\w-])", help_text)]
    return "no such option: " + ", ".join(unknown) if unknown else ""


def call(words, folder):
    done = subprocess.run([str(BIN / words[0]), *words[1:]], cwd=folder, capture_output=True, text=True, timeout=120,
                          stdin=subprocess.DEVNULL, check=False)
    return done.returncode, done.stdout, done.stderr.strip()


def wrong_command(words, folder):
    """Why a command of a README cannot be right, or an empty text. words: ["./run", EXPERIMENT, OPTIONS...]."""
    words = words[1:] or ["energy_drift"]
    if words[0] == "paper" and not (words[1:] and (words[1] == "NAME" or (ROOT / "papers" / words[1] / "study.toml").exists())):
        return "no such paper"
    if words[0] in ("paper", "papers"):
        done = subprocess.run(["/usr/bin/python3", "-B", str(ROOT / f"scripts/{words[0]}.py"), "--help"], capture_output=True,
                              text=True, check=True)
        return unknown_options(words, done.stdout)
    if words[0] in ("--help", "guide") or "EXPERIMENT" in words[0] or "NAME" in words:
        return ""
    if not (ROOT / "experiments" / words[0] / "main.cpp").exists():
        return "no such experiment"
    if " ".join(words) in NOT_RUN or not (BIN / words[0]).exists():
        return ""
    if words[0] in WITHOUT_DRY_RUN or WORKED_FILES & set(words):
        status, help_text, said = call([words[0], "--help"], folder)
        return said if status else unknown_options(words, help_text)
    shown_only = {"--help", "--list"} & set(words)
    status, _, said = call(words + ([] if shown_only else ["--dry-run"]), folder)
    return said or f"exit status {status}" if status else ""


class Readmes(unittest.TestCase):
    def check(self, find):
        found = [line for readme in READMES for line in find(readme, text_of(readme))]
        self.assertEqual(found, [])

    def test_there_are_readmes(self):
        self.assertGreaterEqual(len(READMES), 30)

    def test_links_lead_somewhere(self):
        self.check(broken_links)

    def test_paths_are_there(self):
        self.check(broken_paths)

    def test_the_way_of_a_run_names_functions_that_are_there(self):
        self.check(wrong_functions)
        self.assertTrue(any("| step | function | file |" in text_of(readme) for readme in READMES))

    def test_cpp_stands_in_a_source(self):
        """The recipes are compiled by tests/recipes and tests/integrators; elsewhere a block quotes a file."""
        code = sources()
        for readme in READMES + PAGES:
            if readme.parent == ROOT or readme == WORKED_PAGE:
                continue
            for block in blocks(text_of(readme), "cpp"):
                with self.subTest(name(readme)):
                    self.assertTrue(any(block in source for source in code), block)

    def test_faults_are_found(self):
        planted = "[a](nowhere.md) [b](#nothing) `core/nothing.hpp`\n| step | function | file |\n|---|---|---|\n" \
                  "| s | `no_such_function` | `core/run/simulate.hpp` |\n"
        readme = ROOT / "README.md"
        self.assertEqual(len(broken_links(readme, planted)), 2)
        self.assertEqual(len(broken_paths(readme, planted)), 1)
        self.assertEqual(len(wrong_functions(readme, planted)), 1)


class Commands(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="polhode_test_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        for file, content in OWN_FILES.items():
            (self.folder / file).write_text(content, encoding="utf-8")
        for page in READMES + PAGES:
            for file, content in saved_files(text_of(page)).items():
                (self.folder / file).write_text(content, encoding="utf-8")

    def test_commands_are_taken(self):
        """Planned with --dry-run, which checks options, names, values and scenarios, and runs nothing."""
        named = sorted({(name(readme), tuple(words)) for readme in READMES + PAGES for words in commands(text_of(readme))})
        self.assertGreaterEqual(len(named), 60)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            faults = pool.map(lambda one: wrong_command(list(one[1]), self.folder), named)
            found = [f"{readme}: {shlex.join(words)}: {fault}" for (readme, words), fault in zip(named, faults) if fault]
        self.assertEqual(found, [])

    def test_scenarios_and_studies_in_readmes_are_read(self):
        if not (BIN / "simulate").exists() or not (BIN / "energy_drift").exists():
            self.skipTest("skipped, because there is no simulate or no energy_drift")
        texts = [block for readme in READMES + PAGES if readme != WORKED_PAGE for block in blocks(text_of(readme), "toml")]
        self.assertGreaterEqual(len(texts), 2)
        for text in texts:
            (self.folder / "block.toml").write_text(text, encoding="utf-8")
            study = re.search(r"^\[(study|defaults)\b", text, re.MULTILINE)
            command = (["energy_drift", "--study", "block.toml"] if study else
                       ["simulate", "--scenario", "block.toml", "--integrator", "rk4", "--dt", "0.1"])
            with self.subTest(text):
                self.assertEqual(wrong_command(["./run", *command], self.folder), "")

    def test_an_unknown_option_is_found(self):
        for experiment in ("energy_drift", "judge"):
            if (BIN / experiment).exists():
                with self.subTest(experiment):
                    self.assertNotEqual(wrong_command(["./run", experiment, "--no-such-option", "1"], self.folder), "")


if __name__ == "__main__":
    unittest.main()
