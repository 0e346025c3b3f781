# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of a run as the report uses them: summary.json and results.h5 of a folder."""

import hashlib
import json
import re
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from . import flow_data


class NoResults(Exception):
    """The folder holds nothing to report; the message names what is missing and the cure."""


@dataclass
class Mode:
    """One mode of one structure: displacement (nodes, 3) and rotation (nodes, 3) at `nodes` of the mesh."""

    frequency: float
    damping: float
    residual: float
    structure: int
    nodes: np.ndarray
    displacement: np.ndarray
    rotation: np.ndarray


@dataclass
class Contact:
    name: str
    facts: dict  # attributes of its group: obstacle, gap, rest, stiffnesses ...
    summary: dict | None  # its statistics
    position: np.ndarray  # m, global axes
    y: np.ndarray | None = None  # m, from the obstacle's centre
    z: np.ndarray | None = None
    gap: np.ndarray | None = None  # m
    normal: np.ndarray | None = None  # N
    tangential: np.ndarray | None = None  # N, length of the vector
    abscissa: float | None = None  # m along the tube
    outline: np.ndarray | None = None  # m, (corners, 2) of a profile
    impacts: dict | None = None  # the columns of its table of impacts
    impacts_left_out: int = 0  # after the last row
    largest: dict | None = None  # time (s), normal_force, tangential_force (N) about its largest impact, at every step or within steps


@dataclass
class Node:
    """An observed node."""

    name: str
    summary: dict  # its statistics
    displacement: np.ndarray | None  # m, (outputs, 3), global axes


@dataclass
class Sections:
    """Sections of a group of beams, both ends of each beam."""

    name: str
    s: np.ndarray  # m, along each curve
    stress: np.ndarray  # Pa, largest; NaN where the outline is not known
    stress_std: np.ndarray  # Pa
    moment: np.ndarray  # N m, largest


@dataclass
class Run:
    summary: dict
    attributes: dict
    nodes: np.ndarray
    lines: np.ndarray
    modes: list
    contacts: list
    time: np.ndarray | None = None
    structures: int = 1
    window: float = field(default=0.0)  # s, start of the statistics
    nodes_observed: list = field(default_factory=list)
    sections: list = field(default_factory=list)
    flows: list = field(default_factory=list)  # flow_data.TubeFlow
    spectra: list = field(default_factory=list)  # flow_data.Spectrum
    groups: dict = field(default_factory=dict)  # nodes of each named group of the mesh
    wear: list = field(default_factory=list)  # of each support: the attributes and datasets of its group

    @property
    def transient(self):
        return self.summary.get("transient")

    @property
    def window_length(self):
        """s; None where the run did not reach its statistics."""
        end = self.transient.get("end_time_s")
        return end - self.window if end is not None and end > self.window else None


def _text(value):
    return value.decode() if isinstance(value, bytes) else value


def _attributes(item):
    return {key: _text(value) for key, value in item.attrs.items()}


def _structure_modes(group, structure):
    shapes = group["shapes"][...]
    columns = (group["frequency"][...], group["damping"][...], group["residuals"][...], shapes)
    nodes = group["nodes"][...]
    modes = [Mode(float(f), float(d), float(r), structure, nodes, s[:, :3], s[:, 3:]) for f, d, r, s in zip(*columns)]
    return modes[: len(modes) - int(group.attrs["static_modes"])]


def _modes(group):
    if "shapes" in group:
        return _structure_modes(group, 0), 1
    numbers = sorted(group, key=int)
    modes = [mode for number in numbers for mode in _structure_modes(group[number], int(number))]
    return sorted(modes, key=lambda mode: mode.frequency), len(numbers)


def _contact(group, summaries):
    facts = _attributes(group)
    contact = Contact(facts["name"], facts, summaries.get(facts["name"]), facts["position"])
    if "normal_force" in group:
        displacement = group["displacement"][...]
        contact.y = facts["rest"][1] + displacement[:, 1]
        contact.z = facts["rest"][2] + displacement[:, 2]
        contact.gap = group["gap"][...]
        contact.normal = group["normal_force"][...]
        contact.tangential = np.hypot(*group["tangential_force"][...].T)
    if "outline" in group:
        contact.outline = group["outline"][...]
    if "impacts" in group:
        contact.impacts = {name: column[...] for name, column in group["impacts"].items()}
        contact.impacts_left_out = int(group["impacts"].attrs["left_out"])
    if "largest_impact" in group:
        contact.largest = {name: column[...] for name, column in group["largest_impact"].items()}
    return contact


def _support_wear(group):
    support = _attributes(group)
    support.update({name: item[...] for name, item in group.items() if name not in ("states", "sides")})
    support["sides"] = {name: _support_wear(side) for name, side in group.get("sides", {}).items()}
    states = group["states"]
    support["states"] = [(_text(states[j].attrs["name"]), float(states[j].attrs["share"])) for j in sorted(states, key=int)]
    return support


def _chain_abscissae(nodes, lines):
    """Length along the line from its first end to each node, where the mesh is one open chain; else None."""
    neighbours: list[list[int]] = [[] for _ in nodes]
    for a, b in lines:
        neighbours[a].append(b)
        neighbours[b].append(a)
    ends = [i for i, others in enumerate(neighbours) if len(others) == 1]
    if len(ends) != 2 or any(len(others) > 2 for others in neighbours):
        return None
    abscissa = np.full(len(nodes), np.nan)
    previous, node, length = -1, ends[0], 0.0
    while node >= 0:
        abscissa[node] = length
        following = next((other for other in neighbours[node] if other != previous), -1)
        if following >= 0:
            length += float(np.linalg.norm(nodes[following] - nodes[node]))
        previous, node = node, following
    return abscissa


def _place_along(contacts, nodes, lines):
    abscissa = _chain_abscissae(nodes, lines)
    if abscissa is None:
        return
    places = [float(abscissa[int(contact.facts["node"])]) for contact in contacts]
    if all(np.isfinite(places)):
        for contact, place in zip(contacts, places):
            contact.abscissa = place


USER_BLOCK = 512  # bytes before the HDF5 content: a line with its checksum, then zeros
ANNOUNCEMENT = "Fretwork. SHA-256 of all bytes after the first 512: "
CHUNK = 1 << 20  # bytes read at a time


def checksum(path):
    """SHA-256 of the content of an HDF5 file."""
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        file.seek(USER_BLOCK)
        while chunk := file.read(CHUNK):
            digest.update(chunk)
    return digest.hexdigest()


CHECKSUM_OF_SUMMARY = re.compile(r'"sha256": "([0-9a-f]{64})"\s*}\s*$')  # its last key


def with_checksum(text):
    """The text of a summary with the checksum that fits it: the SHA-256 of the text in which its digits are zeros; None without the key."""
    found = CHECKSUM_OF_SUMMARY.search(text)
    if not found:
        return None
    begin, end = found.span(1)
    digest = hashlib.sha256((text[:begin] + "0" * 64 + text[end:]).encode()).hexdigest()
    return text[:begin] + digest + text[end:]


def _require_folder_of_run(folder):
    """@throws NoResults if the folder cannot hold the results of a run that has ended"""
    cure = "give the folder that `fretwork run` wrote"
    if not folder.exists():
        raise NoResults(f"{folder} does not exist; {cure}")
    if not folder.is_dir():
        results = folder.with_suffix(".results")  # of a study
        raise NoResults(f"{folder} is a file; {cure}" + (f", {results}" if (results / "summary.json").exists() else ""))
    if (folder / "table.h5").exists():
        raise NoResults(f"{folder} holds the results of a sweep, whose table is table.csv; give the folder of a case that it kept ({folder}/runs), or run the study with the values of a case (--set)")
    if not (folder / "summary.json").exists() and ((folder / ".lock").exists() or any(folder.glob("checkpoint*.h5"))):
        raise NoResults(f"{folder}: the run has not ended; wait for it, or start it again if it was interrupted: it goes on from its checkpoint")


def verify(folder, archive_name="results.h5"):
    """Before any library looks at the files. @throws NoResults if one is missing or is not as it was written"""
    if archive_name == "results.h5":
        _require_folder_of_run(folder)
    archive, summary = folder / archive_name, folder / "summary.json"
    for path in (summary, archive):
        if not path.exists():
            raise NoResults(f"{path} does not exist; give the folder that `fretwork run` wrote")
        if not path.is_file():
            raise NoResults(f"{path} is no regular file; give the folder that `fretwork run` wrote")
    with open(archive, "rb") as file:
        block = file.read(USER_BLOCK)
    expected = f"{ANNOUNCEMENT}{checksum(archive)}\n".encode().ljust(USER_BLOCK, b"\0")
    text = summary.read_text(encoding="utf-8", errors="replace")
    for path, good in ((archive, block == expected), (summary, with_checksum(text) == text)):
        if not good:
            raise NoResults(f"{path} is not as it was written (its checksum does not fit); run the study again")


def table(folder, summary, name):
    """The path of a table beside the summary; None where the run has none of that name. @throws NoResults if it is not as it was written"""
    digests = summary.get("files_sha256")
    if not isinstance(digests, dict) or name not in digests:
        return None
    path = folder / name
    if not path.is_file() or hashlib.sha256(path.read_bytes()).hexdigest() != digests[name]:
        raise NoResults(f"{path} is not as it was written (its checksum does not fit); run the study again")
    return path


def load(directory):
    """@throws NoResults if a file is missing or is not as it was written"""
    folder = Path(directory)
    verify(folder)
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        with h5py.File(folder / "results.h5", "r") as file:
            summaries = {entry["name"]: entry for entry in summary.get("contacts", [])}
            groups = sorted(file["contacts"].values(), key=lambda group: int(group.attrs["index"]))
            modes, structures = _modes(file["modes"])
            run = Run(
                summary,
                _attributes(file),
                file["mesh/nodes"][...],
                file["mesh/lines"][...],
                modes,
                [_contact(group, summaries) for group in groups],
                structures=structures,
            )
            if "mesh/groups" in file:
                run.groups = {_attributes(group)["name"]: group["nodes"][...] for group in file["mesh/groups"].values()}
            if "wear" in file:
                run.wear = sorted((_support_wear(group) for group in file["wear"].values()), key=lambda support: int(support["index"]))
            series = {_attributes(group).get("name", name): group for name, group in file["nodes"].items()} if "nodes" in file else {}
            for entry in summary.get("nodes", []):
                group = series.get(entry["name"])
                run.nodes_observed.append(Node(entry["name"], entry, group["displacement"][...] if group is not None else None))
            for group in sorted(file.get("sections", {}).values(), key=lambda group: int(group.attrs["index"])):
                columns = (group[key][...] for key in ("s", "largest_stress", "stress_std", "largest_moment"))
                run.sections.append(Sections(_attributes(group)["name"], *columns))
            if "time" in file:
                run.time = file["time"][...]
                run.window = float(file.attrs["statistics_from"])
        run.flows = flow_data.flows(table(folder, summary, "flow.csv"))
        run.spectra = flow_data.spectra(table(folder, summary, "spectra.csv"))
    except (OSError, KeyError, ValueError, TypeError, AttributeError, RuntimeError) as error:
        raise NoResults(f"{folder}: the results are damaged or of another version ({error}); run the study again") from error
    if run.attributes.get("input_sha256") != summary.get("input_sha256"):
        raise NoResults(f"{folder}: summary.json and results.h5 are of different runs; run the study again")
    _place_along(run.contacts, run.nodes, run.lines)
    return run
