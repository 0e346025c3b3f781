# SPDX-License-Identifier: GPL-3.0-or-later
"""flow.csv and spectra.csv of a results folder: the flow along tubes, and power spectra."""

import csv
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


def _rows(path):
    if path is None:
        return []
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def flows(path):
    """In the order of the file; none without a file."""
    found = {}
    for row in _rows(path):
        tube = found.setdefault(row["tube"], TubeFlow(row["tube"]))
        tube.zones.append(row["zone"])
        for head in row.keys() - {"tube", "zone"}:
            tube.columns.setdefault(head, []).append(float(row[head]))
    for tube in found.values():
        tube.columns = {head: np.array(values) for head, values in tube.columns.items()}
    return list(found.values())


def spectra(path):
    """In the order of the file; none without a file."""
    found = {}
    for row in _rows(path):
        values = found.setdefault((row["name"], row["quantity"], row["unit"]), [])
        values.append([float(row[head]) for head in ("frequency [Hz]", "density", "low_95", "high_95")])
    return [Spectrum(*key, *np.array(values).T) for key, values in found.items()]
