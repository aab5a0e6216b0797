# SPDX-License-Identifier: BSD-3-Clause
"""The deformed shape with its edges, loads, supports and fibres, as pixels."""
import numpy as np
from matplotlib.colors import to_rgb
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkPolyDataNormals
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersHybrid import vtkPolyDataSilhouette
from vtkmodules.vtkRenderingCore import vtkActor, vtkLightKit, vtkPolyDataMapper, vtkRenderer
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (draws)

from .bodies import colours_of, grid_at, has_axis, shade_of
from .common import BEYOND, FAINT, INK, SHARPNESS
from .marks import ARROW, HELD, MOVED, TWO_HEADS, arrows, dashes, dots, gradients
from .view import load_arrows, set_camera


def surface_of(grid):
    """Its triangles; the cell array 'cell' says of which tet. (Of quadratic tets VTK 9.1 itself would say of which face.)"""
    numbers = numpy_to_vtk(np.arange(grid.GetNumberOfCells()), deep=True)
    numbers.SetName("cell")
    numbered = vtkUnstructuredGrid()
    numbered.ShallowCopy(grid)
    numbered.GetCellData().AddArray(numbers)
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(numbered)
    surface.SetNonlinearSubdivisionLevel(1)
    surface.Update()
    return surface.GetOutput()


def shaded_actor(body, shade):
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface_of(grid_at(body, body.moved)))
    normals.SetFeatureAngle(40.0)
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for i, colour in enumerate(colours_of(shade)(np.linspace(0, 1, 256))):
        table.SetTableValue(i, *colour)
    table.SetAboveRangeColor(*to_rgb(BEYOND), 1.0)
    table.SetUseAboveRangeColor(shade.beyond)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(shade.low, shade.high)
    mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    paint = actor.GetProperty()
    paint.SetInterpolationToPhong()
    paint.SetAmbient(0.22)
    paint.SetDiffuse(0.85)
    paint.SetSpecular(0.12)
    paint.SetSpecularPower(30.0)
    return actor


def line_actor(lines, width, colour):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(lines)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    paint = actor.GetProperty()
    paint.SetColor(*to_rgb(colour))
    paint.SetLineWidth(width * SHARPNESS)
    paint.LightingOff()
    return actor


def edges_of(grid):
    """Sharp edges of a body's surface."""
    edges = vtkFeatureEdges()
    edges.SetInputData(surface_of(grid))
    edges.SetFeatureAngle(40.0)
    edges.ManifoldEdgesOff()
    edges.NonManifoldEdgesOff()
    edges.ColoringOff()
    edges.Update()
    return edges.GetOutput()


def silhouette_of(grid, camera):
    silhouette = vtkPolyDataSilhouette()
    silhouette.SetInputData(surface_of(grid))
    silhouette.SetCamera(camera)
    silhouette.SetEnableFeatureAngle(0)
    silhouette.Update()
    return silhouette.GetOutput()


def mark(renderer, overlay, bodies, number, view, fibre):
    """Supports, fibres and, over all else, the loads of one body."""
    body = bodies[number]
    extent = np.linalg.norm(np.ptp(bodies[0].rest, axis=0))
    if body.reaction is not None:
        held = np.linalg.norm(body.reaction, axis=1) > 0
        for chosen, colour in ((held & (body.size == 0), HELD), (held & (body.size > 0), MOVED)):
            if chosen.any():
                renderer.AddActor(dots(body.moved[chosen], colour, 4.5 * SHARPNESS))
    if fibre is not None and has_axis(body, fibre):
        renderer.AddActor(dashes(surface_of(grid_at(body, body.moved)), body.axes[:, fibre],
                                 lambda cells: gradients(body, cells), 0.03 * extent, 1.3 * SHARPNESS))
    for loads, outline in zip(load_arrows(bodies), (ARROW, TWO_HEADS)):
        if number in loads:
            overlay.AddActor(arrows(*loads[number], view.eye, outline))


def draw_shape(bodies, number, view, asked, width, height):
    """The deformed shape of one of the bodies as an array of pixels."""
    body = bodies[number]
    renderer, overlay = vtkRenderer(), vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    camera = renderer.GetActiveCamera()
    set_camera(camera, view, width / height)
    overlay.SetLayer(1)
    overlay.SetActiveCamera(camera)
    renderer.AddActor(shaded_actor(body, shade_of(bodies, asked.field)))
    for places, width_of_line, colour in ((body.moved, 1.0, INK), (body.rest, 1.2, FAINT)):
        grid = grid_at(body, places)
        renderer.AddActor(line_actor(edges_of(grid), width_of_line, colour))
        renderer.AddActor(line_actor(silhouette_of(grid, camera), width_of_line, colour))
    mark(renderer, overlay, bodies, number, view, asked.fibres)
    light = vtkLightKit()
    light.SetKeyLightIntensity(0.9)
    light.SetKeyLightAngle(40.0, -25.0)
    light.SetKeyToFillRatio(2.2)
    light.AddLightsToRenderer(renderer)
    renderer.ResetCameraClippingRange()
    return render_pixels((renderer, overlay), width, height)


def render_pixels(renderers, width, height):
    """One layer for each renderer, the last on top."""
    window = vtkRenderWindow()
    window.SetNumberOfLayers(len(renderers))
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(width * SHARPNESS, height * SHARPNESS)
    for renderer in renderers:
        window.AddRenderer(renderer)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
    window.Finalize()  # before its display goes
    pixels = pixels.reshape(height, SHARPNESS, width, SHARPNESS, -1).mean(axis=(1, 3))
    return pixels[::-1] / 255.0
