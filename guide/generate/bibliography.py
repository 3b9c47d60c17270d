# SPDX-License-Identifier: BSD-3-Clause
"""papers/references.bib as lines of Markdown."""
import pybtex.plugin
from pybtex.database import parse_file


class Bibliography:
    def __init__(self, path):
        self.data = parse_file(str(path))
        self.style = pybtex.plugin.find_plugin("pybtex.style.formatting", "unsrt")()
        self.backend = pybtex.plugin.find_plugin("pybtex.backends", "markdown")()

    def keys(self):
        return sorted(self.data.entries.keys(), key=str.lower)

    def line(self, key):
        """One source as text. Raises KeyError if the file has no such key."""
        entry = next(iter(self.style.format_entries([self.data.entries[key]])))
        return " ".join(entry.text.render(self.backend).split())

    def items(self, keys):
        return "".join(f"- {self.line(key)}\n" for key in keys)
