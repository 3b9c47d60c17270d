# SPDX-License-Identifier: BSD-3-Clause
"""Studies that meet faults: runs that throw, damaged stores, files and folders in the wrong place, full disks.

POLHODE_BIN_DIR is the folder of energy_drift. Every test works in its own temporary folder.
"""
import contextlib
import os
import pathlib
import pwd
import re
import resource
import shutil
import signal
import sqlite3
import subprocess
import tempfile
import unittest
from random import Random

from programs import BIN, PATIENCE, read, temporary_folder
from shards_test import files

SMALL = ["--scenario", "lagrange_top", "--integrator", "rk4", "--dt", "1e-2,5e-3", "--t-end", "1", "--no-figures"]
CONTACT = """t_end = 1
contact = true
gravity = [0, 0, -9.81]
[[body]]
name = "box"
mass = 1
shape = {{ kind = "box", size = {size} }}
position = [0, 0, {height}]
angular_velocity = [1, 2, 3]
restitution = 0.5
friction = 0.5
{more}
[[body]]
name = "floor"
static = true
restitution = 0.5
friction = 0.5
shape = {{ kind = "half_space", normal = [0, 0, 1] }}
"""


class FaultsTest(unittest.TestCase):
    maxDiff = 2000

    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)
        self.out = self.folder / "out"

    def call(self, *arguments, status=0, out=None, **settings):
        """Runs energy_drift; it ends with this status, and says why, or what it mends, in one line on stderr."""
        done = subprocess.run([str(BIN / "energy_drift"), *map(str, arguments), "--out", str(out or self.out)],
                              cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE, stdin=subprocess.DEVNULL,
                              **settings)
        self.assertEqual(done.returncode, status, f"{arguments}\n{done.stdout[-1500:]}\n{done.stderr[-1500:]}")
        progress = re.compile(r".*(runs are there already|runs, \d+ %, .* left)\n")
        done.said = "".join(line for line in done.stderr.splitlines(keepends=True) if not progress.fullmatch(line))
        self.assertEqual(done.said.count("\n"), 1 if status or done.said else 0, done.stderr)
        return done

    def refused(self, *arguments, say, out=None, **settings):
        done = self.call(*arguments, status=2, out=out, **settings)
        self.assertEqual(done.stdout, "")
        for text in say:
            self.assertIn(str(text), done.stderr)

    def mounted(self, *arguments):
        """A small file system, taken away after the test."""
        place = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        done = subprocess.run(["mount", *map(str, arguments), str(place)], capture_output=True, text=True)
        if done.returncode != 0:
            self.skipTest(f"no file system can be mounted here: {done.stderr.strip()}")
        self.addCleanup(subprocess.run, ["umount", str(place)], capture_output=True)
        return place

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return f"./{name}"


class BadRuns(FaultsTest):
    def test_what_a_run_throws_ends_that_run_alone(self):
        scenario = self.write("tiny.toml", CONTACT.format(size="[1e-6, 1e-6, 1e-6]", height=2e-6, more=""))
        study = ["--scenario", scenario, "--integrator", "rk4,dmv,explicit_euler", "--dt", "1e-2,1e-3", "--vary",
                 "body.0.shape.size=[1,1,1];[1e-6,1e-6,1e-6]", "--vary", "body.0.position.2=1", "--impact-timing",
                 "event_located", "--no-figures"]
        done = self.call(*study, status=3)
        rows = read(self.out / "runs.csv")
        self.assertEqual(len(rows), 12)
        for row in rows:
            self.assertIn(row["status"], ("ok", "diverged", "failed"))
            self.assertEqual(row["message"] == "", row["status"] == "ok")
        lost = [r for r in rows if r["status"] != "ok"]
        self.assertTrue(lost, "no run of a box of 1 µm was lost: this test needs another one")
        self.assertTrue(all(r["body.0.shape.size"] == "[1e-6,1e-6,1e-6]" for r in lost))
        failed = [r for r in rows if r["status"] == "failed"]
        self.assertRegex(done.said, rf"^energy_drift: {len(failed)} of 12 runs failed")
        self.assertIn(failed[0]["message"], done.said)
        table = (self.out / "runs.csv").read_bytes()
        again = self.call(*study, status=3)
        self.assertEqual(again.stderr, done.said, "nothing was left to be carried out")
        self.assertEqual((self.out / "runs.csv").read_bytes(), table)
        forced = self.call(*study, "--force", status=3)
        self.assertIn(f"{12 - len(failed)} of 12 runs are there already", forced.stderr)

    def test_a_state_that_is_lost_in_a_step_with_contact_has_diverged(self):
        scenario = self.write("tiny.toml", CONTACT.format(size="[1e-6, 1e-6, 1e-6]", height=0.01, more=""))
        self.call("--scenario", scenario, "--integrator", "rk4,heun", "--dt", "1e-2,1e-3", "--no-figures")
        rows = read(self.out / "runs.csv")
        lost = [r for r in rows if r["status"] != "ok"]
        self.assertTrue(lost, "no run of a box of 1 µm was lost: this test needs another one")
        for row in lost:
            self.assertEqual(row["status"], "diverged")
            self.assertIn("the state ceased to be finite at t = ", row["message"])

    def test_bodies_in_one_place_fail_with_the_cause_and_the_remedy(self):
        scenario = self.write("crowd.toml", 't_end = 1\ncontact = true\n[[body]]\nname = "a"\nmass = 1\nshape = { kind = '
                              '"box", size = [1, 1, 1] }\nrepeat = [1500, 1, 1]\nspacing = [1e-9, 0, 0]\n')
        done = self.call("--scenario", scenario, "--integrator", "semi_implicit_euler", "--dt", "0.1", "--no-figures", status=3)
        row = read(self.out / "runs.csv")[0]
        self.assertEqual(row["status"], "failed")
        for text in (row["message"], done.said):
            self.assertIn("1500 bodies", text)
            self.assertIn("set them apart", text)

    def test_an_adaptive_run_has_a_limit_of_steps(self):
        study = ["--scenario", "oscillator", "--integrator", "cvode_adams,rk4", "--tolerance", "1e-10", "--dt", "1e-2",
                 "--t-end", "5", "--no-figures"]
        self.call(*study)
        steps = {r["integrator"]: int(r["steps"]) for r in read(self.out / "runs.csv")}
        few = self.folder / "few"
        done = self.call(*study, "--max-steps", 100, status=3, out=few)
        self.assertGreater(steps["cvode_adams"], 100)
        adams, rk4 = read(few / "runs.csv")
        self.assertEqual((adams["status"], adams["steps"]), ("failed", "100"))
        self.assertEqual((rk4["status"], int(rk4["steps"])), ("ok", steps["rk4"]))
        for text in (adams["message"], done.said):
            self.assertRegex(text, "100 steps.*--tolerance.*--max-steps")
        enough = self.folder / "enough"
        self.call(*study, "--max-steps", steps["cvode_adams"], out=enough)
        self.assertEqual({r["integrator"]: int(r["steps"]) for r in read(enough / "runs.csv")}, steps)

    def test_a_study_that_was_not_carried_out_says_why(self):
        done = self.call("--scenario", "peters_hsu", "--integrator", "rk4", "--dt", "1e-2", "--gyroscopic", "on,off",
                         "--angular-state", "velocity_world,momentum_world", "--no-figures", status=3)
        self.assertRegex(done.said, "^energy_drift: 1 of 4 runs refused: gyroscopic off makes no sense with the momentum state")

    def test_no_number_of_the_table_is_infinite(self):
        """Impacts at speeds whose squares overflow."""
        spring = '[[force]]\nkind = "spring"\nbodies = ["box"]\nstiffness = 1e200\n'
        scenario = self.write("fast.toml", CONTACT.format(size="[1, 1, 1]", height=2, more="") + spring)
        self.call("--scenario", scenario, "--integrator", "explicit_euler,semi_implicit_euler,rk4,explicit_midpoint", "--dt",
                  "0.5,0.1,0.01", "--no-figures")
        rows = read(self.out / "runs.csv")
        self.assertEqual({r["status"] for r in rows}, {"diverged"})
        for row in rows:
            for column, cell in row.items():
                self.assertNotRegex(cell, r"(?i)^([-+]?(nan|inf.*)|-0)$", column)


class DamagedStores(FaultsTest):
    @classmethod
    def setUpClass(cls):
        cls.whole = temporary_folder(cls.addClassCleanup) / "whole"
        subprocess.run([str(BIN / "energy_drift"), *SMALL, "--out", str(cls.whole)], check=True, capture_output=True,
                       cwd=cls.whole.parent, timeout=PATIENCE)
        cls.runs = (cls.whole / "runs.csv").read_bytes()

    def damage(self, sql):
        shutil.rmtree(self.out, ignore_errors=True)
        shutil.copytree(self.whole, self.out)
        with contextlib.closing(sqlite3.connect(self.out / "results.sqlite")) as store:
            store.executescript(sql)

    def test_a_damaged_row_is_carried_out_again(self):
        one = "WHERE number = (SELECT min(number) FROM runs)"
        damages = [(column, "UPDATE {0} SET {1} = {2} {3}".format(*column.split("."), value, one)) for column, value in (
            ("runs.invariant_drifts_max_rel", "'p_phi'"), ("runs.invariant_drifts_max_rel", "'p_phi=1e-3'"),
            ("runs.invariant_drifts_max_rel", "'p_phi=luck '"),
            ("runs.invariant_drifts_max_rel", "'p_phi=1e-3 p_psi '"), ("runs.invariant_drifts_max_rel", "NULL"),
            ("runs.status", "'perhaps'"), ("runs.status", "x'00'"), ("runs.steps", "'many'"), ("runs.steps", "-1"),
            ("runs.t_reached_s", "NULL"), ("runs.energy_drift_max_rel", "'small'"),
            ("runs.energy_initial_J", "9e999"), ("curves.series", "x'00'"), ("curves.series", "7"),
            ("curves.series", "zeroblob(41)"), ("runs.drift_exponent", "'steep'"), ("runs.energy_scale_J", "x'ff'"),
            ("curves.attitude_errors", "x'0102'"), ("runs.left_place_s", "'far'"),
            ("runs.position_reference_m", "'far'"), ("runs.drift_class", "NULL"), ("runs.drift_class", "'steep'"),
            ("runs.t_reached_s", "9e999"), ("curves.series", "NULL"), ("timings.wall_s", "'long'"))]
        damages += [("runs.checksum", f"UPDATE runs SET {change} {one}") for change in (
            "checksum = checksum + 1", "steps = steps + 1", "message = 'all is well'", "energy_initial_J = 368.5",
            "energy_drift_max_rel = 2 * energy_drift_max_rel", "energy_scale_J = NULL", "has_curves = 0")]
        damages += [("curves.checksum", f"UPDATE curves SET attitude_errors = x'' {one}"),
                    ("timings.checksum", f"UPDATE timings SET wall_s = 2 * wall_s {one}"),
                    ("curves.", f"DELETE FROM curves {one}"), ("timings.wall_s", f"DELETE FROM timings {one}")]
        for what, sql in damages:
            with self.subTest(sql):
                self.damage(sql)
                done = self.call(*SMALL)
                self.assertIn(str(self.out / "results.sqlite"), done.said)
                self.assertIn("1 of 2 runs are damaged and carried out again", done.said)
                self.assertIn(what, done.said)
                self.assertEqual((self.out / "runs.csv").read_bytes(), self.runs)
                self.assertNotIn("damaged", self.call(*SMALL).stderr, "it is whole now")

    def test_runs_whose_configuration_is_damaged_are_carried_out_again(self):
        one = "WHERE key = (SELECT configuration FROM runs ORDER BY number LIMIT 1)"
        for sql, runs in (("UPDATE configurations SET t_end_s = 'hello'", 2), ("DELETE FROM configurations", 2),
                          (f"UPDATE configurations SET dt_s = 7 {one}", 1), (f"DELETE FROM configurations {one}", 1),
                          (f"UPDATE configurations SET key = key + 1 {one}", 1),
                          ("ALTER TABLE configurations RENAME COLUMN dt_s TO step", 2),
                          ("ALTER TABLE configurations ADD COLUMN colour TEXT; UPDATE configurations SET colour = 'red'", 2)):
            with self.subTest(sql):
                self.damage(sql)
                done = self.call(*SMALL)
                self.assertIn(str(self.out / "results.sqlite"), done.said)
                self.assertIn(f"{runs} of 2 runs are damaged and carried out again", done.said)
                self.assertIn("runs.configuration", done.said)
                self.assertEqual((self.out / "runs.csv").read_bytes(), self.runs)
                self.assertNotIn("damaged", self.call(*SMALL).stderr, "it is whole now")
                listed = subprocess.run([str(BIN / "results"), str(self.out)], capture_output=True, text=True, timeout=PATIENCE)
                self.assertEqual(listed.returncode, 0, listed.stdout)

    def test_scenarios_that_are_damaged_are_written_again(self):
        def scenarios():
            with contextlib.closing(sqlite3.connect(self.out / "results.sqlite")) as store:
                return store.execute("SELECT * FROM scenarios").fetchall()

        self.damage("SELECT 1")
        whole = scenarios()
        for sql in ("UPDATE scenarios SET source = ''", "UPDATE scenarios SET canonical = NULL", "DELETE FROM scenarios"):
            with self.subTest(sql):
                self.damage(sql)
                self.call(*SMALL)
                self.assertEqual(scenarios(), whole)

    def test_a_store_that_is_no_store_is_refused_and_force_helps(self):
        def cut():
            data = (self.out / "results.sqlite").read_bytes()
            (self.out / "results.sqlite").write_bytes(data[:len(data) // 2])

        def overwrite():
            with open(self.out / "results.sqlite", "r+b") as file:
                file.seek(4096)
                file.write(b"\x5a" * 4096)

        for what, sql, more in (("other columns", "ALTER TABLE runs ADD COLUMN colour TEXT", None),
                                ("fewer columns", "ALTER TABLE runs DROP COLUMN drift_exponent", None),
                                ("no scenarios", "DROP TABLE scenarios", None),
                                ("no configurations", "DROP TABLE configurations", None),
                                ("no studies", "DROP TABLE studies", None),
                                ("scenarios with other columns", "ALTER TABLE scenarios RENAME COLUMN source TO src", None),
                                ("another table", "DROP TABLE runs; CREATE TABLE runs (id TEXT)", None),
                                ("an older version", "PRAGMA user_version = 0; PRAGMA application_id = 0", None),
                                ("a newer version", "PRAGMA user_version = 99", None),
                                ("a database of another program", "PRAGMA application_id = 1", None),
                                ("a text", "SELECT 1", lambda: (self.out / "results.sqlite").write_text("mine\n" * 2000)),
                                ("cut off", "SELECT 1", cut), ("a page of it overwritten", "SELECT 1", overwrite)):
            with self.subTest(what):
                self.damage(sql)
                if more:
                    more()
                before = {path.name: path.read_bytes() for path in self.out.iterdir() if path.is_file()}
                self.refused(*SMALL, say=["results.sqlite", "--force"])
                self.assertEqual({path.name: path.read_bytes() for path in self.out.iterdir() if path.is_file()}, before)
                self.call(*SMALL, "--force")
                self.assertEqual((self.out / "runs.csv").read_bytes(), self.runs)
                self.call(*SMALL)

    def test_a_dry_run_refuses_a_store_with_other_tables(self):
        for sql in ("DROP TABLE scenarios", "ALTER TABLE runs DROP COLUMN steps"):
            with self.subTest(sql):
                self.damage(sql)
                self.assertIn("so it is not that of this version of polhode", self.call(*SMALL, "--dry-run", status=2).said)

    def test_an_id_that_is_none_is_damage_and_no_other_study(self):
        none = "(the first: row 1, runs.id)"
        for value, said in (("id + 1", "(the first: run "), ("'abc'", none), ("x'00ff'", none), ("1.5", none)):
            for force in ((), ("--force",)):
                with self.subTest(value, force=force):
                    self.damage(f"UPDATE runs SET id = {value} WHERE number = 1")
                    done = self.call(*SMALL, *force)
                    if value != "id + 1" or not force:  # with it the run of another study takes all with it
                        self.assertIn("1 of 2 runs are damaged", done.said)
                        self.assertIn(said, done.said)
                        self.assertIn("1 of 2 runs are there already", done.stderr)
                    self.assertEqual((self.out / "runs.csv").read_bytes(), self.runs)
                    self.assertNotIn("damaged", self.call(*SMALL).stderr, "it is whole now")

    def test_random_damage_gives_the_same_table_or_one_line(self):
        random = Random(8)
        path = self.out / "results.sqlite"
        columns = []
        with contextlib.closing(sqlite3.connect(self.whole / "results.sqlite")) as store:
            for table in ("runs", "curves", "timings"):
                columns += [(table, row[1]) for row in store.execute(f"PRAGMA table_info({table})")]
        values = ["NULL", "'text'", "7", "0.5", "-1", "9e999", "x'00'", "zeroblob(80)", "{0} + 1", "{0} || 'x'", "substr({0}, 1, 40)"]
        ends = {0: 0, 2: 0, 3: 0}
        for trial in range(60):
            table, column = random.choice(columns)
            _, other = random.choice([c for c in columns if c[0] == table])
            changes = [f"UPDATE {table} SET \"{column}\" = {random.choice(values).format(column)}", f"DELETE FROM {table}",
                       f"UPDATE {table} SET \"{column}\" = \"{other}\", \"{other}\" = \"{column}\"",
                       f"ALTER TABLE {table} RENAME COLUMN \"{column}\" TO renamed"]
            sql = random.choices(changes, (6, 1, 2, 1))[0] if trial % 2 else "SELECT 1"
            if sql.startswith(("UPDATE", "DELETE")) and random.random() < 0.5:
                sql += f" WHERE number = (SELECT min(number) FROM {table})"
            with self.subTest(trial=trial, sql=sql):
                try:
                    self.damage(sql)
                except sqlite3.Error:
                    continue  # SQLite does not let it happen
                if trial % 2 == 0:
                    data = bytearray(path.read_bytes())
                    for _ in range(random.choice((1, 1, 3, 30))):
                        data[random.randrange(len(data) if random.random() < 0.8 else 200)] = random.randrange(256)
                    path.write_bytes(data[:random.randrange(len(data))] if random.random() < 0.1 else data)
                done = subprocess.run([str(BIN / "energy_drift"), *SMALL, "--out", str(self.out)], cwd=self.folder,
                                      capture_output=True, text=True, timeout=PATIENCE, stdin=subprocess.DEVNULL)
                self.assertIn(done.returncode, ends, done.stderr)
                ends[done.returncode] += 1
                if done.returncode == 0:
                    self.assertEqual((self.out / "runs.csv").read_bytes(), self.runs)
                else:
                    self.assertRegex(done.stderr, r"\A(.*runs are there already\n)?energy_drift: .*results\.sqlite: .+\n\Z")
        self.assertGreater(ends[0], 10)
        self.assertGreater(ends[2] + ends[3], 10)


class WrongPlaces(FaultsTest):
    STUDY = ["--integrator", "rk4", "--dt", "1e-2", "--trajectory", "csv", "--no-figures"]

    def test_a_file_for_a_folder_or_a_folder_for_a_file(self):
        self.call(*self.STUDY)
        table = (self.out / "runs.csv").read_bytes()
        run = next((self.out / "trajectories").iterdir()).relative_to(self.out)
        for name in ("tables", "figures", "timings", "trajectories", run, run / "trajectory.csv", "runs.csv", "report.html",
                     "results.sqlite", "results.sqlite-wal"):
            with self.subTest(str(name)):
                there = self.out / name
                is_file = there.is_file() or "sqlite" in str(name)
                shutil.rmtree(there) if there.is_dir() else there.unlink(missing_ok=True)
                if is_file:
                    there.mkdir()
                    (there / "mine").write_text("mine\n")
                else:
                    there.write_text("mine\n")
                self.refused(*self.STUDY, say=[there, "a folder" if is_file else "a file", "--force"])
                self.assertTrue(there.is_dir() == is_file, "nothing is taken away without --force")
                self.call(*self.STUDY, "--force")
                self.assertEqual((self.out / "runs.csv").read_bytes(), table)
                self.assertTrue((self.out / run / "trajectory.csv").is_file())

    def test_a_file_in_the_place_of_the_folder_itself_is_never_taken_away(self):
        self.out.write_text("mine\n")
        for force in ([], ["--force"]):
            self.refused(*self.STUDY, *force, say=[self.out, "is not a folder", "name another"])
        self.assertEqual(self.out.read_text(), "mine\n")


class Folders(FaultsTest):
    STUDY = ["--integrator", "rk4", "--dt", "1e-2", "--no-figures"]

    def test_the_longest_path(self):
        """SQLite opens no file whose absolute path, with what it adds to it, is longer than 512 bytes."""
        def path(length):
            text = str(self.folder.resolve())
            while length - len(text) > 200:
                text += "/" + "d" * 100
            return pathlib.Path(text + "/" + "e" * (length - len(text) - 1))

        self.call(*self.STUDY, out=path(489))
        self.assertTrue((path(489) / "runs.csv").is_file())
        for length in (490, 520, 700):
            self.refused(*self.STUDY, out=path(length), say=[str(path(length))[:60], f"{length} bytes", "489", "shorter"])
            self.assertFalse(path(length).exists())
        link = self.folder / "link"
        link.symlink_to(path(489).parent)
        self.refused(*self.STUDY, out=link / ("f" * 200), say=["bytes", "shorter"])

    def test_a_folder_that_cannot_be_read_is_refused(self):
        """It could not be locked."""
        user = {}
        if os.geteuid() == 0:
            nobody = pwd.getpwnam("nobody")
            user = {"user": nobody.pw_uid, "group": nobody.pw_gid, "extra_groups": []}
            self.folder.chmod(0o755)
            try:
                subprocess.run([str(BIN / "energy_drift"), "--help"], check=True, capture_output=True, timeout=PATIENCE,
                               cwd=self.folder, **user)
            except (OSError, subprocess.CalledProcessError) as error:
                self.skipTest(f"nobody, for whom permissions count, cannot start the program: {error}")
        self.out.mkdir()
        if user:
            os.chown(self.out, user["user"], user["group"])
        self.out.chmod(0o333)
        self.addCleanup(self.out.chmod, 0o755)
        self.refused(*self.STUDY, say=[self.out, "cannot read", "chmod u+r"], **user)
        self.out.chmod(0o755)
        self.assertEqual(list(self.out.iterdir()), [])
        self.call(*self.STUDY, **user)


    def test_a_folder_that_cannot_be_written_is_refused(self):
        place = self.mounted("-t", "tmpfs", "none")
        self.call(*self.STUDY, out=place / "out")
        before = {path: path.is_dir() or path.read_bytes() for path in place.rglob("*")}
        subprocess.run(["mount", "-o", "remount,ro", str(place)], check=True, capture_output=True)
        for force in ([], ["--force"]):
            self.refused(*self.STUDY, *force, out=place / "out", say=[place / "out", "cannot write", "Read-only file system"])
        self.refused(*self.STUDY, out=place / "new", say=[place / "new", "Read-only file system"])
        self.assertEqual({path: path.is_dir() or path.read_bytes() for path in place.rglob("*")}, before)


class FullDisks(FaultsTest):
    HDF5 = ["--integrator", "rk4", "--dt", "1e-3", "--trajectory", "hdf5", "--no-figures"]
    CSV = [*HDF5[:5], "csv", "--no-figures"]

    def test_a_trajectory_on_a_full_disk_that_then_has_room(self):
        for study, name in ((self.HDF5, "trajectory.h5"), (self.CSV, "(trajectory|energy|events).csv")):
            whole = self.folder / f"whole_{study[5]}"
            self.call(*study, out=whole)
            files = {p.relative_to(whole): p.read_bytes() for p in whole.glob("trajectories/*/*")}
            for size in (140, 200, 260, 400, 1000):
                with self.subTest(f"{size} kB, {study[5]}"):
                    place = self.mounted("-t", "tmpfs", "-o", f"size={size}k", "none")
                    done = self.call(*study, status=3, out=place / "out")
                    self.assertRegex(done.said, rf"cannot write \S+{name}: No space left on device; finished runs are kept")
                    self.assertFalse(list(place.rglob("trajectory.h5")) + list(place.rglob("trajectory.csv")),
                                     "what is not whole has not its name")
                    subprocess.run(["mount", "-o", "remount,size=20m", str(place)], check=True, capture_output=True)
                    self.call(*study, out=place / "out")
                    self.assertEqual({p.relative_to(place / "out"): p.read_bytes() for p in place.glob("out/trajectories/*/*")}, files)

    def runs_in_copy(self, out):
        """The number of runs in a copy of a store, where there is room to read it."""
        copied = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        for name in ("results.sqlite", "results.sqlite-wal"):
            if (out / name).exists():
                shutil.copy(out / name, copied)
        with contextlib.closing(sqlite3.connect(copied / "results.sqlite")) as store:
            has_runs = store.execute("SELECT count(*) FROM sqlite_master WHERE name = 'runs'").fetchone()[0]
            return store.execute("SELECT count(*) FROM runs").fetchone()[0] if has_runs else 0

    def test_each_file_of_a_study_on_a_disk_that_gets_room_little_by_little(self):
        study = ["--integrator", "rk4,dmv", "--dt", "1e-2,5e-3", "--t-end", "1", "--out", "out"]

        def carry_out(folder):
            return subprocess.run([str(BIN / "energy_drift"), *study], cwd=folder, capture_output=True, text=True,
                                  timeout=PATIENCE, stdin=subprocess.DEVNULL)

        (self.folder / "whole").mkdir()
        self.assertEqual(carry_out(self.folder / "whole").returncode, 0)
        whole = files(self.folder / "whole/out")
        store = self.folder / "whole/out/results.sqlite"
        stages = set()
        for room, kept in ((12, 0), (store.stat().st_size // 1024 + 12, 4)):  # kB, runs in the store at the start
            place = self.mounted("-t", "tmpfs", "-o", f"size={room}k", "none")
            if kept:
                (place / "out").mkdir()
                shutil.copy(store, place / "out")
            while (done := carry_out(place)).returncode != 0:
                said = [line for line in done.stderr.splitlines() if "runs are there already" not in line]
                with self.subTest(room=room, said=said):
                    self.assertEqual(done.returncode, 3)
                    self.assertEqual(len(said), 1)
                    self.assertRegex(said[0], "^energy_drift: .*(No space left on device|disk is full|is the disk full).*; "
                                              "finished runs are kept, and the same command goes on")
                    self.assertNotIn("--force", said[0])
                now = self.runs_in_copy(place / "out")
                self.assertGreaterEqual(now, kept, "a run that was stored is lost")
                kept = now
                name = re.search(r"out/([a-z_./]+[a-z])", said[0])[1]
                stages.add(name.split("/")[0])
                room += 4 if name == store.name else 4 * max(1, len(whole.get(name, b"")) // 4096)
                self.assertLess(room, 20_000)
                subprocess.run(["mount", "-o", f"remount,size={room}k", str(place)], check=True, capture_output=True)
            found = files(place / "out")
            self.assertEqual(sorted(found), sorted(whole))
            self.assertEqual([name for name in whole if found[name] != whole[name]], [])
        self.assertLessEqual({store.name, "runs.csv", "tables", "figures", "report.html"}, stages)

    def test_a_trajectory_in_hdf5_that_may_not_grow(self):
        """The same without a file system of its own: the limit of files."""
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))

        done = self.call(*self.HDF5, status=3, preexec_fn=limit)
        self.assertRegex(done.said, r"cannot write \S+trajectory\.h5: File too large; finished runs are kept")

    def test_a_store_on_a_disk_whose_blocks_are_smaller_than_pages(self):
        """A page of the store's shared memory can be part a hole then, which a full disk cannot fill."""
        if not shutil.which("mkfs.ext4"):
            self.skipTest("mkfs.ext4 is not installed")
        for free in (20, 30, 40):
            with self.subTest(f"{free} kB free"):
                image = self.folder / f"image{free}"
                image.write_bytes(bytes(4_000_000))
                subprocess.run(["mkfs.ext4", "-q", "-b", "1024", str(image)], check=True, capture_output=True)
                place = self.mounted("-o", "loop", image)
                filling = open(place / "filling", "wb", buffering=0)
                with filling, contextlib.suppress(OSError):
                    while filling.write(bytes(1024)):
                        pass
                os.sync()
                os.truncate(place / "filling", (place / "filling").stat().st_size - 1024 * free)
                os.sync()
                done = self.call("--integrator", "rk4", "--dt", "1e-2", "--no-figures", status=3, out=place / "out")
                self.assertRegex(done.said, r"results\.sqlite: .*(full|No space left on device)")
                os.remove(place / "filling")
                self.call("--integrator", "rk4", "--dt", "1e-2", "--no-figures", out=place / "out")


if __name__ == "__main__":
    unittest.main(verbosity=1)
