# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots as inline SVG: axes with round ticks, lines, envelopes of long series, bars and density pictures."""

import base64
import html
import itertools
import math
import struct
import zlib

import numpy as np

_ids = itertools.count(1)


def ticks(low, high, most=6):
    """Round numbers (1, 2, 5 times a power of ten) inside an interval: at most `most`, and a few more where that would leave one alone."""
    span = high - low
    if not (math.isfinite(span) and span > 0):
        return [low]
    raw = span / most
    power = 10.0 ** math.floor(math.log10(raw))
    steps = [factor * power for factor in (0.5, 1, 2, 5, 10)]
    place = next(i for i, step in enumerate(steps) if i and step >= raw * 0.999)
    found = _multiples(low, high, steps[place])
    return found if len(found) > 1 else _multiples(low, high, steps[place - 1])


def _multiples(low, high, step):
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    return [i * step for i in range(first, last + 1)]


ROUND_OFF = 1e-15  # below it, in SI units, a power, length or force is the round-off of a sum


SHARE_OF_ROUND_OFF = 1e-12  # of what a value was computed with


def of_sum(value, beside=None):
    """The value, 0 where it is round-off: by itself or, a force beside the others of its contact, an energy beside the input."""
    return 0.0 if value is not None and abs(value) < max(ROUND_OFF, SHARE_OF_ROUND_OFF * abs(beside or 0.0)) else value


def short(value, digits=4):
    """A number for people: as few characters as `digits` significant digits allow; a dash where there is none."""
    if value is None or not math.isfinite(value):
        return "–"
    text = f"{value:.{digits}g}"
    if "e" in text and 1 <= abs(value) < 1e6:
        text = f"{float(text):.0f}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        return f"{mantissa}·10<sup>{int(exponent)}</sup>".replace("-", "−")
    return text.replace("-", "−")


def tick_label(value, step):
    decimals = max(0, -math.floor(math.log10(step) + 1e-9)) if step > 0 else 0
    if abs(value) >= 1e6 or decimals > 5:
        return f"{value:.3g}"
    return f"{value:.{decimals}f}".replace("-", "−") if abs(value) > 1e-12 * step else "0"


_WIDTHS = {"−": 8.8, ".": 3.4}  # px of a character of a tick label, 10.5 px high, in the widest of the page's fonts; of digits 6.7


def label_width(text, digit=6.7):
    """px"""
    return sum(_WIDTHS.get(character, digit) for character in text)


def tick_room(interval, most):
    """Width (px) of the longest tick label of an axis."""
    values = ticks(interval[0], interval[1], most)
    step = values[1] - values[0] if len(values) > 1 else 1
    return max((label_width(tick_label(value, step)) for value in values), default=0.0)


_prefixes = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}


def unit_for(largest, unit):
    """The factor and the name of the unit in which `largest` has one to three digits before its point."""
    if not (math.isfinite(largest) and largest > 0):
        return 1.0, unit
    power = min(9, max(-12, 3 * math.floor(math.log10(largest) / 3 + 1e-9)))
    return 10.0**-power, _prefixes[power] + unit


def envelope(x, y, columns):
    """A series as a line through the least and largest value of each pixel column: what a screen can show of it."""
    if len(x) <= 2 * columns:
        return x, y
    edges = np.linspace(0, len(x), columns + 1).astype(int)[:-1]
    low, high = np.minimum.reduceat(y, edges), np.maximum.reduceat(y, edges)
    return np.repeat(x[edges], 2), np.column_stack((low, high)).ravel()


def png(pixels):
    """RGBA pixels (height, width, 4) of one byte each, as a data URI."""
    height, width, _ = pixels.shape

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    packed = zlib.compressobj(6, zlib.DEFLATED, zlib.MAX_WBITS, 9, zlib.Z_RLE)  # most pixels are empty: runs of zeros
    rows = np.concatenate((np.zeros((height, 1), np.uint8), pixels.reshape(height, 4 * width)), axis=1)
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0))
    data += chunk(b"IDAT", packed.compress(rows.tobytes()) + packed.flush()) + chunk(b"IEND", b"")
    return "data:image/png;base64," + base64.b64encode(data).decode()


class Plot:
    """One pair of axes. `x` and `y` are (low, high) in data units; sizes are in pixels."""

    def __init__(self, size, x, y, margins=(52, 12, 10, 38)):
        self.width, self.height = size
        self.left, self.right, self.top, self.bottom = margins
        self.x, self.y = _widened(x), _widened(y)
        self.clip = f"clip{next(_ids)}"
        self._parts = []
        self._outside = []

    @property
    def inner(self):
        return self.width - self.left - self.right, self.height - self.top - self.bottom

    def px(self, x):
        return self.left + (np.asarray(x) - self.x[0]) / (self.x[1] - self.x[0]) * self.inner[0]

    def py(self, y):
        return self.height - self.bottom - (np.asarray(y) - self.y[0]) / (self.y[1] - self.y[0]) * self.inner[1]

    def add(self, part):
        self._parts.append(part)

    def axes(self, xlabel, ylabel, x_ticks=None, y_most=5, x_most=7):
        self.left = max(self.left, math.ceil(tick_room(self.y, y_most)) + 7 + (16 if ylabel else 0))
        slanted = x_ticks is not None and len(x_ticks) > 1 and max(label_width(label) for _, label in x_ticks) > self._between(x_ticks)
        if slanted:
            self.bottom = max(self.bottom, min(110, int(0.75 * max(label_width(label) for _, label in x_ticks)) + 22))
        right, base = self.width - self.right, self.height - self.bottom
        xs = ticks(self.x[0], self.x[1], x_most) if x_ticks is None else []
        ys = ticks(self.y[0], self.y[1], y_most)
        out = []
        for value in xs:
            at = float(self.px(value))
            label = tick_label(value, xs[1] - xs[0] if len(xs) > 1 else 1)
            out.append(f'<path class="grid" d="M{at:.1f} {self.top}V{base}"/>')
            half = label_width(label) / 2
            inside = max(half, min(at, self.width - half))
            out.append(f'<text class="tick mid" x="{inside:.1f}" y="{base + 14}">{label}</text>')
        for at, label in x_ticks or []:
            x = float(self.px(at))
            turned = f'class="tick end" transform="translate({x + 3:.1f} {base + 12}) rotate(-45)"' if slanted else f'class="tick mid" x="{x:.1f}" y="{base + 14}"'
            out.append(f"<text {turned}>{html.escape(label)}</text>")
        for value in ys:
            at = float(self.py(value))
            label = tick_label(value, ys[1] - ys[0] if len(ys) > 1 else 1)
            out.append(f'<path class="grid" d="M{self.left} {at:.1f}H{right}"/>')
            out.append(f'<text class="tick end" x="{self.left - 6}" y="{at + 3.5:.1f}">{label}</text>')
        out.append(f'<path class="axis" d="M{self.left} {self.top}V{base}H{right}"/>')
        middle = (self.left + right) / 2
        out.append(f'<text class="label mid" x="{middle:.0f}" y="{self.height - 4}">{html.escape(xlabel)}</text>')
        half = (self.top + base) / 2
        out.append(f'<text class="label mid" transform="translate(12 {half:.0f}) rotate(-90)">{html.escape(ylabel)}</text>')
        self._outside = out

    def _between(self, x_ticks):
        """Least distance (px) of two labels."""
        places = sorted(float(self.px(at)) for at, _ in x_ticks)
        return min(b - a for a, b in zip(places, places[1:])) - 4

    def line(self, x, y, kind):
        x, y = np.asarray(x, float), np.asarray(y, float)
        keep = np.isfinite(x) & np.isfinite(y)
        if keep.sum() < 2:
            return
        points = np.column_stack((self.px(x[keep]), self.py(y[keep]))).round(1)
        path = " ".join(f"{a:g},{b:g}" for a, b in points)
        self.add(f'<polyline class="{kind}" points="{path}"/>')

    def series(self, x, y, kind):
        x, y = envelope(np.asarray(x), np.asarray(y), int(self.inner[0]))
        self.line(x, y, kind)

    def rectangle(self, x, y, kind):
        x0, x1 = (float(self.px(v)) for v in x)
        y1, y0 = (float(self.py(v)) for v in y)
        self.add(f'<rect class="{kind}" x="{x0:.1f}" y="{y0:.1f}" width="{max(0, x1 - x0):.1f}" height="{max(0, y1 - y0):.1f}"/>')

    def dot(self, x, y, kind, radius=3.0):
        self.add(f'<circle class="{kind}" cx="{float(self.px(x)):.1f}" cy="{float(self.py(y)):.1f}" r="{radius:.1f}"/>')

    def text(self, x, y, text, kind="note", shift=(0, 0)):
        at = (float(self.px(x)) + shift[0], float(self.py(y)) + shift[1])
        self._outside.append(f'<text class="{kind}" x="{at[0]:.1f}" y="{at[1]:.1f}">{html.escape(text)}</text>')

    def picture(self, pixels):
        """Pixels over the whole inner area."""
        width, height = self.inner
        self.add(
            f'<image x="{self.left}" y="{self.top}" width="{width}" height="{height}" '
            f'preserveAspectRatio="none" href="{png(pixels)}"/>'
        )

    def svg(self, title):
        width, height = self.inner
        return (
            f'<svg viewBox="0 0 {self.width} {self.height}" width="{self.width}" role="img" aria-label="{html.escape(title)}">'
            f'<clipPath id="{self.clip}"><rect x="{self.left}" y="{self.top}" width="{width}" height="{height}"/></clipPath>'
            + "".join(self._outside)
            + f'<g clip-path="url(#{self.clip})">'
            + "".join(self._parts)
            + "</g></svg>"
        )


def _widened(interval):
    """An interval that has a length."""
    low, high = (float(v) if math.isfinite(v) else 0.0 for v in interval)
    if high > low:
        return low, high
    margin = abs(low) * 0.1 or 1.0
    return low - margin, low + margin
