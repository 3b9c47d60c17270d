# SPDX-License-Identifier: BSD-3-Clause
"""All papers: each number of each expected.csv comes out as given, and papers/README.md is what they give.

POLHODE_BIN_DIR is the folder of the experiments.
"""
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("POLHODE_BIN_DIR", "."))


class AllPapers(unittest.TestCase):
    def test_all_are_reproduced_and_the_index_is_true(self):
        with tempfile.TemporaryDirectory(prefix="polhode_papers_") as folder:
            index = pathlib.Path(folder) / "index.md"
            command = ["/usr/bin/python3", "-B", str(ROOT / "scripts/papers.py"), str(BIN), str(ROOT / "papers"), "--out",
                       folder + "/all", "--no-figures", "--index", str(index)]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(index.read_text(encoding="utf-8"), (ROOT / "papers/README.md").read_text(encoding="utf-8"),
                             "papers/README.md is not what ./run papers --index papers/README.md makes")


if __name__ == "__main__":
    unittest.main()
