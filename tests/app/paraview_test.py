# SPDX-License-Identifier: GPL-3.0-or-later
"""What `fretwork export --format vtu` writes, read and rendered by VTK: paraview_test.py FRETWORK EXAMPLES DOC_PICTURES. Needs a display (xvfb-run)."""

import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

FRETWORK, EXAMPLES, PICTURES = (sys.argv.pop(1) for _ in range(3))
sys.path.insert(0, PICTURES)
import draw_paraview  # noqa: E402

ROUND_OFF = 1e-12  # of sums of some hundred terms

# A clamped tube along x, loaded at its tip from the start: N = 100, Vy = 20, Vz = -10, T = 3.
LENGTH, YOUNG, OUTER, WALL = 2.0, 2.0e11, 0.02, 0.002
FORCE = {"x": 100.0, "y": 20.0, "z": -10.0}
TORQUE = 3.0
CANTILEVER = """
[mesh]
file = "beam.geo"
[materials.steel]
young_modulus = {young}
poisson_ratio = 0.3
density = 8000.0
[sections.tube]
shape = "pipe"
outer_diameter = {outer}
thickness = {wall}
[[beams]]
group = "beam"
material = "steel"
section = "tube"
orientation = [0.0, 1.0, 0.0]
[[restraints]]
group = "root"
fixed = "all"
[modes]
count = {count}
damping = 0.01
[[loads]]
group = "tip"
direction = [{x}, {y}, {z}]
constant = {force}
[[loads]]
group = "tip"
direction = [1.0, 0.0, 0.0]
moment = true
constant = {torque}
[transient]
duration = 0.01
start = "static"
[output]
every = 0.001
"""
BEAM = """
Point(1) = {{0, 0, 0, 1}};
Point(2) = {{{length}, 0, 0, 1}};
Line(1) = {{1, 2}};
Transfinite Curve {{1}} = {nodes};
Physical Point("root") = {{1}};
Physical Point("tip") = {{2}};
Physical Curve("beam") = {{1}};
"""


def fretwork(*arguments):
    return subprocess.run([FRETWORK, *map(str, arguments)], capture_output=True, text=True, check=False)


def done(*arguments):
    outcome = fretwork(*arguments)
    assert outcome.returncode == 0, outcome.stderr
    return outcome.stdout


def grid(file):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def arrays(data):
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


def points_of(file):
    return vtk_to_numpy(file.GetPoints().GetData())


class Cantilever(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="fretwork_paraview_")
        cls.folder = Path(cls.temporary.name)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def moments_at_start(self, elements, count, contact="", static_modes="none"):
        """Middles of the beams (m) and their arrays at t = 0."""
        size = math.sqrt(sum(f * f for f in FORCE.values()))
        (self.folder / "beam.geo").write_text(BEAM.format(length=LENGTH, nodes=elements + 1))
        study = CANTILEVER.format(young=YOUNG, outer=OUTER, wall=WALL, count=count, force=size, torque=TORQUE, **{k: f / size for k, f in FORCE.items()})
        (self.folder / "study.toml").write_text(study.replace("[modes]", f'[modes]\nstatic_modes = "{static_modes}"') + contact)
        done("transient", self.folder / "study.toml", "-q")
        done("export", self.folder / "study.results", "--format", "vtu")
        first = grid(draw_paraview.instants(self.folder / "study.results/export-vtu/snapshots.pvd")[0][1])
        x = points_of(first)[:, 0]
        ends = vtk_to_numpy(first.GetCells().GetConnectivityArray()).reshape(-1, 2)
        return x[ends].mean(axis=1), arrays(first.GetCellData())

    def test_all_modes_give_the_closed_forms(self):
        x, cells = self.moments_at_start(elements=8, count=48)  # as many modes as dofs: nothing is left out
        arm = LENGTH - x
        for name, expected in {"Vy [N]": FORCE["y"], "Vz [N]": FORCE["z"], "Mz [N m]": FORCE["y"] * arm, "My [N m]": -FORCE["z"] * arm}.items():
            np.testing.assert_allclose(cells[name], expected, rtol=1e-7, atol=1e-7, err_msg=name)
        # omega of axial and torsional modes counts the motion inside the elements, their shapes do not: the highest modes of the mesh differ
        for name, expected in {"N [N]": FORCE["x"], "T [N m]": TORQUE}.items():
            np.testing.assert_allclose(cells[name], expected, rtol=0.01, err_msg=name)
        # the largest stress of a beam is at its end towards the root, as far as N and T are right
        inner = OUTER - 2 * WALL
        area, inertia = math.pi / 4 * (OUTER**2 - inner**2), math.pi / 64 * (OUTER**4 - inner**4)
        bending = math.hypot(FORCE["y"], FORCE["z"]) * (arm + LENGTH / 16) * OUTER / 2 / inertia
        np.testing.assert_allclose(cells["stress [Pa]"], FORCE["x"] / area + bending, rtol=1e-3)

    def test_fewer_modes_give_the_moment_of_their_sum(self):
        """M = E I sum phi''(x) phi(L) F/omega^2 over the modes of a clamped beam; with k from 1 + cos(kL) cosh(kL) = 0."""
        elements, planes = 40, 2
        wave = np.array([1.875104068711961, 4.694091132974175, 7.854757438237613]) / LENGTH
        for pairs in (1, 2, 3):
            x, cells = self.moments_at_start(elements, count=planes * pairs)
            expected = np.zeros(elements)
            for k in wave[:pairs]:
                c = (math.cosh(k * LENGTH) + math.cos(k * LENGTH)) / (math.sinh(k * LENGTH) + math.sin(k * LENGTH))
                curvature = np.cosh(k * x) + np.cos(k * x) - c * (np.sinh(k * x) + np.sin(k * x))
                tip = math.cosh(k * LENGTH) - math.cos(k * LENGTH) - c * (math.sinh(k * LENGTH) - math.sin(k * LENGTH))
                expected += FORCE["y"] * curvature * tip / (k * k * LENGTH)
            of_the_mesh = (wave[pairs - 1] * LENGTH / elements) ** 2 / 24  # of curvatures in the middle of elements
            np.testing.assert_allclose(cells["Mz [N m]"], expected, rtol=0, atol=1.5 * of_the_mesh * FORCE["y"] * LENGTH)
        self.assertGreater(abs(expected[0] / (FORCE["y"] * (LENGTH - x[0])) - 1.0), 0.005)  # and is not yet that of all


    def test_static_modes_hold_the_moments(self):
        far = '[[contacts]]\nname = "stop"\ngroup = "tip"\ngap = 1.0\nnormal_stiffness = 1e5\n'  # loads of its directions at its node
        for static_modes, least, most in (("all", 0.0, 1e-7), ("none", 0.02, 1.0)):
            x, cells = self.moments_at_start(8, count=4, contact=far, static_modes=static_modes)
            error = np.abs(cells["Mz [N m]"] / (FORCE["y"] * (LENGTH - x)) - 1.0).max()
            self.assertLess(error, most)
            self.assertGreaterEqual(error, least)


class Bend(unittest.TestCase):
    """examples/u_bend, for a short time."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="fretwork_paraview_")
        cls.results = Path(cls.temporary.name) / "results"
        cls.exported = cls.results / "export-vtu"
        shorter = ("transient.duration=0.2", "output.statistics_from=0", "modes.count=60", "contacts.hot_tsp3.thickness=0.03")
        done("transient", Path(EXAMPLES) / "u_bend/study.toml", "-o", cls.results, "-q", *(word for key in shorter for word in ("--set", key)))
        cls.said = done("export", cls.results, "--format", "vtu", "--from", "0.1", "--every", "10")
        cls.structure = draw_paraview.instants(cls.exported / "snapshots.pvd")
        cls.contacts = draw_paraview.instants(cls.exported / "contacts.pvd")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_holds_the_outputs_of_the_window(self):
        with h5py.File(self.results / "results.h5") as file:
            time = file["time"][...]
        expected = time[time > 0.1 - 1e-9][::10]
        self.assertEqual(len(expected), 11)
        for series in (self.structure, self.contacts):
            self.assertEqual([instant for instant, _ in series], list(expected))
        self.assertIn("11 of 201 outputs, 0.1 to 0.2 s", self.said)
        for name in ("snapshots", "contacts"):
            self.assertEqual(len(list((self.exported / name).iterdir())), 11)

    def test_moves_as_the_modes(self):
        with h5py.File(self.results / "results.h5") as file:
            shapes, q, nodes = file["modes/shapes"][...], file["modal/displacement"][...], file["mesh/nodes"][...]
        for number, (_, name) in enumerate(self.structure):
            found, motion = grid(name), np.einsum("k,knc->nc", q[100 + 10 * number], shapes)
            np.testing.assert_array_equal(points_of(found), nodes)
            data = arrays(found.GetPointData())
            for key, columns in (("displacement [m]", slice(0, 3)), ("rotation [rad]", slice(3, 6))):
                np.testing.assert_allclose(data[key], motion[:, columns], rtol=0, atol=ROUND_OFF * np.abs(motion).max())
            np.testing.assert_allclose(data["radius [m]"], 0.01905 / 2, rtol=ROUND_OFF)

    def test_frames_are_orthonormal_and_follow_the_tube(self):
        found = grid(self.structure[0][1])
        x, ends = points_of(found), vtk_to_numpy(found.GetCells().GetConnectivityArray()).reshape(-1, 2)
        chord = x[ends[:, 1]] - x[ends[:, 0]]
        for data in (arrays(found.GetPointData()), arrays(found.GetCellData())):
            frames = np.stack([data[f"{axis}_loc"] for axis in "xyz"], axis=1)
            np.testing.assert_allclose(frames @ frames.transpose(0, 2, 1), np.broadcast_to(np.eye(3), frames.shape), atol=ROUND_OFF)
            np.testing.assert_allclose(np.linalg.det(frames), 1.0, rtol=ROUND_OFF)
        tangent = arrays(found.GetCellData())["x_loc"]
        np.testing.assert_allclose(tangent, chord / np.linalg.norm(chord, axis=1)[:, None], atol=ROUND_OFF)
        bend = np.flatnonzero(x[:, 2] > 9.01)  # circle of 1 m about (0, 0, 9); the tangent of a node is the mean of its chords
        self.assertGreater(len(bend), 50)
        radial = (x[bend] - [0, 0, 9]) / np.linalg.norm(x[bend] - [0, 0, 9], axis=1)[:, None]
        np.testing.assert_allclose(np.einsum("ij,ij->i", arrays(found.GetPointData())["x_loc"][bend], radial), 0.0, atol=1e-4)

    def test_contact_forces_are_those_of_the_results(self):
        with h5py.File(self.results / "results.h5") as file:
            groups = sorted(file["contacts"].values(), key=lambda group: group.attrs["index"])
            names = [group.attrs["name"] for group in groups]
            self.assertIn("hot_tsp3@2", names)
            closed = 0
            for number, (_, name) in enumerate(self.contacts):
                at, found = 100 + 10 * number, grid(name)
                data = arrays(found.GetPointData())
                normal, friction, total = (data[f"{kind} force [N]"] for kind in ("normal", "friction", "contact"))
                np.testing.assert_array_equal(data["contact"], np.arange(len(groups)))
                np.testing.assert_array_equal(data["gap [m]"], [group["gap"][at] for group in groups])
                np.testing.assert_array_equal(data["state"], [group["state"][at] for group in groups])
                np.testing.assert_allclose(points_of(found), [group.attrs["point"] for group in groups], rtol=0, atol=0)
                scale = 1e-30 + max(group["normal_force"][at] for group in groups)
                self.assertAlmostEqual(np.linalg.norm(normal, axis=1).sum() / scale, sum(group["normal_force"][at] for group in groups) / scale, places=11)
                for i, group in enumerate(groups):
                    axes, n, (along, across) = group.attrs["axes"], np.array([0.0, *group["normal"][at]]), group["tangential_force"][at]
                    closed += group["normal_force"][at] > 0
                    np.testing.assert_allclose(normal[i], axes.T @ n * group["normal_force"][at], atol=ROUND_OFF * scale)
                    np.testing.assert_allclose(friction[i], axes.T @ ([along, 0, 0] + across * np.cross(n, [1.0, 0, 0])), atol=ROUND_OFF * scale)
                    self.assertAlmostEqual(np.linalg.norm(friction[i]) / scale, math.hypot(along, across) / scale, places=11)
                    self.assertLessEqual(np.linalg.norm(friction[i]), (0.3 + 1e-3) * np.linalg.norm(normal[i]) + 1e-9)
                np.testing.assert_allclose(total, normal + friction, atol=ROUND_OFF * scale)
            self.assertGreater(closed, 10)

    def test_contacts_move_with_the_tube(self):
        with h5py.File(self.results / "results.h5") as file:
            groups = sorted(file["contacts"].values(), key=lambda group: group.attrs["index"])
            for number, (_, name) in enumerate(self.contacts):
                moved = arrays(grid(name).GetPointData())["displacement [m]"]
                for i, group in enumerate(groups):  # the obstacles are fixed: local displacements are those of the tube
                    np.testing.assert_allclose(group.attrs["axes"] @ moved[i], group["displacement"][100 + 10 * number], rtol=0, atol=1e-15)

    def test_renders_tube_and_arrows(self):
        time = max(self.contacts, key=lambda entry: np.linalg.norm(arrays(grid(entry[1]).GetPointData())["contact force [N]"], axis=1).max())[0]
        at = draw_paraview.grid_at(self.exported / "snapshots.pvd", time)
        tube = draw_paraview.tubes(at, factor=0.0)[0].GetOutput()
        self.assertGreater(tube.GetNumberOfCells(), 1000)
        # across the plane of the bend no point is further away than the radius
        self.assertAlmostEqual(np.abs(points_of(tube)[:, 1]).max(), 0.01905 / 2, places=6)
        picture = Path(self.temporary.name) / "picture.png"
        draw_paraview.render(self.exported, time, picture, longest_arrow=3.0, size=(500, 500))
        reader = vtkPNGReader()
        reader.SetFileName(str(picture))
        reader.Update()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)
        red = (pixels[:, 0] > 100) & (pixels[:, 1] < 80) & (pixels[:, 2] < 80)
        coloured = (pixels.max(axis=1) - pixels.min(axis=1) > 60) & ~red
        self.assertGreater(red.sum(), 30)
        self.assertGreater(coloured.sum(), 1000)
        self.assertGreater((pixels == 255).all(axis=1).mean(), 0.5)

    def test_refuses_what_makes_no_series(self):
        for options, message in {
            ("--from", "5"): "--from 5: a time from 0 to 0.2 s is expected",
            ("--to", "-1"): "--to -1: a time from 0 to 0.2 s",
            ("--from", "nan"): "--from nan: a time from 0 to 0.2 s",
            ("--every", "0"): "--every 0: an integer >= 1",
            ("--from", "0.15", "--to", "0.1"): "ends before it begins",
            ("--from", "0.10001", "--to", "0.10002"): "the next are at 0.1 and 0.101 s",
        }.items():
            outcome = fretwork("export", self.results, "--format", "vtu", *options)
            self.assertEqual(outcome.returncode, 1, options)
            self.assertIn(message, outcome.stderr)
        outcome = fretwork("export", self.results, "--every", "2")
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("--format csv has all; leave them out, or add --format vtu", outcome.stderr)
        self.assertEqual(len(list((self.exported / "snapshots").iterdir())), 11)  # what was there is there


if __name__ == "__main__":
    unittest.main()
