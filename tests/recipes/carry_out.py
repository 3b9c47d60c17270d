# SPDX-License-Identifier: BSD-3-Clause
"""Carries out the recipes that the README gives for a force and a shape, and the guide for a joint, on copies of the files that
they name, and lists the method of tests/recipes/two_stage.cpp.

carry_out.py CHECKOUT FOLDER: FOLDER then has the new files and the changed copies, by their paths in the checkout.
"""
import pathlib
import re
import sys


def section(readme, heading):
    """The text from **heading** to the next one."""
    found = re.search(rf"^\*\*{re.escape(heading)}\*\*(.*?)(?=^\*\*A|^## )", readme, re.DOTALL | re.MULTILINE)
    if not found:
        raise SystemExit(f"README.md has no recipe **{heading}**")
    return found[1]


def one(what, pattern, text, flags=0):
    found = re.findall(pattern, text, flags)
    if len(found) != 1:
        raise SystemExit(f"README.md or guide/own/joint.md: {what} stands there {len(found)} times, not once")
    return found[0]


def blocks(text):
    """The blocks of C++: the file, then the sample for the laws."""
    found = re.findall(r"^```cpp\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    if len(found) != 2:
        raise SystemExit(f"README.md: a recipe has {len(found)} blocks of C++, not a file and a sample")
    return found


class Copies:
    def __init__(self, checkout, folder):
        self.checkout, self.folder = checkout, folder
        self.begun = set()

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def add(self, name, behind, lines):
        """A copy of the file with the lines behind the first place where `behind` ends."""
        copied = self.folder / name
        text = (copied if copied in self.begun else self.checkout / name).read_text(encoding="utf-8")
        self.begun.add(copied)
        if lines.strip() in text:  # in the checkout of a reader who follows the recipe
            return self.write(name, text)
        found = re.search(behind, text)
        if not found:
            raise SystemExit(f"{name}: nowhere to add {lines.strip()}")
        self.write(name, text[: found.end()] + lines + text[found.end() :])


def main():
    checkout, folder = map(pathlib.Path, sys.argv[1:3])
    readme = (checkout / "README.md").read_text(encoding="utf-8")
    copies = Copies(checkout, folder)
    samples = r"std::vector<Sample> samples\(\) {(?:.|\n)*?  return {\n"

    force = section(readme, "A force")
    code, sample = blocks(force)
    copies.write(one("the force's file", r"Save it as `(\S+)`", force), code)
    catalogue = "core/forces/catalogue.cpp"
    copies.add(catalogue, r'#include "core/forces/catalogue.hpp"\n', one("the include", r"`(#include .*?)`", force) + "\n")
    copies.add(catalogue, r"entries = {\n", one("the entry", r"`(force_entry<.*?>\(\),)`", force) + "\n")
    copies.add("tests/laws/force_law_test.cpp", samples, sample)

    shape = section(readme, "A shape")
    code, sample = blocks(shape)
    copies.write(one("the shape's file", r"Save it as `(\S+)`", shape), code)
    line = one("the shape's line", r"`(SHAPE\(.*?\))`", shape)
    copies.add("collision/shapes/shape_catalogue.cpp", r"#define POLHODE_SHAPES\(SHAPE\) \\\n", f"  {line} \\\n")
    copies.add("tests/laws/shape_law_test.cpp", samples, sample)

    joint = (checkout / "guide/own/joint.md").read_text(encoding="utf-8")
    copies.write(one("the joint's file", r"Save it as `(\S+)`", joint),
                 one("the joint's block of C++", r"^```cpp\n(.*?)^```$", joint, re.DOTALL | re.MULTILINE))
    catalogue = "core/joints/catalogue.cpp"
    copies.add(catalogue, r'#include "core/joints/catalogue.hpp"\n', one("the include", r"`(#include .*?)`", joint) + "\n")
    copies.add(catalogue, r"entries = {\n", one("the entry", r"`(joint_entry<.*?>\(\),)`", joint) + "\n")

    copies.add("integrators/catalogue.cpp", r"#define POLHODE_INTEGRATORS\(METHOD\) \\\n", "  METHOD(two_stage) \\\n")


main()
