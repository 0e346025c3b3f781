# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of doc/paraview.md: the moving structure and its contact forces as `fretwork export --format vtu` writes them, rendered by VTK.

    draw_paraview.py EXPORT_FOLDER TIME PICTURE.png

VTK needs a display: without one, xvfb-run draw_paraview.py ..."""

import sys
from pathlib import Path
from xml.etree import ElementTree

import vtkmodules.vtkInteractionStyle  # noqa: F401
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersCore import vtkArrayCalculator, vtkGlyph3D, vtkTubeFilter
from vtkmodules.vtkFiltersGeneral import vtkWarpVector
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkArrowSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS
FORCE, FORCE_COLOUR = "contact force [N]", (0.80, 0.15, 0.10)


def instants(collection):
    """Times and files of a .pvd file, in its order."""
    collection = Path(collection)
    return [(float(entry.get("timestep")), collection.parent / entry.get("file")) for entry in ElementTree.parse(collection).iter("DataSet")]


def grid_at(collection, time):
    """The reader of the file nearest to a time."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(min(instants(collection), key=lambda entry: abs(entry[0] - time))[1]))
    reader.Update()
    return reader


def warped(reader, factor):
    """Warp By Vector."""
    warp = vtkWarpVector()
    warp.SetInputConnection(reader.GetOutputPort())
    warp.SetInputArrayToProcess(0, 0, 0, POINTS, "displacement [m]")
    warp.SetScaleFactor(factor)
    return warp


def actor_of(source):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor, mapper


def tubes(reader, factor, thicker=1.0, colour="stress [Pa]"):
    """Warp By Vector, Extract Surface, Tube by the absolute radius; returns the filter whose output is drawn."""
    surface = vtkGeometryFilter()
    warp = warped(reader, factor)  # by a name: a port does not keep its filter alive
    surface.SetInputConnection(warp.GetOutputPort())
    thick = vtkArrayCalculator()
    thick.SetInputConnection(surface.GetOutputPort())
    thick.AddScalarVariable("r", "radius [m]")
    thick.SetFunction(f"{thicker}*r")
    thick.SetResultArrayName("drawn radius [m]")
    tube = vtkTubeFilter()
    tube.SetInputConnection(thick.GetOutputPort())
    tube.SetInputArrayToProcess(0, 0, 0, POINTS, "drawn radius [m]")
    tube.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
    tube.SetNumberOfSides(16)
    tube.CappingOn()
    tube.Update()
    actor, mapper = actor_of(tube)
    table = vtkLookupTable()
    table.SetHueRange(0.60, 0.08)
    table.SetSaturationRange(0.55, 0.95)
    table.Build()
    mapper.SetLookupTable(table)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray(colour)
    mapper.SetScalarRange(0.0, tube.GetOutput().GetCellData().GetArray(colour).GetRange()[1])
    return tube, actor, table


def arrows(reader, factor, metres_per_newton):
    """Glyph: an arrow a contact along its force, as long as the force is large."""
    glyph = vtkGlyph3D()
    warp = warped(reader, factor)
    glyph.SetInputConnection(warp.GetOutputPort())
    arrow = vtkArrowSource()
    arrow.SetTipResolution(24)
    arrow.SetShaftResolution(24)
    glyph.SetSourceConnection(arrow.GetOutputPort())
    glyph.SetInputArrayToProcess(1, 0, 0, POINTS, FORCE)
    glyph.SetVectorModeToUseVector()
    glyph.SetScaleModeToScaleByVector()
    glyph.SetScaleFactor(metres_per_newton)
    glyph.Update()
    actor, mapper = actor_of(glyph)
    mapper.ScalarVisibilityOff()
    actor.GetProperty().SetColor(*FORCE_COLOUR)
    return glyph, actor


def render(folder, time, picture, factor=400.0, thicker=3.0, longest_arrow=0.6, view=None, size=(900, 760)):
    """Writes a PNG: displacements times `factor`, radii times `thicker`, the largest contact force `longest_arrow` m long.

    view(camera) places the camera; default: a parallel view against the y axis."""
    structure, contacts = grid_at(Path(folder) / "snapshots.pvd", time), grid_at(Path(folder) / "contacts.pvd", time)
    largest = contacts.GetOutput().GetPointData().GetArray(FORCE).GetRange(-1)[1]
    _, tube, table = tubes(structure, factor, thicker)
    _, forces = arrows(contacts, factor, longest_arrow / largest if largest > 0.0 else 0.0)
    scene = vtkRenderer()
    scene.SetBackground(1.0, 1.0, 1.0)
    scene.AddActor(tube)
    scene.AddActor(forces)
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle("stress [Pa]")
    bar.SetNumberOfLabels(4)
    bar.SetLabelFormat("%.2g")
    bar.SetVerticalTitleSeparation(12)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.15, 0.15, 0.15)
        text.ShadowOff()
        text.ItalicOff()
    bar.SetPosition(0.88, 0.3)
    bar.SetWidth(0.09)
    bar.SetHeight(0.4)
    scene.AddActor2D(bar)
    camera = scene.GetActiveCamera()
    if view:
        view(camera)
    else:
        camera.SetPosition(0.0, -1.0, 0.0)
        camera.SetViewUp(0.0, 0.0, 1.0)
        camera.ParallelProjectionOn()
    scene.ResetCamera()
    if view:
        view(camera)
        scene.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*size)
    window.AddRenderer(scene)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(str(picture))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


def upper_bend(camera):
    """Of examples/u_bend: the bend with its four bars and the upper plates, from aside."""
    camera.SetFocalPoint(0.25, 0.0, 8.75)
    camera.SetPosition(2.2, -7.0, 9.6)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(22.0)


if __name__ == "__main__":
    render(sys.argv[1], float(sys.argv[2]), sys.argv[3], view=upper_bend)
