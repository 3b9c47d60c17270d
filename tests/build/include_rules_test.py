# SPDX-License-Identifier: BSD-3-Clause
"""Who may include whom, over all C++ files of the checkout: MAY_INCLUDE is the plan of the house.

A folder is a room. It may include itself and the rooms of its entry; no cycle of rooms is allowed. An include of ours is
written from the top of the checkout ("core/system/state.hpp"). Libraries that are slow to compile stay out of headers.
The names of a room stand in the namespace of its folder. Every C++ file begins with its licence.
"""

import collections
import pathlib
import re
import tempfile
import unittest

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]

# Room: the rooms that it may include. "core/*" is core with all its rooms.
MAY_INCLUDE = {
    "core/math": "",
    "core/problem": "core/math",
    "core/forces": "core/math core/problem",
    "core/joints": "core/math core/problem",
    "core/system": "core/math core/problem core/forces core/joints",
    "core/exact": "core/math core/problem core/system",
    "core/run": "core/math core/problem core/system",
    "integrators": "core/*",
    "integrators/conserving": "core/* integrators",
    "integrators/joints": "core/* integrators integrators/conserving integrators/lie_group",
    "integrators/lie_group": "core/* integrators",
    "integrators/odeint": "core/* integrators",
    "integrators/recipes": "core/* integrators integrators/joints",
    "integrators/sundials": "core/* integrators integrators/joints",
    "integrators/textbook": "core/* integrators",
    "collision": "core/math",
    "collision/shapes": "core/math core/problem collision",
    "collision/broad": "core/math core/problem collision",
    "collision/narrow": "core/math core/problem collision collision/shapes",
    "collision/response": "core/math core/problem collision",
    "collision/contact": "core/* collision collision/response",

    "experiments/study/text": "core/problem",
    "experiments/study/statistics": "experiments/study/text",
    "experiments/study/scenario": "core/* collision collision/shapes collision/contact experiments/study/text",
    "experiments/study/scene": "core/problem collision collision/shapes experiments/study/scenario",
    "experiments/study/plot": "experiments/study/text",
    "experiments/study/trajectory": "core/* experiments/study/text",
    "experiments/study/record": "core/run core/system integrators collision collision/contact experiments/study/text"
                                " experiments/study/scenario experiments/study/plot",
    "experiments/study/store": "experiments/study/text experiments/study/scenario experiments/study/record",
    "experiments/study/setup": "core/* integrators collision collision/contact experiments/study/text"
                               " experiments/study/scenario experiments/study/record",
    "experiments/study/metrics": "core/* collision/contact experiments/study/text experiments/study/statistics"
                                 " experiments/study/scenario experiments/study/record experiments/study/setup",
    "experiments/study/curves": "core/run integrators experiments/study/text experiments/study/statistics"
                                " experiments/study/scenario experiments/study/record",
    "experiments/study/run": "core/run core/system integrators collision/contact experiments/study/text experiments/study/scenario"
                             " experiments/study/trajectory experiments/study/record experiments/study/setup"
                             " experiments/study/metrics",
    "experiments/study/plan": "core/* integrators collision collision/contact collision/shapes experiments/study/text"
                              " experiments/study/scenario experiments/study/plot experiments/study/trajectory"
                              " experiments/study/record experiments/study/run",
    "experiments/study/process": "",
    "experiments/study/workers": "core/math experiments/study/text experiments/study/trajectory experiments/study/record"
                                 " experiments/study/store experiments/study/metrics experiments/study/run"
                                 " experiments/study/plan experiments/study/process",
    "experiments/study/query": "experiments/study/text experiments/study/scenario experiments/study/record"
                               " experiments/study/store experiments/study/plan",
    "experiments/study/report/findings": "integrators experiments/study/text experiments/study/statistics"
                                         " experiments/study/plot experiments/study/record experiments/study/curves",
    "experiments/study/report/population": "experiments/study/text experiments/study/statistics experiments/study/plot"
                                           " experiments/study/record",
    "experiments/study/report/answer": "integrators experiments/study/text experiments/study/plot experiments/study/record"
                                       " experiments/study/curves experiments/study/report/findings",
    "experiments/study/report/drawing": "core/math core/problem core/forces core/joints collision collision/shapes experiments/study/text"
                                        " experiments/study/scenario experiments/study/scene",
    "experiments/study/report/figures": "experiments/study/text experiments/study/plot experiments/study/record"
                                        " experiments/study/curves",
    "experiments/study/report/article": "core/problem core/forces core/joints collision integrators experiments/study/text"
                                        " experiments/study/scenario experiments/study/plot experiments/study/record"
                                        " experiments/study/curves experiments/study/report/findings"
                                        " experiments/study/report/answer experiments/study/report/figures"
                                        " experiments/study/report/tables",
    "experiments/study/report/tables": "experiments/study/text experiments/study/plot experiments/study/record"
                                       " experiments/study/curves experiments/study/plan experiments/study/report/findings"
                                       " experiments/study/report/answer",
    "experiments/study/report/page": "integrators experiments/study/text experiments/study/plot experiments/study/record"
                                     " experiments/study/curves experiments/study/report/findings"
                                     " experiments/study/report/answer experiments/study/report/drawing"
                                     " experiments/study/report/figures experiments/study/report/tables",
    "experiments/study": "core/* integrators collision experiments/study/*",

    "experiments/archive": "experiments/study/*",
    "experiments/broad_phase": "core/* integrators collision/* experiments/study/*",
    "experiments/certificate": "core/* integrators collision/* experiments/study/*",
    "experiments/convergence": "core/* integrators collision/* experiments/study/*",
    "experiments/energy_drift": "experiments/study/*",
    "experiments/explain": "experiments/study/*",
    "experiments/figures": "experiments/study/*",
    "experiments/impact": "core/* integrators collision/* experiments/study/*",
    "experiments/joints": "core/* integrators collision/* experiments/study/*",
    "experiments/judge": "core/* integrators collision/* experiments/study/*",
    "experiments/methods": "core/* integrators collision/* experiments/study/*",
    "experiments/narrow_phase": "core/* integrators collision/* experiments/study/*",
    "experiments/pile": "core/* integrators collision/* experiments/study/*",
    "experiments/plot": "core/* integrators experiments/study/*",
    "experiments/precision": "core/* integrators collision/* experiments/study/*",
    "experiments/replay": "core/* integrators collision/* experiments/study/*",
    "experiments/rerun": "experiments/study/*",
    "experiments/results": "experiments/study/*",
    "experiments/simulate": "experiments/study/*",
    "experiments/stability": "core/* integrators collision/* experiments/study/*",
    "experiments/stack": "core/* integrators collision/* experiments/study/*",
    "experiments/work_precision": "core/* integrators collision/* experiments/study/*",

    "experiments/viewer/frame": "core/problem collision",
    "experiments/viewer/session": "core/* integrators collision collision/contact experiments/study/*"
                                  " experiments/viewer/frame",
    "experiments/viewer/drawing": "core/math core/problem experiments/study/scene experiments/viewer/frame",
    "experiments/viewer/stage": "experiments/study/text experiments/viewer/frame experiments/viewer/session"
                                " experiments/viewer/drawing",
    "experiments/viewer/overlay": "experiments/study/text experiments/study/plot experiments/study/scenario"
                                  " experiments/study/record experiments/viewer/stage",
    "experiments/viewer/pictures": "experiments/study/text experiments/viewer/stage experiments/viewer/overlay",
    "experiments/viewer/window": "experiments/study/text experiments/viewer/stage experiments/viewer/overlay"
                                 " experiments/viewer/pictures",
    "experiments/viewer": "experiments/study/* experiments/viewer/*",
}
TOP_FOLDERS = ("core", "integrators", "collision", "experiments", "tests", "papers")
CPP_SUFFIXES = {".cpp", ".cc", ".cxx", ".hpp", ".hh", ".h", ".inl", ".ipp"}
SOURCE_SUFFIXES = {".cpp", ".cc", ".cxx"}
# Every source that includes it compiles all of it, seconds each.
ONLY_IN = {"CLI/": "experiments/study/text/command_line.cpp"}
NOT_IN_A_HEADER = ("toml++/", "toml.hpp", "boost/numeric/odeint", "nlohmann/")
# Programs with the names of rooms of the study.
NAMESPACES = {"experiments/figures": "polhode::study::figures_program", "experiments/plot": "polhode::study::plot_program"}
LICENCE = "// SPDX-License-Identifier: BSD-3-Clause"
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')

NAMESPACE = re.compile(r"^namespace (polhode[\w: ]*) \{$(.*?)^\}  // namespace", re.MULTILINE | re.DOTALL)
FORWARD = re.compile(r"|template <.*>|(class|struct) \w+;|inline namespace \w+ \{|\}|")  # a line that only declares types
# The function of an entry, which stands in the namespace of its catalogue.
ENTRY = re.compile(r"\s*\w+Entry \w+\(\) \{\n(?:(?: .*)?\n)*\}\s*")


def namespace_of(room):
    """The namespace of the names in a room. The rooms of methods share one."""
    if room in NAMESPACES:
        return NAMESPACES[room]
    parts = room.split("/")
    if parts[0] == "integrators":
        return "polhode::integrators"
    if parts[0] == "experiments" and parts[1] not in ("study", "viewer"):
        return "polhode::study::" + parts[1]
    return "::".join(["polhode", *[part for part in parts if part != "experiments"]])


def foreign_namespaces(room, text):
    """The namespaces of other rooms that a file opens for more than forward declarations or the entry of a catalogue."""
    own = namespace_of(room) + "::"
    for block in NAMESPACE.finditer(text):
        name = block[1].replace("inline ", "")
        if (name + "::").startswith(own) or ENTRY.fullmatch(block[2]):
            continue
        if not all(map(FORWARD.fullmatch, block[2].splitlines())):
            yield text.count("\n", 0, block.start()) + 1, name


def may_include(room, other, table):
    """Whether a file in `room` may include one in `other`; tests may include everything."""
    if room == other or room.split("/")[0] == "tests":
        return True
    for allowed in table.get(room, "").split():
        if allowed == other or (allowed.endswith("/*") and (other + "/").startswith(allowed[:-1])):
            return True
    return False


def cycle(included):
    """A cycle of rooms, as the list of its rooms, or an empty list. `included`: room -> rooms."""
    done, path = set(), []

    def visit(room):
        if room in path:
            return path[path.index(room):] + [room]
        if room in done:
            return []
        path.append(room)
        for other in sorted(included.get(room, ())):
            found = visit(other)
            if found:
                return found
        path.pop()
        done.add(room)
        return []

    for room in sorted(included):
        found = visit(room)
        if found:
            return found
    return []


def violations(checkout, table):
    """One line for each rule that a file under `checkout` breaks."""
    found = []
    included = collections.defaultdict(set)
    for folder in TOP_FOLDERS:
        for file in sorted((checkout / folder).rglob("*")):
            if file.suffix not in CPP_SUFFIXES or not file.is_file():
                continue
            name = file.relative_to(checkout)
            if folder == "papers":
                found.append(f"{name}: papers/ holds no C++; a program belongs in experiments/")
                continue
            room = name.parent.as_posix()
            if folder != "tests" and room not in table:
                found.append(f"{name}: the room {room} has no entry in MAY_INCLUDE")
            text = file.read_text(encoding="utf-8")
            lines = text.splitlines()
            if not lines or lines[0] != LICENCE:
                found.append(f"{name}:1: the first line must be {LICENCE}")
            for number, name_space in foreign_namespaces(room, text) if folder != "tests" else ():
                found.append(f"{name}:{number}: {name_space} is not the namespace of {room}/: {namespace_of(room)}")
            for number, line in enumerate(lines, start=1):
                include = INCLUDE.match(line)
                if not include:
                    continue
                quote, target = include.groups()
                if {"", ".", ".."} & set(target.split("/")):
                    found.append(f"{name}:{number}: write {target} without . and .., from the top of the checkout")
                elif target.split("/")[0] in TOP_FOLDERS and "/" in target:
                    other = pathlib.PurePosixPath(target).parent.as_posix()
                    if not may_include(room, other, table):
                        found.append(f"{name}:{number}: {room}/ may not include {target}")
                    if folder != "tests" and other != room:
                        included[room].add(other)
                elif quote == '"':
                    found.append(f'{name}:{number}: write "{target}" from the top of the checkout, a library\'s in <>')
                elif file.suffix not in SOURCE_SUFFIXES and target.startswith(NOT_IN_A_HEADER):
                    found.append(f"{name}:{number}: {target} is slow to compile: include it in a .cpp")
                for prefix, place in ONLY_IN.items():
                    if target.startswith(prefix) and name.as_posix() != place:
                        found.append(f"{name}:{number}: {target} is slow to compile: use {place.replace('.cpp', '.hpp')}")
    around = cycle(included)
    if around:
        found.append(f"rooms include each other: {' -> '.join(around)}")
    return found


class IncludeRules(unittest.TestCase):
    def test_this_checkout_keeps_the_rules(self):
        self.assertTrue(any((CHECKOUT / "core").rglob("*.hpp")), "no headers found: looked in the wrong place")
        self.assertEqual(violations(CHECKOUT, MAY_INCLUDE), [])

    def test_the_table_names_rooms_that_are_there(self):
        for room, allowed in MAY_INCLUDE.items():
            for name in [room, *allowed.split()]:
                with self.subTest(room=room, name=name):
                    self.assertTrue((CHECKOUT / name.removesuffix("/*")).is_dir())

    def test_every_arrow_that_the_table_leaves_out_is_found(self):
        """In each room a planted file that includes every room."""
        rooms = list(MAY_INCLUDE)
        text = "".join(f'#include "{other}/b.hpp"\n' for other in rooms)
        for room in rooms:
            found = self.found_in({f"{room}/a.cpp": f"{LICENCE}\n{text}"})
            for number, other in enumerate(rooms, start=2):
                told = any(line.startswith(f"{room}/a.cpp:{number}: ") for line in found)
                with self.subTest(room=room, other=other):
                    self.assertEqual(told, not may_include(room, other, MAY_INCLUDE))
        self.assertFalse(may_include("core/math", "core/system", MAY_INCLUDE))
        self.assertFalse(may_include("integrators", "collision", MAY_INCLUDE))
        self.assertFalse(may_include("collision/broad", "integrators", MAY_INCLUDE))
        self.assertFalse(may_include("experiments/study/plot", "experiments/study/record", MAY_INCLUDE))
        self.assertFalse(may_include("experiments/judge", "experiments/stability", MAY_INCLUDE))

    def test_a_cycle_of_rooms_is_found(self):
        table = {"core/a": "core/b", "core/b": "core/c", "core/c": "core/a"}
        files = {"core/a/a.hpp": f'{LICENCE}\n#include "core/b/b.hpp"\n',
                 "core/b/b.hpp": f'{LICENCE}\n#include "core/c/c.hpp"\n',
                 "core/c/c.hpp": f"{LICENCE}\n"}
        self.assertEqual(self.found_in(files, table), [])
        files["core/c/c.cpp"] = f'{LICENCE}\n#include "core/a/a.hpp"\n'
        self.assertEqual(self.found_in(files, table), ["rooms include each other: core/a -> core/b -> core/c -> core/a"])

    def found_in(self, files, table=None):
        with tempfile.TemporaryDirectory() as folder:
            for path, text in files.items():
                file = pathlib.Path(folder, path)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8")
            return violations(pathlib.Path(folder), table or MAY_INCLUDE)

    def test_planted_violations_are_found(self):
        for path, include in [
            ("core/math/a.hpp", '"integrators/rk4.hpp"'),
            ("core/math/a.cpp", "<integrators/rk4.hpp>"),
            ("core/math/a.cpp", '"tests/a.hpp"'),
            ("integrators/a.cpp", '"collision/shape.hpp"'),
            ("integrators/a.cpp", '"experiments/study/plan/plan.hpp"'),
            ("collision/a.hpp", '"integrators/rk4.hpp"'),
            ("experiments/energy_drift/main.cpp", '"tests/a.hpp"'),
            ("integrators/a.cpp", '"../collision/shape.hpp"'),
            ("integrators/textbook/a.cpp", '"core/../collision/shape.hpp"'),
            ("collision/contact/a.cpp", '"core/../experiments/study/plan/plan.hpp"'),
            ("core/math/a.cpp", "<../core/system/state.hpp>"),
            ("core/math/a.cpp", '"./core/system/state.hpp"'),
            ("core/math/a.cpp", '"core//system/state.hpp"'),
            ("integrators/a.cpp", '"rk4.hpp"'),
            ("core/run/a.h", "<nlohmann/json.hpp>"),
            ("experiments/study/text/command_line.hpp", "<CLI/CLI.hpp>"),
            ("experiments/study/plan/a.cpp", "<CLI/CLI.hpp>"),
            ("integrators/a.hpp", "<boost/numeric/odeint/stepper/runge_kutta4.hpp>"),
            ("tests/a.hpp", "<toml++/toml.h>"),
        ]:
            with self.subTest(path=path, include=include):
                found = self.found_in({path: f"{LICENCE}\n  #  include {include}\n"})
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(f"{path}:2: "), found)
        self.assertEqual(len(self.found_in({"core/run/a.cpp": "int a;\n"})), 1)
        self.assertEqual(len(self.found_in({"core/run/a.hpp": f"\n{LICENCE}\n"})), 1)
        self.assertEqual(len(self.found_in({"core/a.cpp": f"{LICENCE}\n"})), 1)
        self.assertEqual(len(self.found_in({"papers/study/a.cpp": f"{LICENCE}\n"})), 1)

    def test_names_in_the_namespace_of_another_room_are_found(self):
        for path, name_space in [
            ("core/math/a.hpp", "polhode"),
            ("core/math/a.cpp", "polhode::inline core"),
            ("core/math/a.hpp", "polhode::inline core::inline mathematics"),
            ("core/math/a.hpp", "polhode::inline core::inline system"),
            ("collision/broad/a.hpp", "polhode::inline collision"),
            ("integrators/textbook/a.cpp", "polhode::inline core::inline run"),
            ("experiments/judge/a.cpp", "polhode::study"),
            ("experiments/plot/a.cpp", "polhode::study::inline plot"),
            ("experiments/viewer/stage/a.cpp", "polhode::viewer::inline window"),
        ]:
            plain = name_space.replace("inline ", "")
            with self.subTest(path=path, name_space=name_space):
                text = f"{LICENCE}\n\nnamespace {name_space} {{\n\nclass A;\nint a();\n\n}}  // namespace {plain}\n"
                found = self.found_in({path: text})
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(f"{path}:3: "), found)

    def test_an_entry_opens_the_namespace_of_its_catalogue_for_itself_alone(self):
        entry = "ResponseEntry compliant() {\n  return {};\n}\n"
        for more, number in [("", 0), ("class A {\n};\n", 1), ("\nint a();\n", 1)]:
            for body in [f"{entry}{more}", f"{more}{entry}"]:
                text = f"namespace polhode::inline collision::inline response {{\n{body}}}  // namespace\n"
                with self.subTest(body=body):
                    self.assertEqual(len(self.found_in({"collision/contact/a.cpp": f"{LICENCE}\n{text}"})), number)

    def test_a_room_names_what_is_its_own_and_declares_types_of_others(self):
        forward = ("namespace polhode::inline core {\ninline namespace system {\ntemplate <class S>\nclass System;\n}\n"
                   "}  // namespace polhode::core\n")
        entry = ("namespace polhode::inline collision::inline response {\n\nResponseEntry compliant() {\n  return {};\n}\n"
                 "}  // namespace polhode::collision::response\n")
        for path, name_space in [
            ("core/math/a.hpp", "polhode::inline core::inline math"),
            ("core/system/a.hpp", "polhode::inline core::inline system::splitting"),
            ("collision/a.hpp", "polhode::inline collision"),
            ("integrators/sundials/a.cpp", "polhode::inline integrators"),
            ("experiments/study/report/page/a.hpp", "polhode::study::inline report::inline page"),
            ("experiments/plot/a.cpp", "polhode::study::plot_program"),
        ]:
            with self.subTest(path=path, name_space=name_space):
                own = f"namespace {name_space} {{\nint a();\n}}  // namespace {name_space.replace('inline ', '')}\n"
                self.assertEqual(self.found_in({path: f"{LICENCE}\n{forward}{own}{entry}"}), [])

    def test_what_is_allowed_passes(self):
        for path, include in [
            ("core/run/a.hpp", '"core/system/state.hpp"'),
            ("core/math/a.hpp", "<boost/math/tools/roots.hpp>"),
            ("integrators/a.cpp", '"core/system/state.hpp"'),
            ("integrators/a.cpp", "<boost/numeric/odeint.hpp>"),
            ("collision/a.hpp", '"core/math/quaternion.hpp"'),
            ("experiments/study/text/command_line.cpp", "<CLI/CLI.hpp>"),
            ("experiments/study/scenario/a.hpp", '"collision/shape.hpp"'),
            ("tests/laws/a.hpp", '"experiments/study/plan/plan.hpp"'),
            ("tests/laws/a.hpp", '"tests/laws/b.hpp"'),
        ]:
            with self.subTest(path=path, include=include):
                self.assertEqual(self.found_in({path: f"{LICENCE}\n#include {include}\n"}), [])


if __name__ == "__main__":
    unittest.main()
