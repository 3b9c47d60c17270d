# SPDX-License-Identifier: BSD-3-Clause
"""The viewer on a full disk: a file that cannot be written to its end is no success. What stands for the disk is the largest
size that a file of the process may have."""
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "experiments"))
from programs import BIN, temporary_folder  # noqa: E402

PATIENCE = 240  # s
SCENE = ["--scenario", "dzhanibekov", "--offscreen", "--size", "160x120", "--samples", "1", "--frames-per-second", "10", "--dt", "0.01"]


@unittest.skipUnless((BIN / "viewer").exists(), "skipped, because the viewer's packages are not installed: ./run viewer installs them")
class FullDisk(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def viewer(self, *arguments, largest=None):
        """With files of at most `largest` bytes."""
        def full_disk():
            if largest is not None:
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # a write fails then, as it does on a full disk
                resource.setrlimit(resource.RLIMIT_FSIZE, (largest, largest))
        return subprocess.run([str(BIN / "viewer"), *SCENE, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=PATIENCE, preexec_fn=full_disk,
                              env={**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", "ASAN_OPTIONS": "detect_leaks=0",
                                   "MESA_SHADER_CACHE_DISABLE": "true"})

    def refused(self, *arguments, largest, say):
        done = self.viewer(*arguments, largest=largest)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertRegex(done.stderr, rf"\Aviewer: {say}[^\n]*\n\Z")

    def test_a_film(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("skipped, because ffmpeg is not installed")
        film = self.folder / "film.mp4"
        done = self.viewer("--film", "film.mp4", "--duration", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        size = film.stat().st_size
        film.unlink()
        for largest in (size - 1, size - 200, size // 2, 0):  # ffmpeg itself ends well where only its last bytes are lost
            with self.subTest(largest=largest, size=size):
                self.refused("--film", "film.mp4", "--duration", "2", largest=largest, say="no film film.mp4: ffmpeg failed: ")
                self.assertEqual(sorted(self.folder.iterdir()), [])

    def test_pictures(self):
        self.refused("--duration", "0", "--out", "pictures", largest=100, say="cannot write pictures/frame_0001.png: ")

    def test_a_trajectory(self):
        done = self.viewer("--duration", "3", "--out", "pictures", "--write-trajectory", "motion")
        self.assertEqual(done.returncode, 0, done.stderr)
        table = self.folder / "motion/run_1/segment_1/trajectory.csv"
        text = table.read_bytes()
        self.assertGreater(len(text), 40_000)
        shutil.rmtree(self.folder / "motion")
        for largest in (len(text) - 1, len(text) // 2):  # lost when it is closed, and on the way
            with self.subTest(largest=largest):
                self.refused("--duration", "3", "--out", "pictures", "--write-trajectory", "motion", largest=largest,
                             say=r"cannot write motion/run_1/segment_1/trajectory\.csv")
                self.assertFalse(table.exists())


if __name__ == "__main__":
    unittest.main()
