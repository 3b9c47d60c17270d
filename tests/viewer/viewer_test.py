#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The viewer as its user sees it: in a window under Xvfb with Mesa's software renderer, driven by scripts, and without one."""
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "experiments"))
from programs import BIN, call, temporary_folder  # noqa: E402

PATIENCE = 240  # s
# What drivers keep when they are unloaded is not ours; viewer_tests looks for leaks without them.
ENVIRONMENT = {**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", "ASAN_OPTIONS": "detect_leaks=0"}


def colours(path):
    """Width, height and the bytes of a picture, by ffmpeg."""
    shape = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=width,height", "-of", "csv=p=0", str(path)],
                           capture_output=True, text=True, check=True).stdout
    width, height = map(int, shape.strip().split(","))
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                         capture_output=True, check=True).stdout
    return width, height, raw


@unittest.skipUnless((BIN / "viewer").exists(), "skipped, because the viewer's packages are not installed: ./run viewer installs them")
class Viewer(unittest.TestCase):
    display = None

    @classmethod
    def setUpClass(cls):
        if not shutil.which("Xvfb"):
            return
        ours, its = os.pipe()  # through which it says the number of the display that it took
        server = subprocess.Popen(["Xvfb", "-displayfd", str(its), "-screen", "0", "1280x720x24", "-nolisten", "tcp"],
                                  pass_fds=[its], stderr=subprocess.DEVNULL)
        os.close(its)
        cls.addClassCleanup(server.wait)
        cls.addClassCleanup(server.terminate)
        with os.fdopen(ours) as number:
            cls.display = ":" + number.readline().strip()

    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def window(self, script, *arguments, status=0):
        if not self.display:
            self.skipTest("skipped, because Xvfb is not installed")
        done = subprocess.run([str(BIN / "viewer"), "--script", str(HERE / script), *map(str, arguments)], cwd=self.folder,
                              capture_output=True, text=True, timeout=PATIENCE,
                              env={**ENVIRONMENT, "DISPLAY": self.display})
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def assert_not_blank(self, path):
        if not shutil.which("ffprobe"):
            self.skipTest("skipped, because ffmpeg is not installed")
        width, height, raw = colours(path)
        self.assertEqual((width, height), (1280, 720))
        seen = {raw[i:i + 3] for i in range(0, len(raw), 3 * 97)}
        self.assertGreater(len(seen), 100, "hardly any colours")

    def test_no_display_is_one_line_that_names_replay(self):
        environment = {k: v for k, v in ENVIRONMENT.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        done = subprocess.run([str(BIN / "viewer")], cwd=self.folder, capture_output=True, text=True, env=environment, timeout=PATIENCE)
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn("./run replay", done.stderr)
        self.assertEqual(done.stdout, "")

    def test_every_control(self):
        self.window("every_control.txt")
        for name in ("several.png", "collision.png", "joints.png", "results/viewer-dzhanibekov/picture_1.png"):
            self.assert_not_blank(self.folder / name)
        for session in sorted(self.folder.glob("results/*/session_*.toml")):
            with self.subTest(session=session.name):
                self.assertIn("steps to t =", call("viewer", "--rerun", session, folder=self.folder).stdout)

    def test_a_script_that_does_not_hold_fails(self):
        script = self.folder / "wrong.txt"
        script.write_text("expect integrator heun\n")
        self.assertIn("wrong.txt:1: expected integrator heun; it is rk4", self.window(script, status=2).stderr)
        script.write_text("click nowhere\n")
        self.assertIn("wrong.txt:1: there is no control 'nowhere'", self.window(script, status=2).stderr)

    def test_bodies_are_where_the_state_has_them(self):
        self.window("five_cubes.txt", "--scenario", "five_cubes", "--record", "off")
        self.assert_not_blank(self.folder / "picture.png")
        width, height, raw = colours(self.folder / "picture.png")
        with open(self.folder / "places.csv", newline="", encoding="utf-8") as file:
            places = list(csv.DictReader(file))
        self.assertEqual(len(places), 10)
        for place in places:
            x, y = round(float(place["x_px"])), round(float(place["y_px"]))
            with self.subTest(run=place["run"], body=place["body"]):
                self.assertTrue(320 <= x < width and 0 <= y < height - 170)
                at = raw[3 * (y * width + x):][:3]
                own = [int(place[c]) for c in ("red", "green", "blue")]
                # Light scales a colour; its proportions stay.
                scale = sum(at) / sum(own)
                self.assertTrue(0.4 < scale < 1.3, f"{list(at)} against {own}")
                for seen, is_own in zip(at, own):
                    self.assertLess(abs(seen - scale * is_own), 30, f"{list(at)} against {own}")

    def test_digits_are_those_without_a_window(self):
        for scenario, *options in (("tumbling_cube", "--integrator", "rk4", "--dt", "0.001"),
                                   ("pile_10", "--integrator", "semi_implicit_euler", "--dt", "0.01", "--t-end", "3"),
                                   ("dzhanibekov", "--integrator", "cvode_adams", "--tolerance", "1e-9", "--t-end", "20")):
            with self.subTest(scenario=scenario):
                self.window("to_the_end.txt", "--scenario", scenario, *options, "--speed", "30", "--record", "off",
                            "--write-trajectory", f"seen_{scenario}")
                call("simulate", "--scenario", scenario, *options, "--trajectory", "csv", "--no-figures", "--out", f"unseen_{scenario}",
                     folder=self.folder)
                seen = (self.folder / f"seen_{scenario}/run_1/segment_1/trajectory.csv").read_bytes()
                self.assertGreater(len(seen), 10000)
                self.assertEqual(seen, (self.folder / f"unseen_{scenario}/trajectory.csv").read_bytes())

    def test_pictures_and_a_film_without_a_display(self):
        environment = {k: v for k, v in ENVIRONMENT.items() if k != "DISPLAY"}
        arguments = [str(BIN / "viewer"), "--offscreen", "--scenario", "two_cubes", "--plots", "--show", "axes,contacts,trails"]
        subprocess.run([*arguments, "--pause-on-collision", "--frames-per-second", "10", "--out", "paused"], cwd=self.folder, check=True,
                       capture_output=True, env=environment, timeout=PATIENCE)
        pictures = sorted((self.folder / "paused").iterdir())
        self.assertEqual([p.name for p in pictures], [f"frame_{k:04}.png" for k in range(1, 12)])  # they meet after 1 s
        self.assert_not_blank(pictures[-1])
        subprocess.run([*arguments, "--duration", "1", "--film", "film.mp4"], cwd=self.folder, check=True, capture_output=True,
                       env=environment, timeout=PATIENCE)
        shape = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=width,height,nb_read_frames",
                                "-of", "csv=p=0", "film.mp4"], cwd=self.folder, capture_output=True, text=True, check=True).stdout
        self.assertEqual(shape.strip().strip(","), "1280,720,31")

    def test_recorded_trajectories_of_a_study(self):
        call("energy_drift", "--scenario", "lagrange_top", "--integrator", "rk4,semi_implicit_euler", "--dt", "0.01", "--t-end", "1",
             "--trajectory", "csv", "--no-figures", "--out", "study", folder=self.folder)
        files = sorted((self.folder / "study/trajectories").glob("*/trajectory.csv"))
        self.assertEqual(len(files), 2)
        (self.folder / "play.txt").write_text("click play\nuntil t#2 0.5\nclick pause\nwait 5\nexpect runs 2\npicture picture.png\n"
                                              "drag time 0.5\nwait 5\nexpect t < 0.6\nclick reset\nwait 5\nexpect t 0\n")
        arguments = [word for file in files for word in ("--trajectory", file)]
        self.window(self.folder / "play.txt", "--scenario", "lagrange_top", *arguments)
        self.assert_not_blank(self.folder / "picture.png")

    def test_bad_input_is_one_line(self):
        for arguments, expected in ((("--integrator", "rk5"), "no integrator is called 'rk5'"),
                                    (("--size", "12"), "--size: '12'"),
                                    (("--show", "everything"), "--show: no 'everything'"),
                                    (("--integrator", "cvode_adams", "--drive", "frame_clock"), "take the accumulator")):
            with self.subTest(arguments=arguments):
                done = call("viewer", *arguments, "--offscreen", folder=self.folder, status=2)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertIn(expected, done.stderr)


if __name__ == "__main__":
    unittest.main()
