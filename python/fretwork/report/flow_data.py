# SPDX-License-Identifier: GPL-3.0-or-later
"""flow.csv and spectra.csv of a results folder: the flow along tubes, and power spectra."""

import csv
import itertools
from dataclasses import dataclass, field

import numpy as np


@dataclass
class TubeFlow:
    """The flow along one tube, a row a place by ascending abscissa."""

    tube: str
    zones: list = field(default_factory=list)  # of each place
    columns: dict = field(default_factory=dict)  # by the heads of the file: arrays


@dataclass
class Spectrum:
    name: str
    quantity: str
    unit: str
    frequency: np.ndarray  # Hz
    density: np.ndarray
    low: np.ndarray  # 95 %
    high: np.ndarray


def _columns(path):
    """The columns of a table by their heads, as texts; none where there is no file, or no row."""
    if path is None:
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    return dict(zip(rows[0], zip(*rows[1:]))) if len(rows) > 1 else {}


def _places(keys):
    """Where each key stands, in the order of the first ones."""
    found: dict[str | tuple[str, ...], list[int]] = {}
    first = 0
    for key, rows in itertools.groupby(keys):
        last = first + sum(1 for _ in rows)
        found.setdefault(key, []).extend(range(first, last))
        first = last
    return found


def flows(path):
    """In the order of the file; none without a file."""
    columns = _columns(path)
    numbers = {head: np.array(values, float) for head, values in columns.items() if head not in ("tube", "zone")}
    return [
        TubeFlow(tube, [columns["zone"][i] for i in places], {head: values[places] for head, values in numbers.items()})
        for tube, places in _places(columns.get("tube", ())).items()
    ]


def spectra(path):
    """In the order of the file; none without a file."""
    columns = _columns(path)
    if not columns:
        return []
    values = np.array([columns[head] for head in ("frequency [Hz]", "density", "low_95", "high_95")], float)
    keys = zip(columns["name"], columns["quantity"], columns["unit"])
    return [Spectrum(*key, *values[:, places]) for key, places in _places(keys).items()]
