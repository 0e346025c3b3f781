# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of a run as pandas tables and xarray data sets. Columns and variables carry their units in `attrs`."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import h5py
import numpy as np

from .report.run_data import table, verify

if TYPE_CHECKING:
    import pandas
    import xarray

_UNITS = {"work_rate": "W", "friction_power": "W", "impacts_per_second": "1/s", "sliding_distance_m": "m", "impulse_Ns": "N s"}
_UNITS_OF = {"normal_force": "N", "normal_force_in_contact": "N", "tangential_force": "N", "displacement": "m", "position": "m", "penetration": "m",
             "impact_velocity": "m/s", "departure_velocity": "m/s", "contact_duration": "s", "energy": "J", "static_flexibility": "m/N"}
_SUFFIXES = {"_m_s": "m/s", "_per_s": "1/s", "_s": "s", "_m": "m", "_hz": "Hz", "_W": "W"}
_AXES = {"displacement": ("x_loc", "y_loc", "z_loc"), "velocity": ("x_loc", "y_loc", "z_loc"), "tangential_force": ("axis", "in_plane"),
         "normal": ("y_loc", "z_loc")}


def _text(value: Any) -> Any:
    return value.decode() if isinstance(value, bytes) else value


def _flat(entry: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested statistics as one level: normal_force.max."""
    found: dict[str, Any] = {}
    for key, value in entry.items():
        found |= _flat(value, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key: value}
    return found


def _unit(column: str) -> str:
    parts = column.split(".")
    if "relative" in parts or parts[0] == "step_error" or parts[-1].endswith("batches"):
        return "1"
    parts = parts[1:] if parts[0] == "standard_error" else parts
    return _UNITS.get(column, _UNITS.get(parts[0], _UNITS_OF.get(parts[0], "1")))


def _unit_by_suffix(column: str) -> str:
    """Of a key, or one above it, that names its unit: motion.power_W.fluid.mean."""
    return next((unit for part in reversed(column.split(".")) for suffix, unit in _SUFFIXES.items() if part.endswith(suffix)), "1")


class Results:
    """The results in a folder that `fretwork run` wrote. Everything is read when it is first asked for, and kept.

    Raises NoResults if a file is missing or is not as it was written."""

    def __init__(self, directory: str | Path):
        self.directory = Path(directory)
        verify(self.directory)

    def __repr__(self) -> str:
        return f"Results({str(self.directory)!r}): {self.summary['study']}"

    def _file(self) -> h5py.File:
        return h5py.File(self.directory / "results.h5", "r")

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json."""
        return json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))

    @cached_property
    def study(self) -> dict[str, Any]:
        """The study of the run, without its overrides (summary["overrides"])."""
        import tomllib

        with self._file() as file:
            return tomllib.loads(_text(file.attrs["study"]))

    def _table(self, entries: list[dict[str, Any]], unit: Callable[[str], str] = _unit) -> pandas.DataFrame:
        import pandas

        table = pandas.DataFrame([_flat(entry) for entry in entries])
        if "name" in table:
            table = table.set_index("name")
        table.attrs["units"] = {column: unit(column) for column in table.columns}
        return table

    @cached_property
    def contacts(self) -> pandas.DataFrame:
        """Statistics, a row a contact; nested keys of summary.json are joined by points. Standard errors: standard_error.*"""
        return self._table(self.summary.get("contacts", []))

    @cached_property
    def nodes(self) -> pandas.DataFrame:
        """Statistics of the observed nodes (m)."""
        return self._table(self.summary.get("nodes", []))

    @cached_property
    def impacts(self) -> pandas.DataFrame:
        """All rows of the tables of impacts; the column `contact` names the contact."""
        import pandas

        parts, units = [], {"contact": ""}
        with self._file() as file:
            for group in self._in_order(file["contacts"]):
                if "impacts" in group:
                    columns = {name: column[...] for name, column in group["impacts"].items()}
                    units |= {name: _text(column.attrs.get("units", "")) for name, column in group["impacts"].items()}
                    parts.append(pandas.DataFrame({"contact": _text(group.attrs["name"]), **columns}))
        table = pandas.concat(parts, ignore_index=True) if parts else pandas.DataFrame()
        table.attrs["units"] = units
        return table

    @staticmethod
    def _in_order(group: h5py.Group) -> list[h5py.Group]:
        return sorted(group.values(), key=lambda item: int(item.attrs["index"]))

    def series(self, name: str, kind: Literal["contact", "node"] | None = None) -> xarray.Dataset:
        """Series of a contact or an observed node at the output instants.

        kind: "contact" or "node"; without it the contact, where both have this name.
        Raises KeyError, which lists the names, if there is none of this name."""
        import xarray

        if kind not in (None, "contact", "node"):
            raise ValueError(f'kind = {kind!r}: "contact" or "node" is expected')
        with self._file() as file:
            kinds = (kind,) if kind else ("contact", "node")
            groups: dict[str, h5py.Group] = {}
            for group in (group for each in kinds if f"{each}s" in file for group in self._in_order(file[f"{each}s"])):
                groups.setdefault(_text(group.attrs["name"]), group)
            if name not in groups or "time" not in file:
                raise KeyError(f"no series of {f'the {kind} ' if kind else ''}{name!r}; there are: {', '.join(groups) or 'none'}")
            time = file["time"][...]
            found, group = {}, groups[name]
            of_node = group.parent.name == "/nodes"
            for key, item in group.items():
                if isinstance(item, h5py.Dataset) and len(item.shape) and item.shape[0] == len(time) and key != "static_flexibility":
                    axes = ("x", "y", "z") if of_node else _AXES.get(key)
                    dims = ("time",) if item.ndim == 1 else ("time", f"{key}_axis")
                    coords = {} if item.ndim == 1 or not axes else {dims[1]: list(axes[: item.shape[1]])}
                    found[key] = xarray.DataArray(item[...], dims=dims, coords=coords, attrs={"units": _text(item.attrs.get("units", ""))})
        data = xarray.Dataset(found, coords={"time": ("time", time, {"units": "s"})}, attrs={"name": name, "kind": "node" if of_node else "contact"})
        return data

    @cached_property
    def modes(self) -> pandas.DataFrame:
        """Frequency (Hz), damping ratio, modal mass (kg) and residual of each mode, static modes left out."""
        import pandas

        parts = []
        with self._file() as file:
            for number, group in self._mode_groups(file):
                count = len(group["frequency"]) - int(group.attrs["static_modes"])
                columns = {"frequency": "frequency", "damping": "damping", "mass": "mass", "residual": "residuals"}
                values = {name: group[key][:count] for name, key in columns.items() if key in group}
                parts.append(pandas.DataFrame({"structure": number, **values}))
        table = pandas.concat(parts, ignore_index=True) if parts else pandas.DataFrame()
        table.attrs["units"] = {"structure": "", "frequency": "Hz", "damping": "1", "mass": "kg", "residual": "1"}
        return table

    @staticmethod
    def _mode_groups(file: h5py.File) -> list[tuple[int, h5py.Group]]:
        modes = file["modes"]
        return [(0, modes)] if "shapes" in modes else [(int(key), modes[key]) for key in sorted(modes, key=int)]

    def mode_shapes(self, structure: int = 0) -> xarray.DataArray:
        """Shapes (mode, node, component) of a structure; translations in m, rotations in rad, at modal mass 1 kg."""
        import xarray

        with self._file() as file:
            groups = dict(self._mode_groups(file))
            if structure not in groups:
                raise KeyError(f"no structure {structure}; there are {len(groups)}, from 0")
            group = groups[structure]
            return xarray.DataArray(group["shapes"][...], dims=("mode", "node", "component"), attrs={"units": "m, rad"},
                                    coords={"frequency": ("mode", group["frequency"][...]), "node": group["nodes"][...],
                                            "component": ["dx", "dy", "dz", "rx", "ry", "rz"]})

    def stability_diagrams(self) -> list[xarray.Dataset]:
        """Frequency, damping and growth (factor, mode) under fluidelastic laws, one for each assessment and law of the run."""
        import xarray

        found = []
        with self._file() as file:
            diagrams = file.get("stability", {})
            for key in sorted(diagrams, key=int):
                group = diagrams[key]
                curves = {name: (("factor", "mode"), group[name][...], {"units": _text(group[name].attrs["units"])}) for name in ("frequency", "damping", "growth")}
                tubes = _text(group.attrs["tubes"]).split(", ")
                coords = {"factor": group["factor"][...], "tube": ("mode", [tubes[i] for i in group["tube"][...]]), "number": ("mode", group["mode"][...])}
                found.append(xarray.Dataset(curves, coords=coords, attrs={"assessment": _text(group.attrs["assessment"]), "velocity": float(group.attrs["velocity"]),
                                                                                      "diameter": float(group.attrs["diameter"])}))
        return found

    @cached_property
    def fluidelastic(self) -> pandas.DataFrame | None:
        """Fluidelastic laws of the run, a row a law: their root without contacts, and past the threshold motion.*; None where no flow has one."""
        laws = self.summary.get("fluidelastic")
        return self._table(laws, _unit_by_suffix) if laws else None

    @cached_property
    def mesh(self) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
        """Nodes (m) and the two nodes of each beam."""
        with self._file() as file:
            return file["mesh/nodes"][...], file["mesh/lines"][...]

    def _csv(self, name: str) -> pandas.DataFrame | None:
        import pandas

        path = table(self.directory, self.summary, name)
        return pandas.read_csv(path) if path else None

    @property
    def spectra(self) -> pandas.DataFrame | None:
        """spectra.csv: power spectra with their 95 % band; None where the run has none."""
        return self._csv("spectra.csv")

    @property
    def flow(self) -> pandas.DataFrame | None:
        """flow.csv: the flow along tubes; None where the run has none."""
        return self._csv("flow.csv")

    @cached_property
    def wear(self) -> pandas.DataFrame | None:
        """Wear of each support: law, coefficient, life; None where the study asks for none."""
        supports = (self.summary.get("wear") or {}).get("supports")
        return self._table(supports) if supports else None

    def report(self, output: str | Path | None = None) -> Path:
        """Writes the HTML report; returns its file."""
        from .report import write_report

        return write_report(self.directory, output)
