# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares runs: python3 -m fretwork.report.compare DIR DIR [DIR ...] [--html FILE]. Tables on the terminal; with --html also as a page with the pictures of the
runs side by side."""

import argparse
import html
import sys
from pathlib import Path

from . import contact_view, page, structure_view
from .build import write_whole
from .compare_data import short_names, tables
from .run_data import NoResults

MOST_ORBITS = 4  # contacts whose orbits are shown, those that wear most in the first run


def as_text(table):
    if not table.rows:
        return f"{table.title}: none\n"
    widths = [max(len(row[i]) for row in [table.heads, *table.rows]) for i in range(len(table.heads))]
    lines = ["  " + "  ".join(cell.ljust(width) if i == 0 else cell.rjust(width) for i, (cell, width) in enumerate(zip(row, widths)))
             for row in [table.heads, *table.rows]]
    return "\n".join([table.title, *(line.rstrip() for line in lines)]) + "\n"


def _side_by_side(runs, names, picture):
    cells = "".join(f'<div class="panel"><h3>{html.escape(name)}</h3>{page.figure(picture(run))}</div>' for run, name in zip(runs, names))
    return f'<div class="grid2">{cells}</div>'


def _orbit(run, name):
    found = next((c for c in run.contacts if c.name == name and c.normal is not None), None)
    return contact_view.orbit(run, found) if found else '<p class="none">no such contact, or no series</p>'


def as_page(runs, names, found):
    body = "".join(
        page.section(t.title, page.table([html.escape(h) for h in t.heads], [[html.escape(cell).replace("+-", "±") for cell in row] for row in t.rows]) if t.rows else "<p>none</p>")
        for t in found
    )
    body += page.section("Structure", _side_by_side(runs, names, lambda run: structure_view.structure(run, 480)[0]))
    worn = sorted((c for c in runs[0].contacts if c.summary), key=lambda c: -(c.summary["work_rate"] or 0))[:MOST_ORBITS]
    for contact in worn:
        body += page.section(f"Orbit of {contact.name}", _side_by_side(runs, names, lambda run, name=contact.name: _orbit(run, name)))
    return page.page("Comparison of runs", html.escape(", ".join(names)), body)


def main():
    parser = argparse.ArgumentParser(description="Compares runs; the first is the reference.")
    parser.add_argument("directories", type=Path, nargs="+", help="folders with summary.json and results.h5")
    parser.add_argument("--html", type=Path, help="write the comparison as a page too")
    arguments = parser.parse_args()
    if len(arguments.directories) < 2:
        return f"only {arguments.directories[0]} is given; give the folders of two runs or more, the reference first"
    for i, directory in enumerate(arguments.directories):
        if directory.resolve() in [earlier.resolve() for earlier in arguments.directories[:i]]:
            return f"{directory} is given twice; give the folders of different runs"
    names = short_names(arguments.directories)
    try:
        runs, found = tables(arguments.directories)
        if arguments.html:
            write_whole(arguments.html, as_page(runs, names, found))
        print("\n".join(as_text(table) for table in found))
        if arguments.html:
            print(f"written: {arguments.html}")
    except NoResults as error:
        return str(error)
    except OSError as error:
        return f"{arguments.html} cannot be written ({error.strerror}); name a file in a folder that exists and may be written to"
    return 0


if __name__ == "__main__":
    sys.exit(main())
