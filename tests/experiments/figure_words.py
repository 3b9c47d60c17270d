# SPDX-License-Identifier: BSD-3-Clause
"""The words of drawn figures, and those that a translation left as they were."""
import html
import pathlib
import re

LANGUAGES = pathlib.Path(__file__).resolve().parents[2] / "experiments/study/plot/languages"


def texts(svg):
    """The texts of a picture, each without its markup."""
    found = re.findall(r"<text>(.*?)</text>", svg.read_text(encoding="utf-8"), re.DOTALL)
    return {html.unescape(re.sub(r"<[^>]*>|\s+", " ", text)).strip() for text in found}


def phrases(language):
    return dict(re.findall(r'^"(.*)" = "(.*)"$', (LANGUAGES / f"{language}.toml").read_text(encoding="utf-8"), re.MULTILINE))


def of_folder(folder):
    return {svg.relative_to(folder): texts(svg) for svg in sorted(folder.glob("*/*.svg"))}


def left_in_english(english, other, language):
    """Texts of several words that are the same in both languages and hold more than names and settings (dt = 0.1 s)."""
    said = phrases(language)
    left = []
    for svg, words in english.items():
        for text in words & other[svg]:
            parts = [p for p in re.split(r", |: ", re.sub(r" \([^)]*\)$", "", text)) if "=" not in p and "–" not in p]
            for part in parts:
                if re.search(r"[A-Za-z]{3}", part) and "_" not in part and said.get(part) != part and (
                        " " in part or part in said):
                    left.append(f"{svg}: {part}")
    return left
