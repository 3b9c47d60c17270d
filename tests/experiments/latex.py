# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of LaTeX files share: documents around them, and all that pdflatex complains of."""
import os
import re
import shutil
import subprocess

PDFLATEX = shutil.which("pdflatex")
WITHOUT_PDFLATEX = "pdflatex is not installed (Debian: texlive-latex-recommended texlive-pictures lmodern)"

# The article of 11 pt on A4 that tables and figures are made for.
PREAMBLE = r"""\documentclass[11pt,a4paper]{article}
\usepackage[utf8]{inputenc}\usepackage[T1]{fontenc}\usepackage{textcomp,lmodern,array,booktabs,longtable,pgfplots}
\usepgfplotslibrary{groupplots}\pgfplotsset{compat=1.17}
"""
COMPLAINT = re.compile(r"^!|warning|overfull|underfull|missing character|undefined", re.IGNORECASE)


def complaints(log):
    """The lines of a log in which LaTeX finds fault, each with the \\typeout{FILE ...} before it."""
    found, file = [], ""
    for line in log.splitlines():
        at = re.search(r"FILE (\S+)", line)
        file = at.group(1) if at else file
        if COMPLAINT.search(line) and "Warnings on" not in line:
            found.append(f"{file}: {line.strip()[:200]}")
    return found


def compiled(text, folder, name="document"):
    """Complaints of pdflatex about a document, run until its longtables have their widths."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.tex").write_text(text, encoding="utf-8")
    for _ in range(6):
        subprocess.run([PDFLATEX, "-interaction=nonstopmode", "-halt-on-error", f"{name}.tex"], cwd=folder,
                       capture_output=True, stdin=subprocess.DEVNULL, timeout=900,
                       env={**os.environ, "max_print_line": "1000"})
        log = (folder / f"{name}.log").read_text(encoding="utf-8", errors="replace")
        if "Rerun" not in log:
            break
    return complaints(log)


def document(files):
    """A document of tables and figures as an article takes them: in floats, longtables outside."""
    parts = []
    for file in files:
        text = file.read_text(encoding="utf-8")
        parts.append(r"\typeout{FILE %s}" % file)
        if r"\begin{longtable}" in text:
            parts.append(r"\input{%s}\clearpage" % file)
        else:
            kind = "figure" if r"\begin{tikzpicture}" in text else "table"
            parts.append(r"\begin{%s}\centering\input{%s}\caption{A caption.}\end{%s}\clearpage" % (kind, file, kind))
    return PREAMBLE + "\\begin{document}\n" + "\n".join(parts) + "\n\\end{document}\n"


def digits_in_prose(text):
    """Lines of a section of an article with a digit outside of commands for names, codes, files and formulas."""
    text = re.sub(r"(?<!\\)%.*", "", text)
    text = re.sub(r"\\\[.*?\\\]|\$[^$]*\$", "", text, flags=re.DOTALL)
    text = text.replace(r"\allowbreak{}", "").replace(r"\_", "_")
    text = re.sub(r"\\(name|code|texttt|cite|input|label|ref|begin|end|bibliography)(\[[^]]*\])?\{(?:[^{}]|\{[^{}]*\})*\}",
                  "", text)
    return [line for line in text.splitlines() if re.search(r"\d", line)]
