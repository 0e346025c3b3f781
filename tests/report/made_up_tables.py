# SPDX-License-Identifier: GPL-3.0-or-later
"""Summaries that are changed by hand, under a checksum that fits."""

import hashlib
import json

from fretwork.report import run_data


def change_summary(folder, change):
    """summary.json as `change` leaves it, with the checksum that fits."""
    file = folder / "summary.json"
    summary = json.loads(file.read_text())
    change(summary)
    summary["sha256"] = summary.pop("sha256")  # the last key
    file.write_text(run_data.with_checksum(json.dumps(summary)))


def add_tables(folder):
    """The summary names the tables that lie beside it."""
    found = [folder / name for name in ("flow.csv", "spectra.csv") if (folder / name).exists()]
    digests = {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in found}
    change_summary(folder, lambda summary: summary.update(files_sha256=digests))
