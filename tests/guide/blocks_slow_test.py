# SPDX-License-Identifier: BSD-3-Clause
"""Carries out every block of shell commands in the root's README, in experiments/**/README.md and in the guide.

The commands of a document run one after the other in a folder of their own, each as the program that `./run` would start.
POLHODE_BIN_DIR is the folder of the programs. They are made small by these rules, which are applied to the words of a command:

- A range of an option (`1e-3:1e-1:9:log`) has two values, a list of more than two numbers has its last two.
- `all` of an option is replaced by SOME of it.
- Each option in SMALL is added, or takes the place of the one given, for the programs that have it; a given one that is smaller
  stays. So durations are short, and figures are not drawn.
- With `--samples`, which must fall on whole steps, the duration stays. Figures are drawn if the document names one of them.
- A study whose results later commands of the document name by their ids is carried out as it is printed (AS_PRINTED).

A study ends with status 3 if one of its runs failed. That is a result if the run says that its step is too long for the method.

A block is not carried out if the line before it is `<!-- skipped, because … -->`, a command if SKIPPED has it with a reason.
"""
import concurrent.futures
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/experiments"))
sys.path.insert(0, str(ROOT / "tests/scripts"))
from programs import BIN, temporary_folder  # noqa: E402
from readme_test import OWN_FILES, saved_files  # noqa: E402

PATIENCE = 600  # s, for one command
SKIPPED = {  # beginning of a command: reason
    "./test": "it builds and runs all tests",
    "./run guide": "tests/guide/book_slow_test.py makes the book",
    "./run paper": "tests/experiments/papers_test.py carries out every paper",
    "./run --help": "tests/scripts tests the script itself",
    "./run certificate --integrator my_method": "the method is the reader's",
    "./run viewer": "it opens a window or needs an offscreen context; tests/viewer tests it",
    "POLHODE_BIN_DIR=build/release/bin python3 tests/benchmarks/many_runs.py": "it needs GNU parallel and Snakemake, and minutes",
}
STUDIES = ("certificate", "convergence", "energy_drift", "impact", "joints", "methods", "pile", "precision", "simulate", "stability",
           "stack", "work_precision")
SOME = {"--integrator": "rk4,mclachlan_reich", "--response": "sequential_impulses,simultaneous", "--broad-phase": "bvh,all_pairs"}
SMALL = {
    "broad_phase": {"--bodies": "100,200", "--motion": "0.02"},
    "narrow_phase": {"--count": "500"},
    "replay": {"--t-end": "0.5"},
    "certificate": {"--integrator": "rk4,mclachlan_reich", "--no-figures": None},
    "convergence": {"--integrator": "rk4,mclachlan_reich", "--t-end": "1", "--no-figures": None},
    "energy_drift": {"--t-end": "1", "--no-figures": None},
    "impact": {"--integrator": "rk4", "--t-end": "1", "--no-figures": None},
    "joints": {"--t-end": "0.2", "--no-figures": None},
    "methods": {"--scenario": "hairer_vilmart,lagrange_top", "--integrator": "rk4,odeint_dopri5",
                "--angular-state": "velocity_body", "--orientation": "quaternion", "--no-figures": None},
    "pile": {"--scenario": "pile_10", "--t-end": "0.2", "--no-figures": None},
    "precision": {"--integrator": "rk4", "--t-end": "16", "--no-figures": None},
    "simulate": {"--t-end": "1", "--no-figures": None},
    "stability": {"--integrator": "rk4", "--t-end": "20", "--no-figures": None},
    "stack": {"--t-end": "0.2", "--no-figures": None},
    "work_precision": {"--integrator": "rk4,mclachlan_reich", "--t-end": "1", "--no-figures": None},
}
KEPT = ("--integrator", "--scenario")  # a given value of these stays
AS_PRINTED = "./run energy_drift --out results/my_study"


def documents():
    readmes = [ROOT / "README.md", *sorted((ROOT / "experiments").rglob("README.md")), ROOT / "guide/README.md"]
    return readmes + sorted(page for page in (ROOT / "guide").rglob("*.md") if page.name != "README.md")


def blocks(text):
    """The shell blocks, each with the reason for which it is skipped, or an empty text."""
    return [(block, skipped or "") for skipped, block in
            re.findall(r"(?:^<!-- skipped, because (.*?) -->\n+)?^```sh\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)]


def lines(block):
    for line in block.replace("\\\n", " ").splitlines():
        words = shlex.split(line, comments=True)
        if words:
            yield words


def fewer(value):
    """The values of an option, cut by the first two rules."""
    parts = value.split(":")
    if len(parts) in (3, 4) and parts[2].isdigit():
        return ":".join([*parts[:2], "2", *parts[3:]])
    numbers = value.split(",")
    if len(numbers) > 2 and all(re.fullmatch(r"[-+.0-9e]+", number) for number in numbers):
        return ",".join(numbers[-2:])
    return value


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def made_small(words):
    """The words of a command ["./run", PROGRAM, OPTIONS...], made small."""
    if shlex.join(words) == AS_PRINTED:
        return words + ["--no-figures"]
    program = words[1]
    small = dict(SMALL.get(program, {}))
    if "--help" in words or "--list" in words or program not in SMALL:
        return words
    if "--samples" in words:
        small.pop("--t-end", None)
    if program == "broad_phase" and "--boxes" in words or program == "narrow_phase" and "--pairs" in words or "--results" in words:
        small = {}
    out = words[:2]
    rest = iter(words[2:])
    for word in rest:
        if not word.startswith("--"):
            out.append(word)
            continue
        out.append(word)
        if word in small and small[word] is None:
            del small[word]
    for i in range(2, len(out) - 1):
        option, value = out[i], out[i + 1]
        if not option.startswith("--") or value.startswith("--"):
            continue
        if value == "all" and option in SOME:
            out[i + 1] = SOME[option]
        elif option == "--vary":
            key, _, values = value.partition("=")
            out[i + 1] = f"{key}={fewer(values)}"
        elif option in ("--dt", "--tolerance", "--bodies"):
            out[i + 1] = fewer(value)
        if option in small:
            given, most = number(value), number(small[option])
            if option not in KEPT and not (given is not None and most is not None and given <= most):
                out[i + 1] = small[option]
            del small[option]
    for option, value in small.items():
        out += [option] if value is None else [option, value]
    return out


def reason_to_skip(words):
    command = shlex.join(words)
    if words[2:] == ["--help"]:
        return "" if (BIN / words[1]).exists() else f"{words[1]} is not built"
    for beginning, reason in SKIPPED.items():
        if command.startswith(beginning):
            return reason
    if words[0] == "./run" and words[1:] and (ROOT / "experiments" / words[1] / "main.cpp").exists() and not (BIN / words[1]).exists():
        return f"{words[1]} is not built"
    return ""


def prepare(folder, text):
    """The reader's own files that the commands of a document name."""
    for file, content in {**OWN_FILES, **saved_files(text)}.items():
        (folder / file).write_text(content, encoding="utf-8")
    def made(*words):
        subprocess.run([str(BIN / words[0]), *words[1:]], cwd=folder, check=True, capture_output=True, timeout=PATIENCE)
    if re.search(r"run judge .* \w+\.csv", text):
        for scenario, files in (("peters_hsu", ("my_engine.csv", "bullet.csv", "ode.csv")), ("my_robot_arm.toml", ("engine.csv",))):
            made("simulate", "--scenario", scenario, "--integrator", "rk4", "--dt", "0.01", "--t-end", "1", "--samples", "50", "--no-figures",
                 "--out", "made")
            for file in files:
                shutil.copyfile(folder / "made/trajectory.csv", folder / file)
            shutil.rmtree(folder / "made")
    for named, file in (("--boxes boxes.csv", "boxes/motion.csv"), ("--pairs pairs.csv", "pairs/by_name.csv")):
        if named in text:
            shutil.copyfile(ROOT / "tests/fuzz/corpus" / file, folder / named.split()[1])
    if "results/my_study" in text and AS_PRINTED not in text:
        made("energy_drift", "--integrator", "rk4,dmv", "--dt", "0.02,0.01", "--trajectory", "csv", "--no-figures", "--out", "results/my_study")


def carried_out(path, text):
    """Carries out the commands of a document. Returns the faults, the number carried out, and the reasons of those skipped."""
    done, faults, skipped, holders = 0, [], [], []
    folder = temporary_folder(holders.append)
    inputs = re.findall(r"^\\input\{([^}]*)\}", text, re.MULTILINE)
    try:
        prepare(folder, text)
        for block, reason in blocks(text):
            for words in lines(block):
                why = reason or reason_to_skip(words)
                if why:
                    skipped.append(f"{shlex.join(words)}: skipped, because {why}")
                    continue
                if words[0] != "./run":
                    faults.append(f"{path}: {shlex.join(words)}: neither ./run nor skipped with a reason")
                    continue
                small = made_small(words if words[1:] else ["./run", "energy_drift"])
                if inputs:
                    small = [word for word in small if word != "--no-figures"]
                result = subprocess.run([str(BIN / small[1]), *small[2:]], cwd=folder, capture_output=True, text=True, timeout=PATIENCE,
                                        stdin=subprocess.DEVNULL, check=False)
                done += 1
                if result.returncode and not (result.returncode == 3 and "the step is too long" in result.stderr):
                    faults.append(f"{path}: {shlex.join(words)}\n  as {shlex.join(small)}\n  status {result.returncode}: {result.stderr[-500:]}")
        for file in inputs:
            if done and not (folder / file).exists():
                faults.append(f"{path}: \\input names {file}, which its commands do not make")
    finally:
        for cleanup in holders:
            cleanup()
    return faults, done, skipped


class Blocks(unittest.TestCase):
    def test_every_command_is_carried_out(self):
        if not (BIN / "energy_drift").exists() or not (BIN / "simulate").exists():
            self.skipTest("skipped, because there is no energy_drift or no simulate")
        texts = [(page.relative_to(ROOT).as_posix(), page.read_text(encoding="utf-8")) for page in documents()]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            results = list(pool.map(lambda one: carried_out(*one), texts))
        for _, _, skipped in results:
            for line in skipped:
                print(line)
        found = [fault for faults, _, _ in results for fault in faults]
        if found:
            self.fail("\n".join(found))
        done = sum(number_done for _, number_done, _ in results)
        print(f"{done} commands were carried out")
        self.assertGreaterEqual(done, 80)

    def test_faults_are_found(self):
        planted = "```sh\n./run simulate --scenario no_such --integrator rk4 --dt 0.1\nrm -r /\n```\n"
        if not (BIN / "simulate").exists():
            self.skipTest("skipped, because there is no simulate")
        faults, done, _ = carried_out("planted", planted)
        self.assertEqual((len(faults), done), (2, 1))

    def test_commands_are_made_small(self):
        def small(command):
            return shlex.join(made_small(shlex.split(command)))
        self.assertEqual(small("./run energy_drift --dt 1e-3:1e-1:9:log --t-end 0.5"),
                         "./run energy_drift --dt 1e-3:1e-1:2:log --t-end 0.5 --no-figures")
        self.assertEqual(small("./run convergence --dt 0.2,0.1,0.05 --t-end 20 --integrator dmv"),
                         "./run convergence --dt 0.1,0.05 --t-end 1 --integrator dmv --no-figures")
        self.assertEqual(small("./run simulate --help"), "./run simulate --help")
        self.assertEqual(blocks("<!-- skipped, because x -->\n```sh\na\n```\n\n```sh\nb\n```\n"), [("a\n", "x"), ("b\n", "")])


if __name__ == "__main__":
    unittest.main()
