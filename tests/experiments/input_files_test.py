# SPDX-License-Identifier: BSD-3-Clause
"""Files that are none, or have no end, and names that nobody reads: every program says it in one line and ends."""
import unittest

from programs import BIN, call, temporary_folder

LONG = "x" * 100_000
LINES = "rk4\n" * 5001
FREE = "t_end = 1\n[[body]]\nmass = 1\ninertia = [1, 2, 3]\n"


class InputFiles(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def refused(self, *arguments, say=""):
        done = call(*arguments, folder=self.folder, status=2)
        self.assertRegex(done.stderr, rf"\A{arguments[0]}: [^\n]+\n\Z")
        self.assertLess(len(done.stderr), 4000)
        self.assertIn(say, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertFalse((self.folder / "results").exists())
        return done.stderr

    def test_a_study_file_must_be_one(self):
        self.refused("energy_drift", "--study", ".", say="--study .: is a folder")
        self.refused("energy_drift", "--study", "", say="no such file")
        self.refused("energy_drift", "--study", self.write("empty.toml", ""), say="--study empty.toml: there is nothing in it")
        self.refused("energy_drift", "--study", self.write("comment.toml", "# later\n"), say="there is nothing in it")
        self.refused("energy_drift", "--study", "/dev/zero", say="/dev/zero: byte 1 is zero")
        self.refused("energy_drift", "--study", self.write("large.toml", "#" * (16 << 20) + "\n"), say="larger than 16 MiB")

    def test_deep_keys(self):
        deep = "a." * 100_000 + "a = 1\n"
        self.refused("energy_drift", "--study", self.write("deep.toml", "dt = 0.1\n" + deep), say="deep.toml:2:")
        self.refused("energy_drift", "--study", self.write("deep.toml", "dt = 0.1\nvary." + deep), say="nested more than 100 deep")
        self.refused("energy_drift", "--study", self.write("deep.toml", "dt = " + "[" * 100_000 + "]" * 100_000), say="deep.toml:1:")
        self.refused("energy_drift", "--scenario", self.write("deep_scenario.toml", FREE + deep), say="deep_scenario.toml:5:")

    def test_what_has_no_end(self):
        self.refused("energy_drift", "--scenario", "/dev/zero", say="/dev/zero: byte 1 is zero")
        self.refused("judge", "--scenario", "peters_hsu", "/dev/zero", say="/dev/zero: byte 1 is zero")
        self.refused("narrow_phase", "--pairs", "/dev/zero", say="/dev/zero:1:1: ")
        self.refused("broad_phase", "--boxes", "/dev/zero", "--broad-phase", "all_pairs", "--out", "p.csv", say="/dev/zero:1:1: ")
        mesh = FREE + 'shape = { kind = "convex_hull", file = "%s" }\n'
        for file in ("/dev/zero", "."):
            name = self.write("mesh.toml", "contact = true\n" + mesh % file)
            self.refused("energy_drift", "--scenario", name, say="is no file but a folder, a device or a pipe")

    def test_long_names_are_cut(self):
        for program in ("energy_drift", "simulate", "replay", "certificate"):
            if not (BIN / program).exists():
                continue
            for option in ("--integrator", "--scenario", "--dt", "--orientation", "--study", "--list"):
                with self.subTest((program, option)):
                    self.refused(program, option, LONG)
                    self.refused(program, option, LINES)
            self.refused(program, "--" + LONG)
            self.refused(program, LONG)
            self.refused(program, "--scenario", "peters_hsu", "--vary", f"{LONG}=1,2")
            self.refused(program, "--scenario", "peters_hsu", "--vary", f"body.0.mass={LONG}")
        self.refused("narrow_phase", "--narrow-phase", LONG, "--pairs", "p.csv")
        self.refused("broad_phase", "--broad-phase", LONG)
        self.refused("judge", "--scenario", LONG, "a.csv")
        self.refused("judge", "--scenario", "peters_hsu", LINES)

    def test_long_texts_in_files_are_cut(self):
        for text in (f"{LONG} = 1\n", f'integrator = "{LONG}"\n', f'[vary]\n"{LONG}" = [1, 2]\n', f'dt = """{LINES}"""\n'):
            with self.subTest(text[:20]):
                self.refused("energy_drift", "--study", self.write("long.toml", text))
        for text in (f"{LONG} = 1\n{FREE}", FREE + f'name = "{LONG}"\npinned = 1\n', FREE + f"{LONG} = 1\n", FREE + f'shape = {{ kind = "{LONG}" }}\n',
                     FREE + f'name = """{LINES}"""\n', FREE + f'[[force]]\nkind = "{LONG}"\nbodies = ["body0"]\n',
                     FREE + f'[[force]]\nkind = "drag"\nbodies = ["{LONG}"]\n', f'invariants = ["{LONG}"]\n' + FREE):
            with self.subTest(text[:20]):
                self.refused("energy_drift", "--scenario", self.write("long_scenario.toml", text), "--integrator", "rk4", say="long_scenario.toml:")
        self.refused("narrow_phase", "--pairs", self.write("pairs.csv", f"id,ahx,{LONG}\n1,2,3\n"), say="pairs.csv:1:")
        self.refused("judge", "--scenario", "peters_hsu", self.write("t.csv", f"t_s,qw,qx,qy,qz\n{LONG},1,0,0,0\n"), say="t.csv:2:1: t_s is")


if __name__ == "__main__":
    unittest.main()
