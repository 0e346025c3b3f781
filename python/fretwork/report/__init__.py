# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a run as one HTML file, and the comparison of runs. Needs numpy and h5py only."""

from pathlib import Path


def write_report(directory: str | Path, output: str | Path | None = None) -> Path:
    """Writes the report of the run in `directory`, by default to its report.html; returns the file.

    Raises run_data.NoResults if the folder holds no results, or damaged ones."""
    from .build import build, write_whole

    path = Path(output) if output else Path(directory) / "report.html"
    write_whole(path, build(directory))
    return path
