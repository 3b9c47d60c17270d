# SPDX-License-Identifier: BSD-3-Clause
"""Who may include whom, over all C++ files of the checkout.

core includes nobody; integrators and collision include core; experiments and tests include all; papers holds no C++.
An include of ours is written from the top of the checkout ("core/system/state.hpp"). Libraries that are slow to compile stay
out of headers. Every C++ file begins with its licence.
"""

import pathlib
import re
import tempfile
import unittest

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]

MAY_INCLUDE = {
    "core": {"core"},
    "integrators": {"integrators", "core"},
    "collision": {"collision", "core"},
    "experiments": {"experiments", "core", "integrators", "collision"},
    "tests": {"tests", "experiments", "core", "integrators", "collision"},
    "papers": set(),
}
CPP_SUFFIXES = {".cpp", ".cc", ".cxx", ".hpp", ".hh", ".h", ".inl", ".ipp"}
SOURCE_SUFFIXES = {".cpp", ".cc", ".cxx"}
NOT_IN_A_HEADER = ("CLI/", "toml++/", "toml.hpp", "boost/numeric/odeint", "nlohmann/")
LICENCE = "// SPDX-License-Identifier: BSD-3-Clause"
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def violations(checkout):
    """One line for each rule that a file under `checkout` breaks."""
    found = []
    for folder, may_include in MAY_INCLUDE.items():
        for file in sorted((checkout / folder).rglob("*")):
            if file.suffix not in CPP_SUFFIXES or not file.is_file():
                continue
            name = file.relative_to(checkout)
            if folder == "papers":
                found.append(f"{name}: papers/ holds no C++; a program belongs in experiments/")
                continue
            lines = file.read_text(encoding="utf-8").splitlines()
            if not lines or lines[0] != LICENCE:
                found.append(f"{name}:1: the first line must be {LICENCE}")
            for number, line in enumerate(lines, start=1):
                include = INCLUDE.match(line)
                if not include:
                    continue
                quote, target = include.groups()
                house = target.split("/")[0] if "/" in target else None
                if house in MAY_INCLUDE:
                    if house not in may_include:
                        found.append(f"{name}:{number}: {folder}/ may not include {target}")
                elif quote == '"':
                    found.append(f'{name}:{number}: write "{target}" from the top of the checkout, a library\'s in <>')
                elif file.suffix not in SOURCE_SUFFIXES and target.startswith(NOT_IN_A_HEADER):
                    found.append(f"{name}:{number}: {target} is slow to compile: include it in a .cpp")
    return found


class IncludeRules(unittest.TestCase):
    def test_this_checkout_keeps_the_rules(self):
        self.assertTrue(any((CHECKOUT / "core").rglob("*.hpp")), "no headers found: looked in the wrong place")
        self.assertEqual(violations(CHECKOUT), [])

    def found_in(self, path, text):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, path)
            file.parent.mkdir(parents=True)
            file.write_text(text, encoding="utf-8")
            return violations(pathlib.Path(folder))

    def test_planted_violations_are_found(self):
        for path, include in [
            ("core/a.hpp", '"integrators/rk4.hpp"'),
            ("core/deep/a.cpp", "<integrators/rk4.hpp>"),
            ("core/a.cpp", '"tests/a.hpp"'),
            ("integrators/a.cpp", '"collision/shape.hpp"'),
            ("integrators/a.cpp", '"experiments/study/plan/plan.hpp"'),
            ("collision/a.hpp", '"integrators/rk4.hpp"'),
            ("experiments/drift/main.cpp", '"tests/a.hpp"'),
            ("integrators/a.cpp", '"../collision/shape.hpp"'),
            ("integrators/a.cpp", '"rk4.hpp"'),
            ("core/a.h", "<nlohmann/json.hpp>"),
            ("experiments/study/a.hpp", "<CLI/CLI.hpp>"),
            ("integrators/a.hpp", "<boost/numeric/odeint/stepper/runge_kutta4.hpp>"),
            ("tests/a.hpp", "<toml++/toml.h>"),
        ]:
            with self.subTest(path=path, include=include):
                found = self.found_in(path, f"{LICENCE}\n  #  include {include}\n")
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(f"{path}:2: "), found)
        self.assertEqual(len(self.found_in("core/a.cpp", "int a;\n")), 1)
        self.assertEqual(len(self.found_in("core/a.hpp", f"\n{LICENCE}\n")), 1)
        self.assertEqual(len(self.found_in("papers/study/a.cpp", f"{LICENCE}\n")), 1)

    def test_what_is_allowed_passes(self):
        for path, include in [
            ("core/a.hpp", '"core/system/state.hpp"'),
            ("core/a.hpp", "<boost/math/tools/roots.hpp>"),
            ("integrators/a.cpp", '"core/system/state.hpp"'),
            ("integrators/a.cpp", "<boost/numeric/odeint.hpp>"),
            ("collision/a.hpp", '"core/system/state.hpp"'),
            ("experiments/study/a.cpp", "<CLI/CLI.hpp>"),
            ("experiments/study/a.hpp", '"collision/shape.hpp"'),
            ("tests/laws/a.hpp", '"experiments/study/plan/plan.hpp"'),
            ("tests/laws/a.hpp", '"tests/laws/b.hpp"'),
        ]:
            with self.subTest(path=path, include=include):
                self.assertEqual(self.found_in(path, f"{LICENCE}\n#include {include}\n"), [])


if __name__ == "__main__":
    unittest.main()
