# SPDX-License-Identifier: BSD-3-Clause
"""replay as a user meets it: pages of runs and of studies, how large they are and what they say, and played in a browser
that has no network. POLHODE_BIN_DIR is the folder of replay, energy_drift and simulate."""
import base64
import csv
import json
import math
import pathlib
import random
import re
import struct
import unittest

from browser import PROGRAM, Browser
from programs import call, read, temporary_folder

THREE = pathlib.Path("/usr/share/javascript/three/three.min.js")
WITHOUT_THREE = "three.js is not installed (Debian's libjs-three)"
WITHOUT_BROWSER = "there is no Chromium to play the page in"
STUDY = ["--scenario", "dzhanibekov", "--integrator", "rk4,semi_implicit_euler", "--dt", "0.02", "--t-end", "8",
         "--trajectory", "csv", "--no-figures", "--out", "study"]


def data_of(page):
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page.read_text(), re.S)[1])


def numbers_of(kind, text):
    raw = base64.b64decode(text)
    return struct.unpack(f"<{len(raw) // struct.calcsize(kind)}{kind}", raw)


@unittest.skipUnless(THREE.exists(), WITHOUT_THREE)
class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)

    def refused(self, *arguments):
        done = call("replay", *arguments, folder=self.folder, status=2)
        self.assertRegex(done.stderr, r"\Areplay: [^\n]+\n\Z")
        return done.stderr

    def test_each_page_is_one_file_that_asks_for_nothing(self):
        cases = [("dzhanibekov", ["lie_euler", "rk4"]), ("spring_box", ["odeint_dopri5"]), ("lagrange_top", ["rk4"]),
                 ("bouncing_ball", ["semi_implicit_euler"]), ("simbenchmark_rolling", ["semi_implicit_euler"])]
        for scenario, methods in cases:
            with self.subTest(scenario):
                name = scenario + ".html"
                step = [] if methods == ["odeint_dopri5"] else ["--dt", "0.01"]
                done = call("replay", "--scenario", scenario, "--integrator", ",".join(methods), *step, "--t-end", "2",
                            "--out", name, folder=self.folder)
                page = self.folder / name
                *_, line, last = done.stdout.splitlines()
                self.assertEqual(last, name)
                self.assertRegex(line, rf"(one view|{len(methods)} views side by side), {page.stat().st_size / 1e6:.2f} MB$")
                text = page.read_text()
                self.assertIn("default-src 'none'", text)
                self.assertEqual(re.findall(r'<(?:script|link|img|iframe)[^>]*(?:src|href)=', text.split('id="data"')[0]), [])
                data = data_of(page)
                self.assertEqual([run["label"].split(",")[0] for run in data["runs"]], methods)
                self.assertEqual({run["instants"] for run in data["runs"]} & {0, 1}, set())

    def test_a_minute_of_ten_bodies_fits_and_says_what_is_left_out(self):
        done = call("replay", "--scenario", "pile_10", "--integrator", "semi_implicit_euler", "--dt", "0.005", "--t-end", "60",
                    "--out", "pile.html", folder=self.folder)
        page = self.folder / "pile.html"
        self.assertLess(page.stat().st_size, 3e6)
        self.assertGreater(page.stat().st_size, 2.8e6)
        kept, seen, apart = re.search(r"(\d+) of (\d+) instants are kept, at most (\S+) s apart", done.stdout).groups()
        self.assertEqual(int(seen), 12001)
        self.assertLess(float(apart), 0.0151)
        data = data_of(page)
        self.assertEqual(data["runs"][0]["instants"], int(kept))
        self.assertTrue(any(f"{kept} of {seen} instants" in text for text in data["paragraphs"]))
        whole = call("replay", "--scenario", "pile_10", "--integrator", "semi_implicit_euler", "--dt", "0.005", "--t-end", "60",
                     "--limit", "9", "--out", "pile.html", folder=self.folder)
        self.assertNotIn("instants are kept", whole.stdout)
        self.assertIn("--limit", self.refused("--limit", "0.5"))

    def test_a_study_gets_a_page_and_its_report_a_link(self):
        call("energy_drift", *STUDY, folder=self.folder)
        report = self.folder / "study" / "report.html"
        self.assertIn("<code>./run replay --results study</code>", report.read_text())
        call("replay", "--results", "study", folder=self.folder)
        page = self.folder / "study" / "replay.html"
        linked = report.read_bytes()
        self.assertIn(b'<a href="replay.html">', linked)
        first = page.read_bytes()
        call("replay", "--results", "study", folder=self.folder)
        self.assertEqual(page.read_bytes(), first, "the same study, the same bytes")
        call("energy_drift", *STUDY, folder=self.folder)
        self.assertEqual(report.read_bytes(), linked, "a report that is written again keeps its link")
        rows = read(self.folder / "study" / "runs.csv")
        call("replay", "--results", "study", "--runs", rows[1]["run"], "--out", "one.html", folder=self.folder)
        (run,) = data_of(self.folder / "one.html")["runs"]
        self.assertEqual((run["id"], run["label"]), (rows[1]["run"], "semi_implicit_euler, dt = 0.02 s"))
        self.assertIn("no run 77", self.refused("--results", "study", "--runs", "77"))

    def test_runs_and_their_files_give_the_same_motion(self):
        axes = ["--scenario", "two_cubes", "--integrator", "rk4", "--dt", "0.01", "--t-end", "2"]
        call("simulate", *axes, "--no-figures", "--out", "run", folder=self.folder)
        call("replay", "--results", "run", "--out", "kept.html", folder=self.folder)
        call("replay", *axes, "--out", "run.html", folder=self.folder)
        kept, run = (data_of(self.folder / name)["runs"][0] for name in ("kept.html", "run.html"))
        for part in ("times", "positions", "orientations", "rates", "impacts", "instants", "momentum", "energy", "facts"):
            self.assertEqual(kept[part], run[part], part)

    def test_reactions_are_those_that_studies_record(self):
        for method in ("rk4", "rattle"):  # of the state, and of the method
            with self.subTest(method):
                axes = ["--scenario", "double_pendulum", "--integrator", method, "--dt", "0.0002", "--t-end", "2"]
                call("simulate", *axes, "--no-figures", "--out", method, folder=self.folder)
                whole = {(row["t_s"], row["joint"]): [float(row[name]) for name in ("fx_N", "fy_N", "fz_N")]
                         for row in read(self.folder / method / "reactions.csv")}
                for source in (["--results", method], axes):
                    call("replay", *source, "--limit", "1.3", "--out", "page.html", "--force", folder=self.folder)
                    (run,) = data_of(self.folder / "page.html")["runs"]
                    times, forces = numbers_of("d", run["times"]), numbers_of("f", run["reactions"])
                    self.assertLess(run["instants"], 10001, "it is thinned")
                    self.assertEqual(len(forces), 6 * run["instants"])
                    at = {(float(t), int(joint)): force for (t, joint), force in whole.items()}
                    for k in range(0, len(times), 97):
                        for joint in (0, 1):
                            force = forces[6 * k + 3 * joint:][:3]
                            for seen, is_there in zip(force, at[times[k], joint]):
                                self.assertAlmostEqual(seen, is_there, delta=1e-6 * math.hypot(*force))

    def test_columns_go_by_their_names_in_any_order(self):
        axes = ["--scenario", "two_cubes", "--integrator", "rk4", "--dt", "0.01", "--t-end", "2", "--vary", "body.0.mass=1,2",
                "--trajectory", "csv", "--no-figures", "--out", "study"]
        call("energy_drift", *axes, folder=self.folder)
        call("replay", "--results", "study", "--out", "before.html", folder=self.folder)
        run = read(self.folder / "study/runs.csv")[0]["run"]
        events = self.folder / "study/trajectories" / run / "events.csv"
        self.assertGreater(len(read(events)), 0)
        tables = [self.folder / "study/runs.csv", *sorted((self.folder / "study/trajectories").glob("*/*.csv"))]
        self.assertEqual(len(tables), 7)
        for seed in range(3):
            for table in tables:
                rows = read(table)
                names = list(rows[0]) if rows else table.read_text().strip().split(",")
                random.Random(seed).shuffle(names)
                with open(table, "w", newline="", encoding="utf-8") as file:
                    writer = csv.DictWriter(file, names, lineterminator="\n")
                    writer.writeheader()
                    writer.writerows(rows)
            call("replay", "--results", "study", "--out", "after.html", folder=self.folder)
            self.assertEqual((self.folder / "after.html").read_bytes(), (self.folder / "before.html").read_bytes())
        for table, needed in ((events, ["t_s", "kind", "body_a", "body_b", "px_m", "py_m", "pz_m", "nx", "ny", "nz", "impulse_N_s"]),
                              (events.with_name("energy.csv"), ["t_s", "drift_J"]),
                              (events.with_name("trajectory.csv"), ["t_s", "body", "qw", "px_m"]),
                              (self.folder / "study/runs.csv", ["run", "scenario", "integrator", "status", "message"])):
            text = table.read_text()
            head, rest = text.split("\n", 1)
            for name in needed:
                with self.subTest((table.name, name)):
                    table.write_text(",".join("other" if n == name else n for n in head.split(",")) + "\n" + rest)
                    said = self.refused("--results", "study", "--out", "none.html")
                    self.assertIn(f"{table.relative_to(self.folder)}:1:1: ", said)
                    self.assertIn(f"column {name}", said)
            table.write_text(text)

    def test_a_configuration_that_no_run_has(self):
        call("energy_drift", *STUDY, folder=self.folder)
        table = self.folder / "study/runs.csv"
        text, rows = table.read_text(), read(table)
        for column, cell, said in (("t_end_s", "", "t_end_s is empty"), ("t_end_s", "-1", "t_end_s is not a positive number"),
                                   ("dt_s", "inf", "dt_s is not a positive number"),
                                   ("orientation", "euler", "orientation has a value that --orientation does not take")):
            with self.subTest((column, cell)):
                with open(table, "w", newline="", encoding="utf-8") as file:
                    writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
                    writer.writeheader()
                    writer.writerows([rows[0] | {column: cell}, *rows[1:]])
                self.assertIn(said, self.refused("--results", "study", "--out", "none.html"))
        table.write_text(text)

    def test_a_manifest_that_is_none(self):
        call("energy_drift", *STUDY, folder=self.folder)
        for text in ("", "[]", "3", "{", '{"command": 3}', '{"axes": {"scenario": [1]}}', "[" * 100_000, '{"scenarios": {"dzhanibekov": 3}}',
                     '{"scenarios": {"dzhanibekov": {"resolved": 3}}}'):
            with self.subTest(text[:20]):
                (self.folder / "study/manifest.json").write_text(text)
                if "scenarios" in text and "resolved" not in text:
                    call("replay", "--results", "study", "--out", "page.html", folder=self.folder)
                else:
                    self.refused("--results", "study", "--out", "none.html")

    def test_a_scenario_of_its_own_is_found_again_and_must_be_the_same(self):
        scenario = self.folder / "mine.toml"
        scenario.write_text("t_end = 1\n[[body]]\nmass = 1\ninertia = [1, 2, 3]\nangular_velocity = [0, 1, 0.1]\n")
        call("simulate", "--scenario", "mine.toml", "--dt", "0.1", "--no-figures", "--out", "run", folder=self.folder)
        call("replay", "--results", "run", folder=self.folder)
        scenario.rename(self.folder / "moved.toml")
        self.assertIn("--scenario", self.refused("--results", "run"))
        call("replay", "--results", "run", "--scenario", "moved.toml", folder=self.folder)
        (self.folder / "moved.toml").write_text(scenario.with_name("moved.toml").read_text().replace("3]", "2.9]"))
        self.assertIn("changed", self.refused("--results", "run", "--scenario", "moved.toml"))

    def test_what_is_refused(self):
        self.assertIn("`./run replay` installs", self.refused("--three", "nowhere"))
        (self.folder / "three.min.js").write_text('REVISION="150"')
        (self.folder / "examples" / "js" / "controls").mkdir(parents=True)
        (self.folder / "examples" / "js" / "controls" / "OrbitControls.js").write_text("")
        self.assertIn("revision 111", self.refused("--three", "."))
        (self.folder / "notes.txt").write_text("mine")
        self.assertIn("no replay page", self.refused("--out", "notes.txt"))
        self.assertEqual((self.folder / "notes.txt").read_text(), "mine")
        call("replay", "--t-end", "1", "--out", "notes.txt", "--force", folder=self.folder)
        call("replay", "--t-end", "2", "--out", "notes.txt", folder=self.folder)
        call("simulate", "--trajectory", "hdf5", "--dt", "0.1", "--no-figures", "--out", "h5", folder=self.folder)
        self.assertIn("HDF5", self.refused("--results", "h5"))
        call("simulate", "--trajectory", "none", "--dt", "0.1", "--no-figures", "--out", "none", folder=self.folder)
        self.assertIn("no trajectory", self.refused("--results", "none"))
        self.assertIn("no study", self.refused("--results", "."))
        self.assertIn("at most 16 runs", self.refused("--dt", "0.1:0.2:17", "--integrator", "rk4"))
        self.assertEqual(sorted(p.name for p in self.folder.glob("*.html")), [])


def turn_between(a, b):
    """rad, between two orientations."""
    cosine = abs(sum(x * y for x, y in zip(a, b))) / math.hypot(*a) / math.hypot(*b)
    return 2 * math.acos(min(1, cosine))


@unittest.skipUnless(THREE.exists(), WITHOUT_THREE)
@unittest.skipUnless(PROGRAM, WITHOUT_BROWSER)
class Played(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.browser = cls.enterClassContext(Browser())

    def open(self, page, **how):
        self.browser.errors.clear()
        self.browser.requests.clear()
        self.browser.open(page, **how)

    def check_quiet(self):
        self.assertEqual(self.browser.errors, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith("file:")], [])

    def colours(self, left, top, width, height):
        """How many colours there are in a part of the picture, given in shares of it."""
        return self.browser.run(f"""(() => {{
            const from = document.getElementById("scene"), copy = document.createElement("canvas");
            copy.width = from.width; copy.height = from.height;
            const pen = copy.getContext("2d");
            pen.drawImage(from, 0, 0);
            const part = pen.getImageData({left} * copy.width, {top} * copy.height, {width} * copy.width, {height} * copy.height).data;
            const seen = new Set();
            for (let i = 0; i < part.length; i += 4) seen.add(part[i] << 16 | part[i + 1] << 8 | part[i + 2]);
            return seen.size;
        }})()""")

    def test_shows_the_recorded_motion(self):
        call("energy_drift", *STUDY, folder=self.folder)
        call("replay", "--results", "study", folder=self.folder)
        self.open(self.folder / "study" / "replay.html")
        for view, run in enumerate(read(self.folder / "study" / "runs.csv")):
            rows = read(self.folder / "study" / "trajectories" / run["run"] / "trajectory.csv")
            for row in rows[::37] + rows[-1:]:
                seen = self.browser.run(f"(replay.seek({row['t_s']}), replay.body({view}, 0))")
                for have, name in zip(seen["position"], ("px_m", "py_m", "pz_m")):
                    self.assertAlmostEqual(have, float(row[name]), delta=6e-8 * abs(float(row[name])))
                q = [float(row[name]) for name in ("qw", "qx", "qy", "qz")]
                self.assertLess(turn_between(seen["orientation"], q), 5e-5)
            before, after = rows[100:102]
            middle = (float(before["t_s"]) + float(after["t_s"])) / 2
            seen = self.browser.run(f"(replay.seek({middle}), replay.body({view}, 0))")["orientation"]
            halves = [turn_between(seen, [float(row[n]) for n in ("qw", "qx", "qy", "qz")]) for row in (before, after)]
            self.assertAlmostEqual(halves[0], halves[1], delta=1e-4)
        end = self.browser.run("(replay.seek(100), replay.time)")
        self.assertEqual(end, 8, "nothing is shown beyond what was recorded")
        self.browser.frames(2)
        for half in (0, 0.5):
            self.assertGreater(self.colours(half, 0.1, 0.5, 0.9), 50)
        self.check_quiet()

    def test_plays_and_obeys_the_keys(self):
        call("replay", "--t-end", "4", "--out", "keys.html", folder=self.folder)
        self.open(self.folder / "keys.html", dark=True)
        here, time = self.browser, "replay.time"
        self.assertEqual(here.run(time), 0)
        before = self.colours(0, 0.1, 1, 0.9)
        here.key(" ", code="Space")
        here.wait_for("replay.playing && replay.time > 0.3")
        here.key(" ", code="Space")
        self.assertFalse(here.run("replay.playing"))
        here.key("Home")
        self.assertEqual(here.run(time), 0)
        for expected in (0.01, 0.02):
            here.key("ArrowRight")
            self.assertAlmostEqual(here.run(time), expected, delta=1e-12)
        here.key("ArrowLeft")
        self.assertAlmostEqual(here.run(time), 0.01, delta=1e-12)
        here.key("End")
        self.assertAlmostEqual(here.run(time), 4, delta=1e-12)
        self.assertGreater(before, 50)
        for toggle in here.run("[...document.querySelectorAll('#toggles input')].map((box) => box.id)"):
            here.run(f"document.getElementById('{toggle}').click()")
            here.frames(2)
        self.check_quiet()

    def test_pauses_where_bodies_meet(self):
        call("simulate", "--scenario", "bouncing_ball", "--dt", "0.005", "--no-figures", "--out", "ball", folder=self.folder)
        call("replay", "--results", "ball", folder=self.folder)
        self.open(self.folder / "ball" / "replay.html")
        first = float(read(self.folder / "ball" / "events.csv")[0]["t_s"])
        self.browser.run("document.getElementById('show-pause').click()")
        self.browser.run(f"(replay.seek({first - 0.2}), replay.play())")
        self.browser.wait_for("!replay.playing")
        self.assertAlmostEqual(self.browser.run("replay.time"), first, delta=1e-6)
        self.check_quiet()

    def pixels(self, condition):
        """How many pixels fulfil it, and the mean of their rows from the upper edge."""
        self.browser.frames(2)
        return self.browser.run(f"""(() => {{
            const from = document.getElementById("scene"), copy = document.createElement("canvas");
            copy.width = from.width; copy.height = from.height;
            const pen = copy.getContext("2d");
            pen.drawImage(from, 0, 0);
            const all = pen.getImageData(0, 0, copy.width, copy.height).data;
            let n = 0, rows = 0;
            for (let i = 0; i < all.length; i += 4) {{
                const [red, green, blue] = all.slice(i, i + 3);
                if ({condition}) {{ ++n; rows += Math.floor(i / 4 / copy.width); }}
            }}
            return [n, rows / n];
        }})()""")

    def test_joints_and_reactions(self):
        call("replay", "--scenario", "rod_pendulum", "--vary", "gravity=[0,0,-9.81]", "--vary", "body.0.position=[0,0,-1]",
             "--integrator", "rk4", "--dt", "0.01", "--t-end", "1", "--out", "hanging.html", folder=self.folder)
        self.open(self.folder / "hanging.html")
        seen = self.browser.run("(replay.seek(0.505), replay.joint(0, 0))")
        self.assertEqual(seen["name"], "rod")
        for have, expected in zip(seen["force"] + seen["point"], (0, 0, 9.81, 0, 0, -1)):  # on the bob, and up
            self.assertAlmostEqual(have, expected, delta=1e-6)
        words = "[...document.querySelectorAll('.view dl > *')].filter((e) => !e.hidden).map((e) => e.textContent)"
        self.assertEqual(self.browser.run(words)[-2:], ["rod", "9.81 N"])
        arrow, bob = "red > 100 && green < 0.3 * red && blue < 0.5 * red", "blue > 120 && red < 0.7 * blue && green > red"
        red, row = self.pixels(arrow)
        self.assertGreater(red, 50)
        self.assertLess(row + 10, self.pixels(bob)[1], "it points up")
        self.browser.run("document.getElementById('show-reactions').click()")
        self.assertEqual(self.pixels(arrow)[0], 0)
        self.assertNotIn("rod", self.browser.run(words))
        dark = "red + green + blue < 400"  # the rod, and some of the bob
        with_rod = self.pixels(dark)[0]
        self.browser.run("document.getElementById('show-joints').click()")
        self.assertLess(self.pixels(dark)[0], with_rod - 300)
        self.check_quiet()

    def test_a_disk_touches_the_plane_on_which_it_rolls(self):
        call("replay", "--scenario", "rolling_disk", "--integrator", "rk4", "--dt", "0.001", "--t-end", "0.5", "--out", "disk.html",
             folder=self.folder)
        self.open(self.folder / "disk.html")
        for t in (0, 0.2, 0.4):
            point = self.browser.run(f"(replay.seek({t}), replay.joint(0, 0).point)")
            center = self.browser.run("replay.body(0, 0).position")
            self.assertAlmostEqual(point[2], 0, delta=1e-4)
            self.assertAlmostEqual(math.dist(point, center), 1, delta=1e-6)
        self.check_quiet()

    def test_a_page_of_many_joints_names_the_one_with_the_largest_reaction(self):
        call("simulate", "--scenario", "squeezer", "--integrator", "rk4", "--dt", "0.0001", "--t-end", "0.01", "--no-figures",
             "--out", "squeezer", folder=self.folder)
        call("replay", "--results", "squeezer", folder=self.folder)
        self.open(self.folder / "squeezer" / "replay.html")
        rows = read(self.folder / "squeezer" / "reactions.csv")
        last = [math.hypot(*(float(row[n]) for n in ("fx_N", "fy_N", "fz_N"))) for row in rows if row["t_s"] == rows[-1]["t_s"]]
        joint = max(range(len(last)), key=last.__getitem__)
        self.browser.run("replay.seek(1)")
        self.browser.frames(2)
        words = self.browser.run("[...document.querySelectorAll('.view dl > *')].map((e) => e.textContent)")
        self.assertEqual(words[-2:], [self.browser.run(f"replay.joint(0, {joint}).name"), f"{last[joint]:.3g} N"])
        self.check_quiet()

    def test_a_run_that_is_lost_stands_still_and_says_so(self):
        done = call("replay", "--scenario", "coursework", "--integrator", "explicit_euler,rk4", "--dt", "1.5", "--t-end", "60",
                    "--out", "lost.html", folder=self.folder)
        self.assertRegex(done.stdout, "explicit_euler, dt = 1.5 s a body turns by up to .* is a guess")
        self.open(self.folder / "lost.html")
        end = data_of(self.folder / "lost.html")["runs"][0]["facts"]
        self.assertIn("diverged", dict(end)["status"])
        self.browser.run("replay.seek(40)")
        self.browser.frames(2)
        self.assertRegex(self.browser.run("document.querySelector('.ended').textContent"), r"diverged at \d")
        there = self.browser.run("replay.body(0, 0).position")
        self.assertEqual(self.browser.run("(replay.seek(60), replay.body(0, 0).position)"), there)
        self.check_quiet()

    def test_fits_a_phone(self):
        call("replay", "--scenario", "lagrange_top", "--integrator", "rk4,lie_euler,velocity_verlet", "--dt", "0.01", "--t-end", "1",
             "--out", "phone.html", folder=self.folder)
        self.open(self.folder / "phone.html", width=390, height=844)
        self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), 390)
        boxes = self.browser.run("[...document.querySelectorAll('.view')].map((v) => v.getBoundingClientRect().width)")
        self.assertEqual(len(boxes), 3)
        self.assertGreater(min(boxes), 350, "one below the other")
        for third in (0, 1, 2):
            self.assertGreater(self.colours(0, third / 3 + 0.05, 1, 0.25), 50)
        self.check_quiet()

    def test_answer_motion_and_curves_share_a_window(self):
        call("replay", "--scenario", "dzhanibekov", "--integrator", "rk4,semi_implicit_euler", "--dt", "0.05", "--t-end", "5",
             "--out", "window.html", folder=self.folder)
        self.open(self.folder / "window.html", width=1280, height=720)
        tops, bottoms = zip(*self.browser.run("['answer', 'stage', 'plot'].map((id) => document.getElementById(id).getBoundingClientRect())"
                                              ".map((box) => [box.top, box.bottom])"))
        self.assertEqual(list(tops), sorted(tops))
        self.assertGreater(bottoms[0], tops[0])
        self.assertLessEqual(bottoms[-1], 720)
        self.check_quiet()


if __name__ == "__main__":
    unittest.main()
