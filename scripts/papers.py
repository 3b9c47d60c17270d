# SPDX-License-Identifier: BSD-3-Clause
"""Reproduces all papers, one after another, and says at the end what became of each.

    papers.py BIN_DIR PAPERS_DIR [--out DIR]

A paper is run by scripts/paper.py into the folder of its name in DIR (default: results/papers). One whose results stand is not
run again: the folder's `stamp` is a hash of the paper's files, and of the scripts and programs that made it. A paper that
was stopped half way goes on where it was.
Exit status: 0 all numbers within their tolerances, 1 a program failed, 2 bad input, 3 not all numbers.
"""
import argparse
import hashlib
import pathlib
import shutil
import signal
import sys
import time

import paper
import paper_claims

SCRIPTS = pathlib.Path(__file__).resolve().parent
MADE_BY = ("paper.py", "paper_quantities.py", "exact_top.py")


def names_of(papers):
    return sorted(p.parent.name for p in papers.glob("*/study.toml"))


def stamp(one, programs):
    """A hash of all that the results of a paper follow from."""
    sources = sorted(p for p in one.folder.iterdir() if p.is_file() and p.suffix not in (".md", ".svg", ".png"))
    sources += [SCRIPTS / name for name in MADE_BY] + [programs / name for name in one.programs()]
    digest = hashlib.sha256()
    for path in sources:
        try:
            digest.update(f"{path.name} ".encode() + hashlib.sha256(path.read_bytes()).digest())
        except OSError as error:
            raise paper.BadInput(f"{path}: cannot be read: {error.strerror}") from error
    return digest.hexdigest()


def stands(folder, mark, figures):
    wanted = ["comparison.csv", "stamp"] + (["comparison.svg"] if figures and shutil.which("gnuplot") else [])
    return all((folder / name).exists() for name in wanted) and (folder / "stamp").read_text() == mark


def reproduce(one, programs, folder, figures):
    """Runs a paper; returns 'stands', 'run', or 'failed, exit status N'."""
    mark = stamp(one, programs)
    if stands(folder, mark, figures):
        return "stands"
    begun = folder / "begun"
    if folder.exists() and not (begun.exists() and begun.read_text() == mark):
        if any(folder.iterdir()) and not begun.exists():
            raise paper.BadInput(f"{folder}: holds other files; give another --out")
        shutil.rmtree(folder)
    folder.mkdir(parents=True, exist_ok=True)
    begun.write_text(mark)
    status = one.run(programs, folder, figures)
    if status:
        return f"failed, exit status {status}"
    rows = one.compare(folder)
    paper.write_comparison(rows, folder)
    if figures:
        paper.draw(one.folder.name, rows, folder)
    (folder / "stamp").write_text(mark)
    return "run"


def summary(results):
    lines = [("paper", "verdict", "numbers", "time", "")]
    for name, word, said, seconds in results:
        lines.append((name, *said, "–" if word == "stands" else f"{seconds:.1f} s", word if word != "run" else ""))
    widths = [max(len(line[k]) for line in lines) for k in range(5)]
    return "\n".join("  ".join(f"{cell:{width}}" for cell, width in zip(line, widths)).rstrip() for line in lines)


def main():
    parser = argparse.ArgumentParser(prog="papers", description="Reproduces all papers that are not there yet.")
    parser.add_argument("bin", type=pathlib.Path, help="folder of the programs")
    parser.add_argument("papers", type=pathlib.Path, help="folder of the papers")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/papers"),
                        help="folder of the results (default: %(default)s)")
    parser.add_argument("--only", metavar="A,B", help="these papers alone")
    parser.add_argument("--no-figures", action="store_true", help="tables only")
    parser.add_argument("--index", type=pathlib.Path, help="write the index of claims and verdicts, papers/README.md, here")
    parser.add_argument("--programs", action="store_true", help="name the experiments that are needed, and run nothing")
    given = parser.parse_args()
    names = names_of(given.papers)
    if given.only:
        unknown = set(given.only.split(",")) - set(names)
        if unknown:
            raise paper.BadInput(f"no paper is called {', '.join(sorted(unknown))}; there are {', '.join(names)}")
        names = [name for name in names if name in given.only.split(",")]
    for fault in (faults := paper_claims.faults(given.papers)):
        print(f"papers: {fault}", file=sys.stderr)
    if faults:
        return 2
    all_papers = [paper.Paper(given.papers / name) for name in names]
    if given.programs:
        print(*sorted({program for one in all_papers for program in one.programs()}))
        return 0
    results, missing, failed = [], 0, 0
    for number, (name, one) in enumerate(zip(names, all_papers), start=1):
        print(f"[{number}/{len(names)}] {name} …", file=sys.stderr, flush=True)
        started = time.monotonic()
        word = reproduce(one, given.bin, given.out / name, not given.no_figures)
        if word.startswith("failed"):
            failed += 1
            said = "–", "–"
        else:
            found, as_given, judged = paper_claims.verdict(rows := paper.table(given.out / name / "comparison.csv"))
            said = found, paper_claims.count(as_given, judged)
            missing += judged - as_given
            for row in rows:
                if row["verdict"] == "not":
                    print(f"papers: {name}: not as given: {row['of']} {row['picked']} {row['quantity']}: ours {row['ours']}, "
                          f"theirs {row['theirs']}", file=sys.stderr)
        results.append((name, word, said, time.monotonic() - started))
    print(summary(results))
    if given.index and not failed:
        if given.only:
            raise paper.BadInput("--index needs all papers: leave --only out")
        given.index.write_text(paper_claims.index(given.papers, given.out), encoding="utf-8")
    return 1 if failed else 3 if missing else 0


def stop(*_):
    raise KeyboardInterrupt


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, stop)
    try:
        sys.exit(main())
    except paper.BadInput as problem:
        print(f"papers: {problem}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:  # SIGTERM too
        print("papers: stopped; the same command goes on from here", file=sys.stderr)
        sys.exit(130)
