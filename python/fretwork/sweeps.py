# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of a sweep as a pandas table."""

from __future__ import annotations

import json
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from .report.run_data import NoResults, verify
from .results import Results

if TYPE_CHECKING:
    import pandas

_OUTCOMES = ("done", "refused", "failed", "defect", "crashed")  # numbers of /case/outcome


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _values(numbers: np.ndarray[Any, Any], names: list[str] | None) -> Any:
    """A variable by cases: its numbers, or the texts that they stand for, true and false as such."""
    if names is None:
        return numbers
    return [{"true": True, "false": False}.get(names[int(i)], names[int(i)].strip('"')) for i in numbers]


class Sweep:
    """The results in a folder that `fretwork sweep` wrote.

    Raises NoResults if a file is missing or is not as it was written."""

    def __init__(self, directory: str | Path):
        self.directory = Path(directory)
        if not (self.directory / "table.h5").exists():
            cure = "start it again, it goes on" if (self.directory / "shards").exists() else "give the folder that `fretwork sweep` wrote"
            raise NoResults(f"{self.directory} holds no table of a sweep (table.h5); {cure}")
        verify(self.directory, "table.h5")

    def __repr__(self) -> str:
        return f"Sweep({str(self.directory)!r}): {self.summary['done']} of {self.summary['cases']} cases done"

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json: counts, failures, statistics."""
        return json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))

    @cached_property
    def table(self) -> pandas.DataFrame:
        """A row a case, by its number: outcome, variables, outputs; NaN without a result. Units of outputs in attrs["units"]; variables have
        those of their keys. What went wrong in cases without a result: summary["failures"]."""
        import pandas

        with h5py.File(self.directory / "table.h5", "r") as file:
            columns: dict[str, Any] = {"outcome": [_OUTCOMES[int(i)] for i in file["case/outcome"][...]]}
            for key, item in file["inputs"].items():
                names = file.attrs.get(f"values of {key}")
                columns[key.replace("%2F", "/")] = _values(item[...], _text(names).split("\n") if names is not None else None)
            outputs = {key.replace("%2F", "/"): item[...] for key, item in file["outputs"].items()}
            table = pandas.DataFrame({**columns, **{name: outputs[name] for name in self.summary["columns"]}},
                                     index=pandas.Index(file["case/number"][...].astype(int), name="case"))
        table.attrs["units"] = {name: self.summary["units"].get(name) or ("1" if name in outputs else "") for name in table.columns}
        return table

    def case(self, number: int) -> Results:
        """All results of a case that the sweep kept (`keep`).

        Raises KeyError, which lists them, if it kept none of this number."""
        kept = sorted(int(folder.name.removeprefix("case_")) for folder in (self.directory / "runs").glob("case_*"))
        if number not in kept:
            raise KeyError(f"the sweep has not kept case {number}; it has: {', '.join(map(str, kept)) or 'none, ask for some by sweep.keep'}")
        return Results(self.directory / "runs" / f"case_{number}")
