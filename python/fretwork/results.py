# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of a run as pandas tables and xarray data sets. Columns and variables carry their units in `attrs`."""

from __future__ import annotations

import json
import re
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import h5py
import numpy as np

from .report.run_data import table, verify

if TYPE_CHECKING:
    import pandas
    import xarray

_UNITS = {"work_rate": "W", "friction_power": "W", "normal_force": "N", "normal_force_in_contact": "N", "tangential_force": "N", "displacement": "m",
          "position": "m", "penetration": "m", "impact_velocity": "m/s", "departure_velocity": "m/s", "contact_duration": "s", "energy": "J",
          "static_flexibility": "m/N", "force": "N", "moment": "N m", "largest_force": "N", "largest_moment": "N m", "years": "a", "life_years": "a", "support_life_years": "a"}
_SUFFIXES = {"m2_per_N": "m2/N", "m_s": "m/s", "m3": "m3", "per_second": "1/s", "per_s": "1/s",
             "hz": "Hz", "rad": "rad", "Ns": "N s", "kg": "kg", "J": "J", "W": "W", "m": "m", "s": "s"}
_SUFFIX = re.compile(f"_({'|'.join(_SUFFIXES)})$")
_NO_QUANTITY = ("has_interval", "low_at_zero", "end", "batches", "work_rate_batches")  # beside values with a unit
_AXES = {"displacement": ("x_loc", "y_loc", "z_loc"), "velocity": ("x_loc", "y_loc", "z_loc"), "tangential_force": ("axis", "in_plane"),
         "normal": ("y_loc", "z_loc")}


_COMPONENTS = ("N", "Vy", "Vz", "T", "My", "Mz")


def _text(value: Any) -> Any:
    return value.decode() if isinstance(value, bytes) else value


def _flat(entry: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested statistics as one level: normal_force.max."""
    found: dict[str, Any] = {}
    for key, value in entry.items():
        found |= _flat(value, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key: value}
    return found


def _unit(column: str) -> str:
    """SI, of a column of summary.json: by its name or the unit that this ends with; "1" of ratios and counts; a: years."""
    parts = column.split(".")
    if "relative" in parts or parts[0] == "step_error" or parts[-1] in _NO_QUANTITY:
        return "1"
    for name in parts:
        suffix = _SUFFIX.search(name)
        unit = _UNITS.get(name) or (_SUFFIXES[suffix[1]] if suffix else None)
        if unit:
            return unit
    return "1"


def _numbers(values: list[float | None]) -> np.ndarray[Any, Any]:
    """NaN where summary.json has null."""
    return np.array(values, float)


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

    def _table(self, entries: list[dict[str, Any]]) -> pandas.DataFrame:
        import pandas

        table = pandas.DataFrame([_flat(entry) for entry in entries])
        if "name" in table:
            table = table.set_index("name")
        texts = [column for column in table.columns if table[column].map(lambda value: isinstance(value, (str, list))).any()]
        table.attrs["units"] = {column: "" if column in texts else _unit(column) for column in table.columns}
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
    def reactions(self) -> pandas.DataFrame:
        """Statistics of the reactions on the structure (N, N m), a row a restrained node; NaN of components that are free."""
        return self._table(self.summary.get("reactions", []))

    def section_forces(self, group: str) -> pandas.DataFrame:
        """Statistics of the sections of a group, both ends of each beam a row: s (m), largest_stress, stress_std (Pa), largest_moment (N m), and
        mean, std, min and max of N, Vy, Vz (N), T, My and Mz (N m).

        Raises KeyError, which lists the groups, if there is none of this name."""
        import pandas

        with self._file() as file:
            groups = {_text(item.attrs["name"]): item for item in self._in_order(file["sections"])} if "sections" in file else {}
            if group not in groups:
                raise KeyError(f"no section forces of {group!r}; there are: {', '.join(groups) or 'none'}")
            columns, units = {}, {}
            first = ("s", "node", "beam", "end", "largest_stress", "largest_stress_time", "stress_std", "stress_std_error", "largest_moment", "largest_shear_force")
            for name in (*first, "mean", "std", "std_error", "min", "max"):
                item = groups[group][name]
                if item.ndim == 1:
                    columns[name], units[name] = item[...], _text(item.attrs.get("units", "")) if name not in ("node", "beam", "end") else ""
                else:
                    for k, component in enumerate(_COMPONENTS):
                        columns[f"{component}.{name}"], units[f"{component}.{name}"] = item[:, k], "N" if k < 3 else "N m"
        table = pandas.DataFrame(columns)
        table.attrs["units"] = units
        return table

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

    def series(self, name: str, kind: Literal["contact", "node", "reaction"] | None = None) -> xarray.Dataset:
        """Series of a contact, an observed node or a reaction at the output instants.

        kind: "contact", "node" or "reaction"; without it the first of these that has this name.
        Raises KeyError, which lists the names, if there is none of this name."""
        import xarray

        if kind not in (None, "contact", "node", "reaction"):
            raise ValueError(f'kind = {kind!r}: "contact", "node" or "reaction" is expected')
        with self._file() as file:
            kinds = (kind,) if kind else ("contact", "node", "reaction")
            groups: dict[str, h5py.Group] = {}
            for group in (group for each in kinds if f"{each}s" in file for group in self._in_order(file[f"{each}s"])):
                groups.setdefault(_text(group.attrs["name"]), group)
            if name not in groups or "time" not in file:
                raise KeyError(f"no series of {f'the {kind} ' if kind else ''}{name!r}; there are: {', '.join(groups) or 'none'}")
            time = file["time"][...]
            found, group = {}, groups[name]
            of = {"/contacts": "contact", "/nodes": "node", "/reactions": "reaction"}[group.parent.name]
            for key, item in group.items():
                if isinstance(item, h5py.Dataset) and len(item.shape) and item.shape[0] == len(time) and key != "static_flexibility":
                    axes = _AXES.get(key) if of == "contact" else ("x", "y", "z", "about_x", "about_y", "about_z")
                    dims = ("time",) if item.ndim == 1 else ("time", f"{key}_axis")
                    coords = {} if item.ndim == 1 or not axes else {dims[1]: list(axes[: item.shape[1]])}
                    found[key] = xarray.DataArray(item[...], dims=dims, coords=coords, attrs={"units": _text(item.attrs.get("units", ""))})
        data = xarray.Dataset(found, coords={"time": ("time", time, {"units": "s"})}, attrs={"name": name, "kind": of})
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
        """Shapes (mode, node, component) of a structure; translations in m, rotations in rad, at modal mass 1 kg. Static modes, which `modes`
        leaves out, are the last.

        Raises KeyError if there is no structure of this number."""
        import xarray

        with self._file() as file:
            groups = dict(self._mode_groups(file))
            if structure not in groups:
                raise KeyError(f"no structure {structure}; there are {len(groups)}, from 0")
            group = groups[structure]
            return xarray.DataArray(group["shapes"][...], dims=("mode", "node", "component"), attrs={"units": "m, rad"},
                                    coords={"frequency": ("mode", group["frequency"][...], {"units": "Hz"}), "node": group["nodes"][...],
                                            "component": ["dx", "dy", "dz", "rx", "ry", "rz"]})

    def stability_diagrams(self) -> list[xarray.Dataset]:
        """Frequency (Hz), damping and growth (1/s) by (factor, mode) under fluidelastic laws, one for each assessment and law of the run.

        Coordinates: factor of all velocities and the velocity (m/s) that it makes; of each mode, from 1 as in all tables, its tube, its number there and its
        critical factors under the law and by Connors (NaN: none). attrs: velocity (m/s) at factor 1, diameter (m)."""
        import xarray

        found = []
        laws = [entry["law"] for entry in self.summary.get("stability", []) if entry.get("law")]
        with self._file() as file:
            diagrams = file.get("stability", {})
            for key, law in zip(sorted(diagrams, key=int), laws):
                group = diagrams[key]
                curves = {name: (("factor", "mode"), group[name][...], {"units": _text(group[name].attrs["units"])}) for name in ("frequency", "damping", "growth")}
                factor, velocity = group["factor"][...], float(group.attrs["velocity"])
                coords = {"factor": ("factor", factor, {"units": "1"}), "velocity": ("factor", velocity * factor, {"units": "m/s"}),
                          "tube": ("mode", [law["tubes"][i] for i in group["tube"][...]]), "number": ("mode", group["mode"][...] + 1),
                          "mode": np.arange(1, len(law["modes"]) + 1),
                          **{name: ("mode", _numbers([mode[name] for mode in law["modes"]]), {"units": "1"}) for name in ("critical_factor", "connors_factor")}}
                attrs = {"assessment": _text(group.attrs["assessment"]), "velocity": velocity, "diameter": float(group.attrs["diameter"])}
                found.append(xarray.Dataset(curves, coords=coords, attrs=attrs))
        return found

    @cached_property
    def fluidelastic(self) -> pandas.DataFrame | None:
        """Fluidelastic laws of the run, a row a law: their root without contacts, and past the threshold motion.*; None where no flow has one."""
        laws = self.summary.get("fluidelastic")
        return self._table(laws) if laws else None

    @cached_property
    def stability(self) -> pandas.DataFrame | None:
        """Fluid-elastic stability by Connors, a row for each mode of each case (constants K) of each assessment: frequency, damping, effective and
        critical velocity, ratio V/Vc, margin; NaN of a mode that the flow does not move. None where the run has none."""
        rows: list[dict[str, Any]] = []
        for entry in self.summary.get("stability", []):
            for number, case in enumerate(entry["cases"], 1):
                of_modes = zip(entry["modes"], case["critical_velocities_m_s"], case["ratios"])
                rows += [{"assessment": entry["name"], "tube": entry["tube"], "case": number, "mode": i, **mode, "critical_velocity_m_s": critical, "ratio": ratio,
                          "margin": None if ratio is None else 1 - ratio} for i, (mode, critical, ratio) in enumerate(of_modes, 1)]
        return self._table(rows) if rows else None

    @cached_property
    def response(self) -> pandas.DataFrame | None:
        """Linear response to turbulence, a row for each displacement of each response: rms, rms velocity, up-crossings, expected maximum.
        None where the run has none."""
        rows = [{"response": entry["name"], **point} for entry in self.summary.get("response", []) for point in entry["points"]]
        return self._table(rows) if rows else None

    @cached_property
    def mesh(self) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
        """Nodes (m) and the two nodes of each beam."""
        with self._file() as file:
            return file["mesh/nodes"][...], file["mesh/lines"][...]

    def _csv(self, name: str) -> pandas.DataFrame | None:
        import pandas

        path = table(self.directory, self.summary, name)
        if not path:
            return None
        found = pandas.read_csv(path, float_precision="round_trip")
        found.attrs["units"] = {column: unit[1] if (unit := re.search(r"\[(.*)\]$", column)) else "" for column in found.columns}
        return found

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
        """Wear of each support: law, coefficient, work rate, volume, depth, life, each figure as value, low and high. None where the study asks for none."""
        supports = (self.summary.get("wear") or {}).get("supports")
        return self._table([{key: value for key, value in entry.items() if key not in ("sides", "sectors")} for entry in supports]) if supports else None

    @cached_property
    def wear_sides(self) -> pandas.DataFrame | None:
        """Wear of each side of supports with several: flat faces (+y, -y, +z, -z; facet 1 ...), lands (land 1 ...); columns as of `wear`. None where there are none."""
        supports = (self.summary.get("wear") or {}).get("supports", [])
        rows = [{"name": entry["name"], "side": side["name"], **{key: value for key, value in side.items() if key != "name"}}
                for entry in supports for side in entry.get("sides", [])]
        return self._table(rows) if rows else None

    def wear_series(self, support: str, side: str | None = None) -> xarray.Dataset:
        """Volume (m3) and depth (m) against time (s) as (time, bound): value, low, high; sector_work_rate (W) and, with this geometry, sector depths (m)
        over the angle of the contact point (degrees, middle of the sector). side: of flat faces on several sides, or a land.

        Raises KeyError, which lists the names, if there is no wear of this name."""
        import xarray

        with self._file() as file:
            groups = {_text(group.attrs["name"]): group for group in self._in_order(file["wear"])} if "wear" in file else {}
            if support not in groups:
                raise KeyError(f"no wear of {support!r}; there is that of: {', '.join(groups) or 'none'}")
            group = groups[support]
            time = group["time"][...]
            if side is not None:
                sides = group.get("sides", {})
                if side not in sides:
                    raise KeyError(f"{support!r} has no side {side!r}; there are: {', '.join(sides) or 'none'}")
                group = sides[side]
            found = {}
            for key, item in group.items():
                dims = ("angle",) if key.startswith("sector_") else ("time", "bound")
                if isinstance(item, h5py.Dataset) and item.ndim == len(dims):
                    found[key] = xarray.DataArray(item[...], dims=dims, attrs={"units": _text(item.attrs["units"]).partition(":")[0]})
            coords: dict[str, Any] = {"time": ("time", time, {"units": "s"}), "bound": ["value", "low", "high"]}
            if "sector_work_rate" in found:
                count = len(found["sector_work_rate"])
                coords["angle"] = ("angle", -180 + (np.arange(count) + 0.5) * 360 / count, {"units": "degrees"})
            return xarray.Dataset(found, coords=coords, attrs={"support": support, "side": side or ""})

    @cached_property
    def gap_opening(self) -> pandas.DataFrame | None:
        """Stages of gap opening, a row for each stage of each support: its end in years, the gap during it, work rate and depths as value, low
        and high. None where the study asks for none. The lives: summary["wear"]["gap_opening"]["supports"]."""
        opening = (self.summary.get("wear") or {}).get("gap_opening")
        if not opening:
            return None
        keys = ("gap_m", "work_rate", "depth_m", "support_depth_m")
        rows = [{"name": support["name"], "stage": i, "years": years, **{key: support[key][i - 1] for key in keys}}
                for support in opening["supports"] for i, years in enumerate(opening["years"], 1)]
        return self._table(rows)

    def report(self, output: str | Path | None = None) -> Path:
        """Writes the HTML report; returns its file."""
        from .report import write_report

        return write_report(self.directory, output)
