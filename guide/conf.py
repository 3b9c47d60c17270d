# SPDX-License-Identifier: BSD-3-Clause
# Configuration of Sphinx for the guide. `./run guide` copies the pages, generates others and calls sphinx-build.
project = "polhode"
html_title = "polhode: the guide"
author = ""
copyright = ""
extensions = ["myst_parser", "sphinx.ext.mathjax"]
exclude_patterns = ["README.md"]
highlight_language = "none"
smartquotes = False  # "--list" is two dashes

myst_enable_extensions = ["amsmath", "dollarmath", "deflist"]
myst_heading_anchors = 4
myst_update_mathjax = False

html_theme = "furo"
templates_path = ["theme"]
html_static_path = ["static"]
html_css_files = ["style.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_show_copyright = False
html_show_search_summary = False  # a browser does not fetch pages from files
html_theme_options = {"top_of_page_button": None}

# Debian's MathJax, copied into the book: no formula needs a network.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG-full"
mathjax2_config = {
    "showMathMenu": False,
    "messageStyle": "none",
    "SVG": {"font": "TeX", "linebreaks": {"automatic": False}},
    "tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]], "processClass": "math", "ignoreClass": "no-mathjax"},
}
