# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories of runs that are killed: what `archive` says and saves of them, that the same command makes the bytes of an
uninterrupted run, and that other programs (h5py, h5dump, h5clear) read the HDF5 files.

POLHODE_BIN_DIR is the folder of archive, convergence, energy_drift, judge, replay and simulate.
"""
import pathlib
import random
import re
import shutil
import signal
import subprocess
import time
import unittest

from programs import BIN, PATIENCE, call, read, temporary_folder

try:
    import h5py
except ImportError:
    h5py = None
NEEDS_H5PY = unittest.skipIf(h5py is None, "skipped, because h5py is not installed (package python3-h5py)")
KILLS = 20
FILES = {"csv": ("energy.csv", "events.csv", "trajectory.csv"), "hdf5": ("trajectory.h5",)}
TABLES = ("trajectory", "energy", "impacts", "slide_ends")
LONG = ["--scenario", "peters_hsu", "--integrator", "rk4", "--dt", "2e-4", "--no-figures"]
INSTANTS = 50001
CUBES = ["--scenario", "two_cubes", "--integrator", "rk4", "--dt", "1e-3", "--no-figures"]


def unfinished(path):
    return path.with_name(path.name + ".unfinished")


def there(path):
    """The file under its own name, or the unfinished one."""
    return path if path.exists() else unfinished(path)


def size(path, left=None):
    """Size of a file in bytes; 0 if it is not there, or is still what an earlier run has left."""
    try:
        is_now = there(path).stat()
    except FileNotFoundError:
        return 0
    return 0 if left and left.st_mtime_ns == is_now.st_mtime_ns else is_now.st_size


def whole_lines(path):
    """Number of whole lines. They are read one by one: all at once need fresh memory, and may take as long as their run."""
    with open(path, "rb") as file:
        return sum(line.endswith(b"\n") for line in file)


def instants_in_csv(folder):
    """Whole lines of numbers that both tables have; one body moves."""
    lines = [whole_lines(there(folder / name)) - 1 for name in ("trajectory.csv", "energy.csv") if there(folder / name).exists()]
    return max(0, min(lines)) if len(lines) == 2 else 0


def instants_in_hdf5(folder):
    """Rows that both tables have, of a file whose writer may still be at work; -1 if it cannot be opened."""
    path = there(folder / "trajectory.h5")
    try:
        with h5py.File(path, swmr=path.suffix == ".unfinished") as file:
            counts = []
            for name in ("trajectory", "energy"):
                t = file[name][:, 0]
                counts.append(int((t == t).argmin()) if (t != t).any() else len(t))
            return min(counts)
    except OSError:
        return -1


class Archive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.whole = {}
        for name in FILES:
            cls.whole[name] = cls.folder / f"whole_{name}"
            call("simulate", *LONG, "--trajectory", name, "--out", cls.whole[name], folder=cls.folder)

    def archive(self, action, folder, status=0):
        return call("archive", action, folder, folder=self.folder, status=status).stdout

    def names(self, folder):
        return sorted(str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file() and not p.name.startswith("results.sqlite"))

    def kill(self, command, path, fraction, seen=lambda: 0):
        """Starts a program and kills it when the file has this fraction of its size in the end; what `seen` returned just
        before, or None if the program had ended by itself."""
        last = (self.whole["csv" if path.suffix == ".csv" else "hdf5"] / path.name).stat().st_size
        left = there(path).stat() if there(path).exists() else None
        program = subprocess.Popen([str(BIN / command[0]), *map(str, command[1:])], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + PATIENCE
        while size(path, left) < fraction * last and program.poll() is None:
            self.assertLess(time.monotonic(), end, "the file does not grow")
            time.sleep(0.001)
        before = seen()
        program.send_signal(signal.SIGKILL)
        program.wait(timeout=PATIENCE)
        return None if program.returncode == 0 else before

    def said(self, text, path):
        """The condition and the number of instants that `check` prints of a trajectory; None if it prints none."""
        for line in text.splitlines():
            found = re.match(rf"{re.escape(str(path))}(\.unfinished)?: (whole|unfinished|damaged), (no|\d+) instants?", line)
            if found:
                return found[2], 0 if found[3] == "no" else int(found[3])
        return None

    def killed_runs(self, name, count, saved):
        """Kills a run again and again. `count(folder)`: instants that are there; `saved(folder)`: instants saved by repair,
        compared with those of the uninterrupted run."""
        chance = random.Random(f"kills {name}")
        out, last = self.folder / f"killed_{name}", FILES[name][-1]
        command = ["simulate", *LONG, "--trajectory", name, "--out", out]
        cut = 0
        for trial in range(KILLS):
            with self.subTest(trial):
                fraction = chance.random()
                before = self.kill(command, out / last, fraction, lambda: count(out))
                if before is not None and there(out / last).exists():
                    is_whole = (out / last).exists()
                    counted = max(0, count(out))
                    self.assertGreaterEqual(counted, before, "what could be read before the kill")
                    self.assertGreater(counted, fraction * INSTANTS - 3000, "a block is 1000 rows, and so is a chunk of the file")
                    self.assertEqual(self.said(self.archive("check", out, 0 if is_whole else 1), out / last),
                                     ("whole" if is_whole else "unfinished", counted))
                    self.archive("repair", out, 0 if is_whole or counted else 1)
                    self.assertEqual(saved(out) if counted and not is_whole else 0, 0 if is_whole else counted)
                    cut += not is_whole and counted > 0
                for file in out.glob("*.recovered.*"):
                    file.unlink()
                if trial % 4 == 3 or (out / last).exists():  # else the next run starts on what this one has left
                    call(*command, folder=self.folder)
                    self.assertEqual(self.names(out), self.names(self.whole[name]))
                    for file in FILES[name]:
                        self.assertTrue((out / file).read_bytes() == (self.whole[name] / file).read_bytes(), file)
                    self.assertIn("1 whole, 0 unfinished, 0 damaged", self.archive("check", out))
                    shutil.rmtree(out)
        self.assertGreater(cut, KILLS / 2, "too few runs were cut off half-way")

    def test_runs_that_are_killed_in_csv(self):
        def saved(folder):
            text = (folder / "trajectory.recovered.csv").read_bytes()
            comment, rest = text.split(b"\n", 1)
            self.assertRegex(comment, rb"^# ends early: recovered from trajectory.csv.unfinished; what follows t_s = \S+ is lost$")
            self.assertTrue((self.whole["csv"] / "trajectory.csv").read_bytes().startswith(rest))
            return rest.count(b"\n") - 1

        self.killed_runs("csv", instants_in_csv, saved)

    @NEEDS_H5PY
    def test_runs_that_are_killed_in_hdf5(self):
        def saved(folder):
            with h5py.File(folder / "trajectory.recovered.h5") as file, h5py.File(self.whole["hdf5"] / "trajectory.h5") as whole:
                self.assertIn(b"lost", file.attrs["ends_early"])
                rows = [len(file[name]) for name in TABLES]
                for name in TABLES:
                    self.assertTrue((file[name][:] == whole[name][:len(file[name])]).all(), name)
                self.assertEqual(file.attrs["recovered_until_s"], file["energy"][-1, 0])
                self.assertEqual(rows[0], rows[1])
                return rows[0]

        self.killed_runs("hdf5", instants_in_hdf5, saved)

    def test_a_study_that_is_killed_ends_with_the_same_files(self):
        study = ["energy_drift", "--scenario", "peters_hsu", "--integrator", "rk4,heun,explicit_midpoint", "--dt", "1e-3,5e-4",
                 "--no-figures", "--jobs", "2"]
        chance = random.Random("studies")
        for name in FILES:
            whole, out = self.folder / f"study_{name}", self.folder / f"killed_study_{name}"
            command = [*study, "--trajectory", name, "--out"]
            call(*command, whole, folder=self.folder)
            wanted = [p for p in self.names(whole) if p.startswith("trajectories/")]
            self.assertEqual(len(wanted), 6 * len(FILES[name]))
            for _ in range(3):
                program = subprocess.Popen([str(BIN / command[0]), *command[1:], str(out)], cwd=self.folder,
                                           stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                most, end = chance.randrange(1, 6), time.monotonic() + PATIENCE
                while len(list(out.glob("trajectories/*"))) < most and program.poll() is None:
                    self.assertLess(time.monotonic(), end, "no run begins")
                    time.sleep(0.001)
                program.send_signal(signal.SIGKILL)
                program.wait(timeout=PATIENCE)
            call(*command, out, folder=self.folder)
            self.assertEqual([p for p in self.names(out) if p.startswith("trajectories/")], wanted)
            for path in [*wanted, "runs.csv"]:
                self.assertTrue((out / path).read_bytes() == (whole / path).read_bytes(), path)
            self.assertIn("6 trajectories: 6 whole", self.archive("check", out))

    def test_a_run_without_one_of_its_files_is_made_again(self):
        out = self.folder / "incomplete"
        command = ["simulate", *CUBES, "--out", out]
        call(*command, folder=self.folder)
        whole = {name: (out / name).read_bytes() for name in FILES["csv"]}
        for name in FILES["csv"]:
            (out / name).unlink()
            self.assertIn(f"{out / name}: no such file", self.archive("check", out, status=1))
            call(*command, folder=self.folder)
            self.assertEqual({n: (out / n).read_bytes() for n in whole}, whole)

    def test_a_study_makes_a_trajectory_that_is_cut_again(self):
        for name, files in FILES.items():
            out = self.folder / f"cut_study_{name}"
            command = ["convergence", *CUBES, "--jobs", "1", "--trajectory", name, "--out", out]
            call(*command, folder=self.folder)
            for file in files:
                path = next(out.glob(f"trajectories/*/{file}"))
                whole = path.read_bytes()
                for left in (b"", whole[:-7], b"text"):
                    with self.subTest(file=file, left=len(left)):
                        path.write_bytes(left)
                        said = self.archive("check", out, status=1)
                        self.assertIn("once the files named as damaged are removed, the command of the study makes them whole", said)
                        call(*command, folder=self.folder)
                        self.assertTrue(path.read_bytes() == whole)
                        self.assertIn("1 trajectory: 1 whole", self.archive("check", out))

    def test_damage_inside_a_trajectory_goes_with_its_file(self):
        """Only `check` sees it, and what it says helps."""
        out = self.folder / "damaged_inside"
        command = ["convergence", *CUBES, "--jobs", "1", "--trajectory", "csv", "--out", out]
        call(*command, folder=self.folder)
        path = next(out.glob("trajectories/*/energy.csv"))
        whole = path.read_bytes()
        path.write_bytes(whole.replace(b"\n0.5,", b"\n0.5,x", 1))
        named = re.search(r"^(\S+): damaged,", self.archive("check", out, status=1))[1]
        self.assertEqual(pathlib.Path(named), path.with_name("trajectory.csv"))
        pathlib.Path(named).unlink()
        call(*command, folder=self.folder)
        self.assertTrue(path.read_bytes() == whole)

    def test_a_run_with_an_impact_at_its_very_end_is_whole(self):
        """The time of the impact is rounded otherwise than that of the last instant, and comes after it."""
        for name in FILES:
            out = self.folder / f"bouncing_{name}"
            call("simulate", "--scenario", "cube_bouncing", "--integrator", "rk4", "--dt", "1e-2", "--t-end", "20", "--no-figures",
                 "--trajectory", name, "--out", out, folder=self.folder)
            if name == "csv":
                self.assertGreater(float(read(out / "events.csv")[-1]["t_s"]), 20)
            self.assertIn("whole, 2001 instants until t = 20 s", self.archive("check", out))

    def test_readers_say_how_far_an_unfinished_file_goes(self):
        out = self.folder / "cut"
        self.assertIsNotNone(self.kill(["simulate", *LONG, "--trajectory", "hdf5", "--out", out], out / "trajectory.h5", 0.5))
        path = out / "trajectory.h5.unfinished"
        _, instants = self.said(self.archive("check", out, status=1), out / "trajectory.h5")
        words = rf"{re.escape(str(path))}: is .*unfinished, {instants} instants until t = \S+ s; the command of the study makes it whole; " \
                rf"./run archive repair {re.escape(str(out))} saves"
        self.assertRegex(call("judge", "--scenario", "peters_hsu", path, folder=self.folder, status=2).stderr, words)
        shutil.copy(self.whole["csv"] / "runs.csv", out)  # as if an older study stood there
        self.assertRegex(call("replay", "--results", out, folder=self.folder, status=2).stderr, words)
        whole = call("judge", "--scenario", "peters_hsu", self.whole["hdf5"] / "trajectory.h5", folder=self.folder, status=2).stderr
        self.assertIn("trajectory.h5: is a trajectory in HDF5, which is not read here; make it again with --trajectory csv", whole)

    def test_what_it_is_asked_for(self):
        self.assertEqual(self.archive("check", self.folder / "whole_csv"),
                         f"{self.folder / 'whole_csv/trajectory.csv'}: whole, {INSTANTS} instants until t = 10 s\n"
                         "1 trajectory: 1 whole, 0 unfinished, 0 damaged\n")
        empty = self.folder / "empty"
        empty.mkdir()
        self.assertEqual(self.archive("check", empty), "0 trajectories: 0 whole, 0 unfinished, 0 damaged\n")
        for arguments, say in ((["check"], "no folder is named"), ([], "no action is named"), (["mend", empty], "no action 'mend'"),
                               (["check", self.folder / "none"], "no such folder"),
                               (["check", self.whole["csv"] / "runs.csv"], "is not a folder"), (["check", empty, "more"], "more")):
            with self.subTest(say):
                done = call("archive", *arguments, folder=self.folder, status=2)
                self.assertIn(say, done.stderr)
                self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1))


class OtherPrograms(unittest.TestCase):
    """trajectory.h5 holds the numbers of the CSV files, for whoever reads HDF5."""

    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        for name in FILES:
            call("simulate", *CUBES, "--orientation", "matrix", "--trajectory", name, "--out", name, folder=cls.folder)
        cls.path = cls.folder / "hdf5" / "trajectory.h5"

    def expected(self, table):
        """The names of the columns and the rows, from the CSV files."""
        if table in ("trajectory", "energy"):
            rows = read(self.folder / "csv" / f"{table}.csv")
        else:
            rows = [r for r in read(self.folder / "csv/events.csv") if r.pop("kind") == table.removesuffix("s")]
        return list(rows[0]) if rows else None, [[float(x) for x in r.values()] for r in rows]

    @NEEDS_H5PY
    def test_h5py(self):
        with h5py.File(self.path) as file:
            self.assertEqual(sorted(file), sorted(TABLES))
            self.assertEqual({name: file.attrs[name] for name in file.attrs}, {"format": b"polhode trajectory 2"})
            for table in TABLES:
                names, rows = self.expected(table)
                columns = [name.decode() for name in file[table].attrs["columns"]]
                self.assertEqual(columns, names or columns)
                self.assertEqual(file[table].dtype, "<f8")
                self.assertEqual(file[table].shape, (len(rows), len(columns)))
                self.assertEqual(file[table].chunks, (1000, len(columns)))
                self.assertEqual(file[table][:].tolist(), rows)
            self.assertGreater(len(file["impacts"]), 0)

    @unittest.skipUnless(shutil.which("h5dump"), "skipped, because h5dump is not installed (package hdf5-tools)")
    def test_h5dump(self):
        def dump(*arguments):
            return subprocess.run(["h5dump", *map(str, arguments)], capture_output=True, text=True, check=True, timeout=PATIENCE).stdout

        header = dump("-H", "-p", self.path)
        for table in TABLES:
            names, rows = self.expected(table)
            self.assertIn(f'DATASET "{table}"', header)
            if names:
                self.assertIn(f"SIMPLE {{ ( {len(rows)}, {len(names)} ) / ( H5S_UNLIMITED, {len(names)} ) }}", header)
                data = re.search(r"DATA \{(.*?)\}", dump("-y", "-m", "%.17g", "-d", table, self.path), re.S)[1]
                self.assertEqual([float(x) for x in data.split(",")], [x for row in rows for x in row])
        self.assertIn('"polhode trajectory 2"', dump("-a", "/format", self.path))

    @unittest.skipUnless(shutil.which("h5clear") and shutil.which("h5dump"), "skipped, because h5clear is not installed (package hdf5-tools)")
    def test_h5clear_opens_the_file_of_a_run_that_was_killed(self):
        program = subprocess.Popen([str(BIN / "simulate"), *LONG, "--trajectory", "hdf5", "--out", "killed"], cwd=self.folder,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        path, end = unfinished(self.folder / "killed/trajectory.h5"), time.monotonic() + PATIENCE
        while size(self.folder / "killed/trajectory.h5") < 1_000_000:
            self.assertLess(time.monotonic(), end, "the file does not grow")
            time.sleep(0.001)
        program.kill()
        program.wait(timeout=PATIENCE)
        self.assertNotEqual(subprocess.run(["h5dump", "-H", str(path)], capture_output=True, timeout=PATIENCE).returncode, 0)
        subprocess.run(["h5clear", "-s", "--increment=0", str(path)], capture_output=True, check=True, timeout=PATIENCE)
        header = subprocess.run(["h5dump", "-H", str(path)], capture_output=True, text=True, check=True, timeout=PATIENCE).stdout
        self.assertGreaterEqual(int(re.search(r'"trajectory" .*?SIMPLE \{ \( (\d+),', header, re.S)[1]), 1000)


if __name__ == "__main__":
    unittest.main()
