# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of doc/developers.md: draw_architecture.py FILE.svg. One row a stage of a run: the data it makes, and the folder and function that make it."""

import sys

# data, what it is; folder: function that makes the next row
ROWS = [
    ("study file", "TOML", "study", "read"),
    ("Study", "typed, checked values", "mesh", "read"),
    ("LineMesh", "nodes, lines, groups", "app", "build_model"),
    ("fem::Model", "beams, restraints, dofs", "fem", "assemble (PETSc)"),
    ("K, M", "sparse matrices, distributed", "modal", "solve_structures (SLEPc)"),
    ("modal::Basis", "modes: plain data, equal on every rank", "app", "build_scenes"),
    ("transient::Scene", "modes, contacts, loads", "transient", "choose_step, make_scheme, Run::advance"),
    ("Record", "one step: motion, contact states, energy", "post", "ContactStatistics, Recorder, ..."),
    ("JobResult", "statistics, impacts, series", "wear", "time_to_limit, depth_history"),
    ("RunResults", "all that is written", "results", "write_summary, write_archive"),
    ("result files", "summary.json, results.h5, report.html", None, None),
]
WIDTH, LEFT, BOX, HIGH, STEP, TOP = 860, 20, 390, 36, 62, 20


def text(x, y, words, **style):
    attributes = " ".join(f'{key.replace("_", "-")}="{value}"' for key, value in style.items())
    return f'<text x="{x}" y="{y}" {attributes}>{words}</text>'


def picture():
    height = TOP + STEP * (len(ROWS) - 1) + HIGH + 20
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}" font-family="sans-serif" font-size="14">',
           f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
           '<defs><marker id="tip" markerWidth="8" markerHeight="8" refX="7" refY="4" orient="auto"><path d="M0,0 L8,4 L0,8 z" fill="#444444"/></marker></defs>']
    middle = LEFT + BOX / 2
    for row, (data, what, folder, function) in enumerate(ROWS):
        y = TOP + STEP * row
        out.append(f'<rect x="{LEFT}" y="{y}" width="{BOX}" height="{HIGH}" rx="5" fill="#e8f0f8" stroke="#5a7fa8"/>')
        out.append(text(LEFT + 10, y + 23, data, font_weight="bold", fill="#000000"))
        out.append(text(LEFT + BOX - 10, y + 23, what, text_anchor="end", fill="#333333", font_size="12"))
        if folder:
            out.append(f'<line x1="{middle}" y1="{y + HIGH}" x2="{middle}" y2="{y + STEP - 1}" stroke="#444444" marker-end="url(#tip)"/>')
            out.append(text(middle + 12, y + HIGH + 18, f'<tspan font-weight="bold" fill="#a04000">{folder}</tspan>: {function}', fill="#333333"))
    right, first, last = LEFT + BOX + 110, TOP + STEP * 3 + HIGH, TOP + STEP * 5 + HIGH
    
    def brace(y0, y1, words):
        out.append(f'<path d="M{right + 90},{y0} h10 V{y1} h-10" fill="none" stroke="#888888"/>')
        for line, word in enumerate(words):
            out.append(text(right + 108, (y0 + y1) / 2 - 8 + 18 * line, word, fill="#555555"))
    brace(TOP, last - 2 * STEP - HIGH - 10, ["every rank, or the first,", "broadcast"])
    brace(first - HIGH, last, ["MPI: structures over ranks", ""])
    brace(TOP + STEP * 6, TOP + STEP * 8 + HIGH, ["one rank a scene:", "no PETSc, no MPI, no files"])
    brace(TOP + STEP * 9, TOP + STEP * 10 + HIGH, ["first rank"])
    out.append("</svg>")
    return "\n".join(out) + "\n"


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(picture())
