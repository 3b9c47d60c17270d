# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the programs share. POLHODE_BIN_DIR is the folder of the programs."""
import csv
import os
import pathlib
import sqlite3
import subprocess
import tempfile

BIN = pathlib.Path(os.environ.get("POLHODE_BIN_DIR", "."))
PATIENCE = 120  # s; a loaded machine is slow, a hanging program is not waited for longer


def temporary_folder(add_cleanup):
    """A new folder, which is removed by what add_cleanup (addCleanup or addClassCleanup) registers."""
    holder = tempfile.TemporaryDirectory(prefix="polhode_test_")
    add_cleanup(holder.cleanup)
    return pathlib.Path(holder.name)


def call(program, *arguments, folder, status=0, patience=PATIENCE):
    """Runs a program in a folder; raises AssertionError where its exit status is another one."""
    done = subprocess.run([str(BIN / program), *map(str, arguments)], cwd=folder, capture_output=True, text=True,
                          timeout=patience, stdin=subprocess.DEVNULL)
    if done.returncode != status:
        raise AssertionError(f"exit status {done.returncode}, not {status}: {done.stderr[-1500:]}")
    return done


def stored(folder):
    """How many runs the store holds; looked at from outside while a program writes."""
    path = folder / "results.sqlite"
    if not path.exists():
        return 0
    try:
        store = sqlite3.connect(f"file:{path}?mode=ro", uri=True, timeout=1)
        try:
            return store.execute("SELECT count(*) FROM runs").fetchone()[0]
        finally:
            store.close()
    except sqlite3.Error:
        return 0  # not made yet, or just now busy


def peak_memory(program, *arguments):
    """Runs a program, which must succeed. Returns its largest memory in kB, and not less than that of this Python."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    try:
        child = os.posix_spawn(str(BIN / program), [program, *map(str, arguments)], os.environ,
                               file_actions=[(os.POSIX_SPAWN_DUP2, nowhere, 1), (os.POSIX_SPAWN_DUP2, nowhere, 2)])
        _, status, usage = os.wait4(child, 0)
    finally:
        os.close(nowhere)
    if status != 0:
        raise AssertionError(f"{program}: wait status {status}")
    return usage.ru_maxrss


def read(path):
    """The rows of a CSV file, by the names of its columns."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))
