# SPDX-License-Identifier: BSD-3-Clause
"""The READMEs of the checkout as pages of the book: links between them become links between pages."""
import os
import pathlib
import re
import shutil

from .markdown import outside_code

IMAGES = (".svg", ".png")
# README: page. Those of experiments, papers and the rooms of sources are found by their folders.
PAGES = {
    "README.md": "index",
    "experiments/README.md": "experiments/index",
    "experiments/scenarios/README.md": "reference/scenarios",
    "experiments/study/README.md": "inside/way_of_a_run",
    "experiments/study/plan/README.md": "reference/studies",
    "experiments/study/metrics/README.md": "reference/measured",
    "experiments/study/trajectory/README.md": "reference/trajectories",
    "experiments/study/store/README.md": "reference/store",
    "core/README.md": "inside/core",
    "integrators/README.md": "inside/integrators",
    "collision/README.md": "inside/collision",
    "tests/README.md": "inside/tests",
    "tests/fuzz/README.md": "inside/fuzzers",
    "experiments/replay/page/README.md": "inside/replay_page",
}
# Headings of READMEs that are pages of their own in the book.
MOVED = {("README.md", "adding-to-it"): "own/index"}


class Readmes:
    def __init__(self, root):
        self.root = root
        self.pages = dict(PAGES)
        self.written = {page.relative_to(root).as_posix(): page.relative_to(root / "guide").with_suffix("").as_posix()
                        for page in (root / "guide").rglob("*.md") if page.name != "README.md"}
        for folder, room in (("experiments", "experiments"), ("papers", "papers"), ("core", "inside/core"),
                             ("integrators", "inside/integrators"), ("collision", "inside/collision")):
            for readme in sorted((root / folder).glob("*/README.md")):
                self.pages.setdefault(readme.relative_to(root).as_posix(), f"{room}/{readme.parent.name}")

    def text(self, readme, page, out, part=None):
        """The README, or the part of it, as the Markdown of a page; its pictures are copied into the folder `out`."""
        text = (self.root / readme).read_text(encoding="utf-8") if part is None else part
        return outside_links(text, lambda label, target, bang: self.link(readme, page, out, label, target, bang))

    def link(self, readme, page, out, label, target, bang):
        if target.startswith(("http://", "https://")):
            return f"{label} ({target.removeprefix('https://').removeprefix('http://')})"
        path, _, anchor = target.partition("#")
        there = pathlib.PurePosixPath(os.path.normpath(pathlib.PurePosixPath(readme).parent / path)).as_posix() if path else readme
        here = pathlib.PurePosixPath(page).parent.as_posix()
        if bang or there.endswith(IMAGES):
            copy = out / "pictures" / there
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(self.root / there, copy)
            return f"{bang}[{label}]({os.path.relpath('pictures/' + there, here)})"
        to = MOVED.get((there, anchor)) or self.pages.get(there) or self.written.get(there)
        if to is None or to == page and not anchor:
            room = there.endswith("/" + label.strip("`") + "README.md")  # the README of a room, named by its folder: `text/`
            return label if room or label.strip("`") == there or there in label else f"{label} (`{there}`)"
        to_file = os.path.relpath(to + ".md", here)
        kept = "" if (there, anchor) in MOVED or not anchor else "#" + anchor
        return f"[{label}]({to_file}{kept})"


def outside_links(text, link):
    """The text with each link outside of blocks of code replaced, and dollar signs kept as they are."""
    from .markdown import FENCE
    parts = FENCE.split(text)
    for i in range(0, len(parts), 2):
        part = re.sub(r"(!?)\[((?:[^\[\]]|`[^`]*`)*)\]\(([^)\s]+)\)", lambda m: link(m[2], m[3], m[1]), parts[i])
        parts[i] = outside_code(part, lambda plain: plain.replace("$", "\\$"))
    return "".join(parts)


def between(text, start, end):
    """The part of a text from the first `start` to the `end` after it. Raises ValueError if one is missing."""
    first = text.index(start)
    return text[first:text.index(end, first + len(start))] if end else text[first:]
