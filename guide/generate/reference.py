# SPDX-License-Identifier: BSD-3-Clause
"""The reference: every option, key, column and metric, from the program's own tables (`--list json`)."""
import json

from .markdown import block, code, escaped, table


def value(x):
    """A default as it would stand in a scenario file."""
    if x is None:
        return ""
    if isinstance(x, float) and x == int(x) and abs(x) < 1e9:
        x = int(x)
    if isinstance(x, list):
        x = [int(n) if isinstance(n, float) and n == int(n) else n for n in x]
    return code(json.dumps(x))


def options(catalogues):
    rows = [(code(o["option"]), code(o["values"]), escaped(o["help"]), code(o["file_key"]), code(o["column"])) for o in catalogues["options"]]
    return ("# Options of a run\n\nEach is an axis of a study: it takes one value, a list or a range. In a study file the key stands in place "
            "of the option. [Studies](studies.md) says how axes make a study, [Programs](programs/index.md) has what `--help` prints.\n\n"
            + table(["option", "values", "meaning", "key in a study file", "column of `runs.csv`"], rows)
            + "\nNames that options take:\n\n"
            + table(["option", "names"], [(code(o["option"]), ", ".join(map(code, o["known"]))) for o in catalogues["options"]
                                          if o["known"] and o["option"] != "--integrator"])
            + "\n`--integrator` takes the names of [the methods](../methods/index.md).\n")


def parameters(keys):
    def range_of(k):
        words = [] if k["range"] == "any" else [k["range"]]
        words += ["one of " + ", ".join(code(c) for c in k["choices"])] if k["choices"] else []
        words += [f"with {k['needs_bodies']} bodies"] if k["needs_bodies"] else []
        return ", ".join(words)
    return table(["key", "unit", "meaning", "default", "range"],
                 [(code(k["key"]), escaped(k["unit"]), escaped(k["meaning"]), "required" if k["required"] else value(k["default"]), range_of(k))
                  for k in keys])


def scenario_keys(catalogues):
    def keys(name):
        return table(["key", "default", "can be varied"],
                     [(code(k["key"]), value(k["default"]), ("yes" if k["can_vary"] else "no") + (", with contact" if k["with_contact_only"] else ""))
                      for k in catalogues[name]])
    text = ("# Keys of a scenario\n\nThe tables of the program: [Scenarios](scenarios.md) says in words what each key means.\n\n"
            "## The scenario itself\n\n" + keys("scenario-keys") + "\n## A body, `[[body]]`\n\n" + keys("body-keys")
            + "\n## Forces, `[[force]]`\n\nEvery force has `kind` and `bodies`.\n\n")
    for force in catalogues["forces"]:
        bodies = f"{force['min_bodies']} or more" if force["max_bodies"] is None else str(force["max_bodies"]) \
            if force["min_bodies"] == force["max_bodies"] else f"{force['min_bodies']} to {force['max_bodies']}"
        text += f"### `{force['name']}`\n\n{escaped(force['summary'])}. Bodies: {bodies}.\n\n" + parameters(force["keys"]) + "\n"
    text += "## Joints, `[[joint]]`\n\nEvery joint has `kind` and `bodies` (one body and the world, or two), and may have a `name`.\n\n"
    for joint in catalogues["joints"]:
        text += (f"### `{joint['name']}`\n\n{escaped(joint['summary'])}. Equations: {joint['equations']}.\n\n" + parameters(joint["keys"])
                 + "\n")
    text += "## Shapes, `shape = { kind = … }`\n\n"
    for shape in catalogues["shapes"]:
        moments = f" Moments: {escaped(shape['moments'])}." if shape["moments"] else ""
        text += f"### `{shape['name']}`\n\n{escaped(shape['summary'])}.{moments}\n\n" + parameters(shape["keys"]) + "\n"
    return text + "## Invariants\n\n" + table(["name", "unit", "what it is"],
                                              [(code(i["name"]), escaped(i["unit"]), escaped(i["summary"])) for i in catalogues["invariants"]])


def columns(catalogues):
    meanings = {m["column"]: m["meaning"] for m in catalogues["metrics"]}
    metrics = [(code(m["column"]), escaped(m["unit"]), escaped(m["meaning"] or meanings.get(m["described_by"], "")), escaped(m["runs"]),
                ", ".join(code(w) for w in m["words"] if w)) for m in catalogues["metrics"]]
    settings = [(code(o["column"]), escaped(o["unit"]), escaped(o["help"]), "if the option is given" if o["on_demand"] else "all")
                for o in catalogues["options"] if o["column"]]
    return ("# Columns of `runs.csv`\n\nA row for each run. Units stand in the names. A cell is empty if the quantity is not conserved, not known or "
            "not defined. [What is measured](measured.md) has the definitions.\n\n## What the run is\n\n"
            + table(["column", "unit", "meaning", "in studies"], settings)
            + "\nThe keys of the scenario that are varied follow, each under its own name.\n\n## Metrics\n\n"
            + table(["column", "unit", "meaning", "for runs", "values"], metrics)
            + "\nEvery invariant that a scenario declares has a column `NAME_drift_max_rel` of its own.\n")


def catalogue_pages(catalogues):
    text = "# Names\n\n## Scenarios\n\n" + table(
        ["scenario", "title", "bodies", "`t_end`, s", "contact", "joints"],
        [(code(s["name"]), escaped(s["title"] + (": " + s["description"] if s["description"] else "")), s["bodies"], f"{s['t_end_s']:g}",
          "yes" if s["contact"] else "", s["joints"] or "") for s in catalogues["scenarios"]])
    for key, title in (("broad-phases", "Broad phases"), ("narrow-phases", "Narrow phases"), ("responses", "Responses to contact"),
                       ("impact-timings", "Timings of impacts")):
        text += f"\n## {title}\n\n" + table(["name", "what it is"], [(code(e["name"]), escaped(e["summary"])) for e in catalogues[key]])
    return text


def program(name, help_text):
    return f"# `./run {name}`\n\n" + block(help_text)
