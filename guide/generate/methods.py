# SPDX-License-Identifier: BSD-3-Clause
"""A page for each method: what the catalogue declares, and the text of guide/methods/NAME.md."""
from .markdown import code, escaped, table


def order(value):
    return "variable" if value is None else str(value)


def properties(m):
    """The rows of the table of properties."""
    rows = [("family", escaped(m["family"])), ("order under forces", order(m["order"]))]
    if m["free_order"] != m["order"]:
        rows.append(("order for bodies without forces", "exact" if m["free_order"] == "exact" else order(m["free_order"])))
    rows.append(("step", "chosen by a tolerance, `--tolerance`" if m["adaptive"] else "fixed, `--dt`"))
    rows.append(("right-hand sides per step", m["evaluations_per_step"] or "not constant; counted"))
    rows.append(("equations to solve in each step", "yes (implicit)" if m["implicit"] else "none (explicit)"))
    orientation = ("group elements: it stays on its manifold" if m["lie_group"]
                   else "addition, then normalized in the step" if m["normalizes"] else "addition: it leaves its manifold slowly")
    if m["conserves_quadratics"]:
        orientation = "addition, and yet on its manifold: a quadratic invariant of the equations"
    rows.append(("update of the orientation", orientation))
    rows.append(("equations of joints", f"solves {code(m['joints'])} itself" if m["joints"]
                 else "by the index-1 form, with `--stabilization`"))
    kept = [words for key, words in (("conserves_energy", "energy"), ("conserves_momentum", "angular momentum in the world"),
                                     ("conserves_casimir", "length of the angular momentum in the body")) if m[key]]
    if not m["joints"]:
        rows.append(("conserves for bodies without forces", ", ".join(kept) or "none of them exactly"))
    if m["conserves_quadratics"]:
        rows.append(("conserves in any motion", "every quadratic invariant of the flat equations"))
    shape = [words for key, words in (("symplectic", "symplectic"), ("symmetric", "symmetric in time")) if m[key]]
    rows.append(("structure", " and ".join(shape) or "neither symplectic nor symmetric"))
    if m["multi_step"]:
        rows.append(("history", "uses earlier steps, which an impact or a projection discards"))
    if m["additive"]:
        rows.append(("compensated summation", "possible, `--summation compensated`"))
    rows.append(("precisions", ", ".join(code(p) for p in m["precisions"])))
    for s in m["settings"]:
        rows.append((f"setting `--{s['key'].replace('_', '-')}`", escaped(f"{s['range']} (default {s['usual']})")))
    return rows


def trial(m):
    steps = "--tolerance 1e-10:1e-4:4:log" if m["adaptive"] else "--dt 1e-3:1e-1:5:log"
    if m["joints"]:
        study, own = "joints --scenario rod_pendulum,double_pendulum --stabilization none", " --scenario double_pendulum --t-end 1"
    else:
        study, own = "energy_drift --scenario hairer_vilmart", ""
    return f"./run {study} --integrator {m['name']} {steps}\n./run certificate --integrator {m['name']}{own}"


def page(m, text, bibliography):
    """The page of one method. `text`: the hand-written part."""
    return "\n".join([
        f"# `{m['name']}`\n",
        f"{escaped(m['summary'])}\n",
        "```{math}\n\\begin{aligned}\n" + m["equation"] + "\n\\end{aligned}\n```\n",
        "[Notation](notation.md) explains the symbols.\n",
        table(["property", "declared"], properties(m)),
        f"`./run certificate --integrator {m['name']}{' --scenario double_pendulum --t-end 1' if m['joints'] else ''}` measures whether it is "
        "what it declares.\n",
        text.strip() + "\n",
        "## Try it\n",
        "```sh\n" + trial(m) + "\n```\n",
        "## Sources\n",
        bibliography.items(m["sources"])])


def overview(methods):
    """All methods in one table."""
    def kept(m):
        return ", ".join(word for key, word in (("conserves_energy", "E"), ("conserves_momentum", "L"), ("conserves_casimir", "C"),
                                                ("conserves_quadratics", "Q")) if m[key])

    def structure(m):
        return ", ".join(word for key, word in (("symplectic", "symplectic"), ("symmetric", "symmetric")) if m[key])

    def orders(m):
        return order(m["order"]) + ("" if m["free_order"] == m["order"] else f" (free: {m['free_order']})")
    rows = [(f"[`{m['name']}`]({m['name']}.md)", escaped(m["family"]), orders(m), "tolerance" if m["adaptive"] else "fixed",
             "implicit" if m["implicit"] else "explicit", kept(m), structure(m)) for m in methods]
    return table(["method", "family", "order", "step", "", "conserves", "structure"], rows)
