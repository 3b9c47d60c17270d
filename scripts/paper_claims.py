# SPDX-License-Identifier: BSD-3-Clause
"""The claims of all papers, papers/claims.csv: their verdicts, and the index papers/README.md.

Each row of claims.csv is a claim of a paper in words, with the numbers that were given for it. The rows of the paper's
expected.csv name the claim that they belong to.
"""
import collections

import paper

HEAD = """# Papers

Published results, reproduced: what each paper claims, and how many of the numbers that stand for a claim polhode gives again.
`./run paper NAME` runs one of them, `./run papers` all that are not there yet, and `./run papers --index papers/README.md` makes
this page. `setups.csv` has the numbers that state the problems; a test holds the scenarios against them.

| verdict | says |
|---|---|
| reproduced | all numbers are as given, within the tolerances of `expected.csv`, and one at least was published |
| as computed | all are as given, and none was published: closed forms, and values that were computed without polhode |
| in part | some are as given |
| not reproduced | none is as given |
| measured | a measured quantity, such as a time, stands beside the published one, and is not judged |

"""


def all_claims(papers):
    """Rows of claims.csv, by paper, in their order."""
    by_paper = collections.defaultdict(list)
    for row in paper.table(papers / "claims.csv"):
        by_paper[row["paper"]].append(row)
    return by_paper


def faults(papers):
    """What is missing: sentences."""
    found, claims = [], all_claims(papers)
    folders = sorted(p.parent for p in papers.glob("*/study.toml"))
    found += [f"claims.csv: there is no paper {name}" for name in claims if name not in {f.name for f in folders}]
    for folder in folders:
        rows = paper.table(folder / "expected.csv")
        known = {claim["claim"]: claim for claim in claims.get(folder.name, [])}
        for line, row in enumerate(rows, start=2):
            if row.get("claim") not in known:
                found.append(f"{folder.name}/expected.csv, row {line}: claims.csv has no claim '{row.get('claim')}' of it")
        for name, claim in known.items():
            values = {float(row["value"]) for row in rows if row.get("claim") == name}
            if not values:
                found.append(f"{folder.name}: no row of expected.csv belongs to the claim {name}")
            found += [f"{folder.name}, {name}: no row of expected.csv has the number {number}"
                      for number in claim["numbers"].split() if values and float(number) not in values]
    return found


def verdict(rows):
    """The verdict about rows of comparison.csv: a word, the numbers as given, and the numbers judged."""
    judged = [row for row in rows if row["verdict"] != "measured"]
    given = sum(row["verdict"] == "as given" for row in judged)
    if not judged:
        word = "measured"
    elif given < len(judged):
        word = "in part" if given else "not reproduced"
    else:
        word = "reproduced" if any(row["source"].startswith("P") for row in judged) else "as computed"
    return word, given, len(judged)


def count(given, judged):
    return f"{given} of {judged}" if judged else "–"


def plain(text):
    """As a cell of a Markdown table."""
    return text.replace("|", "\\|")


def title(folder):
    """The first line of the paper's README."""
    with open(folder / "README.md", encoding="utf-8") as file:
        return file.readline().lstrip("# ").strip()


def index(papers, out):
    """The text of papers/README.md, from the comparison.csv of each paper in the folder `out`."""
    lines, places = [HEAD, "| paper | claim | verdict | reproduced |\n|---|---|---|---|\n"], []
    for name, claims in all_claims(papers).items():
        rows = paper.table(out / name / "comparison.csv")
        expected = paper.table(papers / name / "expected.csv")
        for i, claim in enumerate(claims):
            word, given, judged = verdict([row for row in rows if row["claim"] == claim["claim"]])
            head = f"[{title(papers / name)}]({name}/README.md)" if i == 0 else ""
            lines.append(f"| {head} | {plain(claim['says'])} | {word} | {count(given, judged)} |\n")
            for number in claim["numbers"].split():
                at = [str(line) for line, row in enumerate(expected, start=2)
                      if row["claim"] == claim["claim"] and float(row["value"]) == float(number)]
                places.append(f"| {number} | `{name}` | {claim['claim']} | {', '.join(at)} |\n")
    total = verdict_of_all(papers, out)
    lines.append(f"\n{total[1]} of {total[2]} numbers of {len(all_claims(papers))} papers are as given.\n\n")
    lines.append("## Where each given number stands\n\n| number | folder | claim | row of `expected.csv` |\n|---|---|---|---|\n")
    return "".join(lines + places)


def verdict_of_all(papers, out):
    return verdict([row for name in all_claims(papers) for row in paper.table(out / name / "comparison.csv")])
