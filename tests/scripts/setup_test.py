# SPDX-License-Identifier: BSD-3-Clause
"""scripts/setup.sh on a checkout of its own: a program whose packages came after configuring is built all the same."""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SETUP = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "setup.sh"
PROJECT = """cmake_minimum_required(VERSION 3.20)
project(checkout LANGUAGES NONE)
find_file(package package.h PATHS ${CMAKE_SOURCE_DIR} NO_DEFAULT_PATH)  # which the cache remembers
add_custom_target(study ${CMAKE_COMMAND} -E touch study_was_built)
if(package)
  add_custom_target(window ${CMAKE_COMMAND} -E touch window_was_built)
endif()
"""
PRESETS = """{"version": 3, "configurePresets": [{"name": "release", "generator": "%s", "binaryDir": "${sourceDir}/build/release"}]}"""


@unittest.skipUnless(shutil.which("cmake"), "skipped, because there is no cmake")
class Setup(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="polhode_test_")
        self.addCleanup(holder.cleanup)
        self.root = pathlib.Path(holder.name)
        (self.root / "CMakeLists.txt").write_text(PROJECT)

    def build(self, target, status=0):
        done = subprocess.run(["bash", "-euc", f'root=$PWD; . "{SETUP}"; configure release; build release {target}'], cwd=self.root,
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def test_what_came_after_configuring_is_found(self):
        for generator, program in (("Ninja", "ninja"), ("Unix Makefiles", "make")):
            with self.subTest(generator):
                if not shutil.which(program):
                    self.skipTest(f"skipped, because there is no {program}")
                shutil.rmtree(self.root / "build", ignore_errors=True)
                (self.root / "package.h").unlink(missing_ok=True)
                (self.root / "CMakePresets.json").write_text(PRESETS % generator)
                self.build("study")
                said = self.build("window", status=1)
                self.assertIn("window cannot be built: CMake does not find what it needs", said)
                (self.root / "package.h").write_text("")
                said = self.build("window")
                self.assertEqual(said.count("configuring"), 1, said)
                self.assertTrue((self.root / "build/release/window_was_built").exists())
                self.assertNotIn("configuring", self.build("window"))
                self.assertNotIn("configuring", self.build("study"))


if __name__ == "__main__":
    unittest.main()
