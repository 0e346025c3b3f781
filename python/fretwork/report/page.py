# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame of the report: style, sections, figures, tables."""

import base64
import functools
import hashlib
import html
from pathlib import Path

HERE = Path(__file__).parent
MANY_COLUMNS = 8  # above, a page has no room for texts of several words
SCRIPTS = ("vendor/uplot/uPlot.iife.min.js", "vendor/three/three.min.js", "vendor/three/OrbitControls.js", "page.js")


@functools.cache
def _scripts(live):
    """The scripts of the page, as elements, and what a browser lets the page do: show itself and run these scripts, by their hashes. Nothing
    is loaded, nothing else runs. live: it has interactive pictures, which need the libraries."""
    names = SCRIPTS if live else SCRIPTS[-1:]
    texts = [(HERE / name).read_text(encoding="utf-8") for name in names]
    hashes = " ".join(f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'" for text in texts)
    policy = f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src {hashes}"
    return "".join(f'<script id="{Path(name).name}">{text}</script>\n' for name, text in zip(names, texts)), policy


STYLE = """
:root { --ink: #1c2733; --soft: #5b6b7b; --line: #dfe5eb; --blue: #1f5fa8; --orange: #d95f0e; --pale: #f5f7fa; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1060px; padding: 28px 32px 60px; color: var(--ink); background: #fff;
       font: 15px/1.5 "Inter", "Segoe UI", "Helvetica Neue", "DejaVu Sans", Arial, sans-serif; }
header { border-bottom: 3px solid var(--blue); padding-bottom: 14px; margin-bottom: 20px; }
h1 { font-size: 27px; line-height: 1.2; margin: 0 0 6px; }
h2 { font-size: 19px; margin: 38px 0 10px; padding-bottom: 5px; border-bottom: 1px solid var(--line); }
h3 { font-size: 15px; margin: 18px 0 4px; }
p { margin: 6px 0; }
.soft, figcaption { color: var(--soft); font-size: 13px; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(190px, 1fr)); gap: 10px; margin: 18px 0; }
.card { background: var(--pale); border: 1px solid var(--line); border-radius: 6px; padding: 9px 13px; }
.card b { display: block; font-size: 20px; font-weight: 600; }
.card span { color: var(--soft); font-size: 12.5px; }
figure { margin: 8px 0 14px; break-inside: avoid; }
figure svg { max-width: 100%; height: auto; display: block; }
figcaption { margin-top: 3px; }
.row { display: flex; flex-wrap: wrap; gap: 4px 12px; align-items: flex-start; break-inside: avoid; }
.row figure { margin: 2px 0; }
.grid3 { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 10px; }
.grid2 { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 10px; }
.small { display: grid; grid-template-columns: repeat(auto-fill, minmax(182px, 1fr)); gap: 8px; }
.small h3 { margin: 2px 0 0 34px; font-size: 13px; }
.panel { border: 1px solid var(--line); border-radius: 6px; padding: 8px 10px; break-inside: avoid; }
section > .panel { margin-bottom: 12px; padding: 10px 14px; }
.panel h3 { margin-top: 0; } .panel figure { margin: 0; }
table { border-collapse: collapse; width: 100%; font-size: 13px; font-variant-numeric: tabular-nums; margin: 8px 0; }
th { text-align: right; color: var(--soft); font-weight: 600; border-bottom: 1.5px solid var(--ink); padding: 3px 7px; vertical-align: bottom; }
td { text-align: right; border-bottom: 1px solid var(--line); padding: 3px 7px; white-space: nowrap; }
th:first-child, td:first-child, .text { text-align: left; white-space: normal; }
.scroll { overflow-x: auto; clear: both; }
.warning { border-left: 4px solid var(--orange); background: #fdf3ea; padding: 6px 12px; margin: 8px 0; }
.bad { border-left-color: #b3141e; background: #fdecec; }
pre { background: var(--pale); border: 1px solid var(--line); border-radius: 6px; padding: 12px 14px; font-size: 12px;
      overflow-x: auto; max-height: 460px; }
.none { color: var(--soft); font-style: italic; padding: 60px 10px; text-align: center; }
svg text { font-size: 11px; fill: var(--ink); } svg .tick { fill: var(--soft); font-size: 10.5px; } svg .label { fill: var(--soft); }
.mid { text-anchor: middle; } .end { text-anchor: end; }
.grid { stroke: #edf0f4; fill: none; } .axis { stroke: #8e9baa; fill: none; }
.beam { stroke: var(--ink); stroke-width: 2.2; fill: none; stroke-linecap: round; stroke-linejoin: round; }
.rest { stroke: #b9c3ce; stroke-width: 1.2; fill: none; } .moved { stroke: var(--blue); stroke-width: 2; fill: none; stroke-linejoin: round; }
.support { fill: var(--orange); stroke: #fff; stroke-width: 1; }
.wall { stroke: var(--ink); stroke-width: 1.4; fill: none; } .body { fill: #d8dee5; }
.force { stroke: var(--blue); stroke-width: 1.1; fill: none; stroke-linejoin: round; }
.friction { stroke: var(--orange); stroke-width: 1.1; fill: none; stroke-linejoin: round; }
.third { stroke: var(--ink); stroke-width: 1; fill: none; stroke-linejoin: round; }
.errors { stroke: var(--ink); stroke-width: 1; fill: none; } .stem { stroke: var(--blue); stroke-width: 2; fill: none; } .before { fill: #eef1f5; } .zoomed { fill: #fbdcc2; }
.band { fill: #cfe0f2; stroke: none; } .limit { stroke: #b3141e; stroke-width: 1.4; stroke-dasharray: 6 4; fill: none; }
.rose { fill: #7aa6d6; stroke: #fff; stroke-width: 0.5; } .tube { fill: #d8dee5; stroke: var(--ink); stroke-width: 0.8; } .worn { fill: #f0a868; stroke: none; }
.mode0, .mode1, .mode2, .mode3, .mode4 { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
.mode0 { stroke: #1f5fa8; } .mode1 { stroke: #d95f0e; } .mode2 { stroke: #2c8a57; } .mode3 { stroke: #7b4fa3; } .mode4 { stroke: #5b6773; }
.bar { fill: var(--blue); stroke: #fff; stroke-width: 0.6; }
.share { stroke: #fff; } .stored { fill: #7aa6d6; } .modal_damping { fill: #1f5fa8; } .contact_damping { fill: #f0a868; }
.share.friction { fill: #d95f0e; stroke-width: 1; stroke: #fff; } .share.residual { fill: #b3141e; }
.swatch { display: inline-block; width: 11px; height: 11px; border-radius: 2px; margin-right: 5px; vertical-align: -1px; }
.live-picture { max-width: 100%; overflow: hidden; } figure.on > .static { display: none; }
.u-legend { font-size: 11px; text-align: left !important; margin: 0; } .u-legend th, .u-legend td { border: 0; padding: 1px 3px; } .live-picture canvas { display: block; } .bar-of-scene { margin: 0 0 4px; font-size: 13px; }
table.data th { cursor: pointer; } th[aria-sort=descending]::after { content: " ▾"; } th[aria-sort=ascending]::after { content: " ▴"; }
.csv { float: right; font-size: 11px; color: var(--soft); background: none; border: 1px solid var(--line); border-radius: 4px; cursor: pointer; margin: 0 0 2px; }
.fold { font-size: 12px; color: var(--blue); background: none; border: 0; padding: 2px 7px; cursor: pointer; }
@media screen { table.folded > tbody > tr:nth-child(n+16) { display: none; } table.wide td { white-space: nowrap; } }
@media screen and (max-width: 720px) { body { padding: 18px 14px 40px; } .grid2, .grid3 { grid-template-columns: minmax(0, 1fr); }
  .cards { grid-template-columns: repeat(auto-fit, minmax(140px, 1fr)); } }
@page { size: A4; margin: 13mm; }
@media print { .screen { display: none; } figure.on > .static { display: block; } .live-picture, .csv, .fold { display: none; } th[aria-sort]::after { content: "" !important; }
  body { max-width: none; padding: 0; font-size: 12px; } pre { max-height: none; white-space: pre-wrap; }
  h2, h3, h2 + p { break-after: avoid; } table { font-size: 9.5px; } th, td { padding: 2px 4px; white-space: normal; } .scroll { overflow: visible; } tr, .small > * { break-inside: avoid; }
  .row { flex-wrap: nowrap; } .row figure { min-width: 0; } .panel { border-color: #ccc; } * { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
"""


def figure(picture, caption=""):
    return f"<figure>{picture}" + (f"<figcaption>{caption}</figcaption>" if caption else "") + "</figure>"


def section(title, *parts):
    return f"<section><h2>{html.escape(title)}</h2>{''.join(parts)}</section>\n"


def table(heads, rows, text_columns=(0,)):
    """Cells are HTML; columns of text stand left, numbers right. A table of many columns is scrolled, its texts stay on one line."""
    def cells(tag, row):
        kinds = [' class="text"' if i in text_columns else "" for i in range(len(row))]
        return "".join(f"<{tag}{kind}>{cell}</{tag}>" for kind, cell in zip(kinds, row))

    body = "".join(f"<tr>{cells('td', row)}</tr>" for row in rows)
    kind = "data wide" if len(heads) > MANY_COLUMNS else "data"
    return f'<div class="scroll"><table class="{kind}"><thead><tr>{cells("th", heads)}</tr></thead><tbody>{body}</tbody></table></div>'


def cards(entries):
    return '<div class="cards">' + "".join(f"<div class=card><b>{value}</b><span>{name}</span></div>" for name, value in entries) + "</div>"


def count(value):
    """A whole number of the results as text. @throws TypeError, ValueError if it is something else, text among them"""
    if isinstance(value, str):
        raise TypeError(f"a number is expected where {value[:40]!r} stands")
    return f"{int(value)}"


def warning(text, bad=False):
    return f'<p class="warning{" bad" if bad else ""}">{html.escape(text)}</p>'


def page(title, subtitle, body):
    scripts, policy = _scripts('<script class="live"' in body)
    style = (HERE / "vendor/uplot/uPlot.min.css").read_text(encoding="utf-8") + STYLE
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        f"<title>{html.escape(title)}</title><style>{style}</style></head>\n"
        f'<body><header><h1>{html.escape(title)}</h1><p class="soft">{subtitle}</p></header>\n{body}{scripts}</body></html>\n'
    )
