#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Publishes a comparison of all methods in this folder: publish.py FOLDER, the results of ./run methods.

Copies costs.csv, from which all follows, regret.csv and the figures, and writes README.md around the sentences and tables of
methods.md. Nothing is added to what the program wrote."""
import json
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
TABLES = ("costs.csv", "regret.csv")  # what else follows from costs.csv stands on the page
FIGURES = ("solved_against_budget", "profiles_of_two")

HEAD = """# Methods compared: which one, for which kind of problem

Every method of the catalogue, in six formulations, on {motions} motions in {groups} groups: what each has to spend to
come below errors from 1e-2 to 1e-10. How it is measured and compared, how the groups were chosen, and what each word means:
[experiments/methods/README.md](../../experiments/methods/README.md). All of this page below the figures is printed
by `./run methods` (polhode {version}); `publish.py` put it here. A test counts the claims again from `costs.csv`.

![Tasks solved within a budget](solved_against_budget.svg)

![The best method and the next one](profiles_of_two.svg)

"""


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.splitlines()[0])
    results = pathlib.Path(sys.argv[1])
    missing = [n for n in (*TABLES, "methods.md", "manifest.json") if not (results / n).exists()]
    if missing:
        sys.exit(f"{results}: {', '.join(missing)} missing: it is no finished folder of ./run methods")
    for name in TABLES:
        shutil.copyfile(results / name, HERE / name)
    for name in FIGURES:
        shutil.copyfile(results / "figures" / f"{name}.svg", HERE / f"{name}.svg")
    rows = [line.split(",", 2)[:2] for line in (HERE / "costs.csv").read_text(encoding="utf-8").splitlines()[1:]]
    manifest = json.loads((results / "manifest.json").read_text(encoding="utf-8"))
    head = HEAD.format(motions=len({tuple(r) for r in rows}), groups=len({r[0] for r in rows}),
                       version=manifest["polhode"]["version"])
    (HERE / "README.md").write_text(head + (results / "methods.md").read_text(encoding="utf-8"), encoding="utf-8")


if __name__ == "__main__":
    main()
