# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares runs: python3 -m fretwork.report.compare DIR DIR [DIR ...] [--html FILE]. Tables on the terminal; with --html also as a page with the pictures of the
runs side by side."""

import argparse
import html
import sys
from pathlib import Path

from . import compare_data, contact_view, page, structure_view
from .build import write_whole
from .compare_data import short_names, tables
from .run_data import NoResults

MOST_ORBITS = 4  # contacts whose orbits are shown, those that wear most in the first run


WIDTH = 100  # characters of a line on the terminal


def _lines(table, columns):
    rows = [[row[i] for i in columns] for row in [table.heads, *table.rows]]
    widths = [max(map(len, column)) for column in zip(*rows)]
    return [("  " + "  ".join(cell.ljust(width) if i == 0 else cell.rjust(width) for i, (cell, width) in enumerate(zip(row, widths)))).rstrip() for row in rows]


def _fits(table, columns):
    return max(map(len, _lines(table, columns))) <= WIDTH


def _columns(table, runs):
    """The first one, and those of some runs."""
    return [0, *(i for i, run in enumerate(table.runs, 1) if run in runs)]


def _blocks(table):
    """Columns of the parts of a wide table: each has the reference and as many other runs as a line holds, one at least."""
    blocks: list[list[int]] = []
    held: list[int] = []
    for run in range(1, max(table.runs) + 1):
        if held and not _fits(table, _columns(table, [0, *held, run])):
            blocks.append(_columns(table, [0, *held]))
            held = []
        held.append(run)
    return [*blocks, _columns(table, [0, *held])]


def as_text(table):
    if not table.rows:
        return f"{table.title}: none\n"
    parts = ["\n".join(_lines(table, columns)) for columns in _blocks(table)]
    return "\n".join([table.title, *([f"  {table.note}"] if table.note else []), "\n\n".join(parts)]) + "\n"


def as_texts(runs, names, found):
    """Of all tables. Where one is wider than a line, runs are numbered and tables come in parts."""
    if all(_fits(table, range(len(table.heads))) for table in found if table.rows):
        return "\n".join(map(as_text, found))
    legend = "\n".join(f"  run {k}  {name}{', the reference' if k == 1 else ''}" for k, name in enumerate(names, 1))
    numbered = compare_data.differences(runs, [f"run {k}" for k in range(1, len(names) + 1)])
    return "\n".join([f"Runs\n{legend}\n", *map(as_text, numbered)])


def _side_by_side(runs, names, picture):
    cells = "".join(f'<div class="panel"><h3>{html.escape(name)}</h3>{page.figure(picture(run))}</div>' for run, name in zip(runs, names))
    return f'<div class="grid2">{cells}</div>'


def _orbit(run, name):
    found = next((c for c in run.contacts if c.name == name and c.normal is not None), None)
    return contact_view.orbit(run, found) if found else '<p class="none">no such contact, or no series</p>'


def as_page(runs, names, found):
    def as_table(t):
        cells = [[html.escape(cell).replace("+-", "±") for cell in row] for row in t.rows]
        return (f'<p class="soft">{html.escape(t.note)}</p>' if t.note else "") + page.table([html.escape(h) for h in t.heads], cells)

    body = "".join(page.section(t.title, as_table(t) if t.rows else "<p>none</p>") for t in found)
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
        print(as_texts(runs, names, found))
        if arguments.html:
            print(f"written: {arguments.html}")
    except NoResults as error:
        return str(error)
    except OSError as error:
        return f"{arguments.html} cannot be written ({error.strerror}); name a file in a folder that exists and may be written to"
    return 0


if __name__ == "__main__":
    sys.exit(main())
