// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The Python program that converts a mesh by meshio: `python -c <script> <file> <msh file>`, to .msh 2.2 as
/// text. Exit status 0, or no_meshio where the interpreter lacks the package, or 1 after printing why the
/// file could not be read.
///
/// Names of groups come from, in this order (a cell may be in several groups):
/// - sets of cells and points (Abaqus ELSET and NSET, ...); families of MED files;
/// - `gmsh:physical` with its names; `medit:ref`: groups are called by their number;
/// - in formats without groups (.vtu, .xdmf, .vtk): an integer array of cells or points. `tube` with values 0
/// and 1 marks the
///   group "tube"; `tube-ends` with values -1, 0 and 1 is how meshio writes the groups "tube" (0) and "ends"
///   (1).
#pragma once

namespace fretwork::mesh {

inline constexpr int no_meshio = 42;

inline constexpr const char* meshio_script = R"python(
import sys
try:
    import meshio
    import numpy as np
except ImportError as missing:
    print(missing)
    sys.exit(42)


def flat(entry):
    if entry is None:
        return np.array([], dtype=int)
    if isinstance(entry, (list, tuple)):
        parts = [flat(part) for part in entry]
        return np.concatenate(parts) if parts else np.array([], dtype=int)
    return np.atleast_1d(np.asarray(entry)).astype(int)


def from_array(name, values):
    values = np.asarray(values)
    if values.ndim != 1 or values.dtype.kind not in "iu" or values.size == 0:
        return {}
    if name in ("gmsh:geometrical", "gmsh:physical"):
        return {}
    if name == "medit:ref":
        return {str(v): np.flatnonzero(values == v) for v in np.unique(values) if v != 0}
    parts = name.split("-")
    low, high = int(values.min()), int(values.max())
    if low >= -1 and high < len(parts):
        return {part: np.flatnonzero(values == i) for i, part in enumerate(parts)}
    return {name: np.flatnonzero(values)} if low >= 0 and high == 1 else {}


def tagged(tags, values):
    found = {}
    for tag, names in (tags or {}).items():
        for name in names:
            found.setdefault(name, []).append(np.flatnonzero(np.asarray(values) == tag))
    return {name: np.concatenate(parts) for name, parts in found.items()}


def cell_groups(mesh):
    """(name, dimension): numbers of cells, counted through all blocks."""
    first = np.cumsum([0] + [len(block.data) for block in mesh.cells])
    joined = {}
    for name, parts in mesh.cell_data.items():
        joined[name] = np.concatenate([np.asarray(part) for part in parts])
    groups = {}
    for name, parts in mesh.cell_sets.items():
        if not name.startswith("gmsh:"):
            cells = [flat(part) + first[b] for b, part in enumerate(parts) if b < len(mesh.cells)]
            groups[name] = np.concatenate(cells) if cells else flat(None)
    if hasattr(mesh, "cell_tags") and "cell_tags" in joined:
        groups.update(tagged(mesh.cell_tags, joined.pop("cell_tags")))
    if not groups and "gmsh:physical" in joined:
        physical = joined["gmsh:physical"]
        names = {int(v[0]): n for n, v in mesh.field_data.items() if len(v) == 2 and int(v[1]) == 1}
        for tag in np.unique(physical):
            if tag != 0:
                groups[names.get(int(tag), str(tag))] = np.flatnonzero(physical == tag)
    if not groups:
        for name, values in joined.items():
            groups.update(from_array(name, values))
    return groups, first


def point_groups(mesh):
    groups = {name: flat(part) for name, part in mesh.point_sets.items()}
    data = dict(mesh.point_data)
    if hasattr(mesh, "point_tags") and "point_tags" in data:
        groups.update(tagged(mesh.point_tags, data.pop("point_tags")))
    if not groups:
        for name, values in data.items():
            groups.update(from_array(name, values))
    return groups


def write(mesh, path):
    by_cell, first = cell_groups(mesh)
    by_point = point_groups(mesh)
    tags = {name: i + 1 for i, name in enumerate(sorted(set(by_cell) | set(by_point)))}
    tags_of = {}
    for name in sorted(by_cell):
        for cell in by_cell[name]:
            tags_of.setdefault(int(cell), []).append(tags[name])
    elements, used = [], set()
    for block, begin in zip(mesh.cells, first):
        kind = meshio.gmsh.meshio_to_gmsh_type.get(block.type)
        if kind is None:
            sys.exit("cells of type %s cannot be read" % block.type)
        dimension = {"vertex": 0, "line": 1, "line3": 1}.get(block.type, 2)
        for i, nodes in enumerate(np.asarray(block.data).tolist()):
            for tag in tags_of.get(int(begin) + i, [0]):
                elements.append((kind, tag, nodes))
                if dimension < 2:
                    used.add((dimension, tag))
    for name, points in by_point.items():
        used.add((0, tags[name]))
        elements.extend((15, tags[name], [int(p)]) for p in points)
    for name, cells in by_cell.items():
        if len(cells) == 0:
            used.add((1, tags[name]))
    points = np.zeros((len(mesh.points), 3))
    given = np.asarray(mesh.points, dtype=float)
    points[:, : given.shape[1]] = given
    with open(path, "w", encoding="utf-8") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
        names = [(d, t, n) for n, t in tags.items() for d in (0, 1) if (d, t) in used]
        out.write("$PhysicalNames\n%d\n" % len(names))
        out.writelines('%d %d "%s"\n' % (d, t, n.replace('"', "'")) for d, t, n in names)
        out.write("$EndPhysicalNames\n$Nodes\n%d\n" % len(points))
        out.writelines("%d %r %r %r\n" % (i + 1, *x) for i, x in enumerate(points.tolist()))
        out.write("$EndNodes\n$Elements\n%d\n" % len(elements))
        for i, (kind, tag, nodes) in enumerate(elements):
            out.write("%d %d 2 %d 1 %s\n" % (i + 1, kind, tag, " ".join(str(n + 1) for n in nodes)))
        out.write("$EndElements\n")


try:
    write(meshio.read(sys.argv[1]), sys.argv[2])
except Exception as error:
    print("%s: %s" % (type(error).__name__, error))
    sys.exit(1)
)python";

} // namespace fretwork::mesh
