# SPDX-License-Identifier: GPL-3.0-or-later
"""Sphinx configuration of the manual: cmake --build build/release --target manual.

The pages are plain Markdown, which a code host shows as well. The table of contents follows from doc/index.md: each of its sections is a part
of the manual, each link in the section's list a page of that part.
"""

import re
import shutil
from pathlib import Path

project = "Fretwork"
author = "The Fretwork authors"
version = release = re.search(r"project\(\w+ VERSION ([\d.]+)", (Path(__file__).parent.parent / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
exclude_patterns = ["pictures/README.md"]
html_theme = "furo"
html_title = f"Fretwork {release}"
numfig = True
# The manual shows its formulas without a network: MathJax of Debian (libjs-mathjax), as SVG, is copied into it.
MATHJAX = Path("/usr/share/javascript/mathjax")
MATHJAX_PARTS = ["MathJax.js", "config/TeX-AMS_SVG-full.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/SVG/jax.js",
                 "jax/output/SVG/config.js", "jax/output/SVG/autoload", "jax/output/SVG/fonts/TeX"]
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG-full"
mathjax2_config = {"tex2jax": {"processClass": "math"}, "messageStyle": "none"}  # only what Sphinx marks as a formula


def contents(text):
    """doc/index.md with a hidden toctree at the end of each section, of the pages that the section links to."""
    parts = []
    for section in re.split(r"(?m)^(?=## )", text):
        pages = re.findall(r"(?m)^- \[[^]]*\]\(([\w-]+)\.md\)", section)
        if pages:
            caption = re.match(r"## (.*)", section)[1]
            section = "\n".join([section.rstrip(), "", "```{toctree}", ":hidden:", f":caption: {caption}", "", *pages, "```", "", ""])
        parts.append(section)
    return "".join(parts)


def read(app, document, source):
    source[0] = re.sub(r"\[[^]]*\]\((?:\.\./)+([^)]*)\)", r"`\1`", source[0])  # files outside of doc/ are no pages
    if document == "index":
        source[0] = contents(source[0])


def copy_mathjax(app, error):
    if error is None and app.builder.format == "html":
        for part in MATHJAX_PARTS:
            source, target = MATHJAX / part, Path(app.outdir) / "_static/mathjax" / part
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copytree(source, target, dirs_exist_ok=True) if source.is_dir() else shutil.copy(source, target)


def setup(app):
    app.connect("source-read", read)
    app.connect("build-finished", copy_mathjax)
