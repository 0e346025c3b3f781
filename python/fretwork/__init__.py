# SPDX-License-Identifier: GPL-3.0-or-later
"""Fretwork in Python: results as labelled arrays, runs, plots, the report.

    import fretwork
    results = fretwork.run("study.toml", {"modes.count": 60})
    results.contacts["work_rate"]

Submodules and pandas, xarray and matplotlib are imported when they are first used."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .report.run_data import NoResults
    from .results import Results
    from .runs import RunFailed, read_study, run, sweep, write_study
    from .sweeps import Sweep

_HOMES = {"NoResults": "report.run_data", "Results": "results", "run": "runs", "RunFailed": "runs", "Sweep": "sweeps", "read_study": "runs", "sweep": "runs", "write_study": "runs"}
__all__ = ["NoResults", "Results", "RunFailed", "Sweep", "read_study", "run", "sweep", "write_study"]


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(f".{_HOMES[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:  # what completion offers
    return [*__all__, "plots", "report"]
