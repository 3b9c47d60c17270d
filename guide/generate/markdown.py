# SPDX-License-Identifier: BSD-3-Clause
"""Pieces of Markdown: escaped text, tables, blocks of code."""
import re

FENCE = re.compile(r"^(```.*?^```[ \t]*$)", re.DOTALL | re.MULTILINE)


def escaped(text):
    """Plain text, in which no character is markup, for a paragraph or the cell of a table."""
    return re.sub(r"([\\`*_{}\[\]<>#|$])", r"\\\1", str(text).replace("\n", " "))


def code(text):
    """Text in the font of code, also in the cell of a table."""
    return "`" + str(text).replace("|", "\\|") + "`" if str(text) else ""


def table(header, rows):
    """A table; the cells are Markdown."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    lines += ["| " + " | ".join(str(cell) if str(cell) else " " for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def block(text, language=""):
    return f"```{language}\n{text.rstrip()}\n```\n"


def outside_code(text, change):
    """The text with `change` applied to what is neither in a block nor in a span of code."""
    parts = FENCE.split(text)
    for i in range(0, len(parts), 2):
        spans = re.split(r"(`[^`\n]+`)", parts[i])
        spans[::2] = map(change, spans[::2])
        parts[i] = "".join(spans)
    return "".join(parts)
