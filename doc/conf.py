# SPDX-License-Identifier: GPL-3.0-or-later
"""Sphinx configuration of the manual: cmake --build build/release --target manual.

The pages are plain Markdown, which a code host shows as well. The table of contents follows from doc/index.md: each of its sections is a part
of the manual, each link in the section's list a page of that part.
"""

import re
from pathlib import Path

project = "Fretwork"
author = "The Fretwork authors"
version = release = re.search(r"project\(\w+ VERSION ([\d.]+)", (Path(__file__).parent.parent / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
exclude_patterns = ["pictures/README.md"]
html_theme = "furo"
html_title = f"Fretwork {release}"
numfig = True


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


def setup(app):
    app.connect("source-read", read)
