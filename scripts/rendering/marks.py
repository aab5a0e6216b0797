# SPDX-License-Identifier: BSD-3-Clause
"""What is marked on a shape: loads as arrows, supports as dots, fibres as dashes."""
import numpy as np
from matplotlib.colors import to_rgb
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_ID_TYPE, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

LOAD, HELD, MOVED, FIBRE = "#d1242f", "#b3261e", "#1a7f37", "#ffffff"


def make_points(places):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places), deep=True))
    return points


def make_cells(ids):
    """Cells of equally many points each: one row of ids for each cell."""
    cells = vtkCellArray()
    offsets = np.arange(0, ids.size + 1, ids.shape[1], dtype=np.int64)
    cells.SetData(*(numpy_to_vtk(part.astype(np.int64).ravel(), deep=True, array_type=VTK_ID_TYPE)
                    for part in (offsets, ids)))
    return cells


def actor_of(data, colour):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*to_rgb(colour))
    actor.GetProperty().LightingOff()
    return actor


def bins_of(places, size):
    """Number of the cube of this size in which each place lies, counted from the lowest corner of all."""
    cubes = np.floor((places - places.min(axis=0)) / size).astype(np.int64)
    return np.unique(cubes, axis=0, return_inverse=True)[1].reshape(-1)


def gather_loads(rest, moved, load, size):
    """Loads that lay in a cube of this size become one arrow: where it starts, and their sum; or, where they cancel, their
    moment: returns the forces, then the moments. One arrow is enough for a load of the whole body, such as its weight."""
    size_of_load = np.linalg.norm(load, axis=1)
    on = size_of_load > 1e-12 * size_of_load.max()
    bins = bins_of(rest[on], size) if on.mean() < 0.5 else np.zeros(on.sum(), dtype=int)
    load, weight = load[on], size_of_load[on, None]
    sums = add_up(bins, np.hstack([load, weight * moved[on], weight * rest[on], weight]))
    force, whole, starts = sums[:, :3], sums[:, 9], sums[:, 3:6] / sums[:, 9:]
    arm = rest[on] - (sums[:, 6:9] / sums[:, 9:])[bins]
    turning = add_up(bins, np.hstack([np.cross(arm, load), np.linalg.norm(arm, axis=1)[:, None] * weight]))
    cancels = np.linalg.norm(force, axis=1) < 0.05 * whole
    turns = cancels & (np.linalg.norm(turning[:, :3], axis=1) > 0.2 * turning[:, 3])
    return (starts[~cancels], force[~cancels]), (starts[turns], turning[turns, :3])


def add_up(bins, rows):
    sums = np.zeros((bins.max() + 1, rows.shape[1]))
    np.add.at(sums, bins, rows)
    return sums


ARROW = [[0, -0.045], [0.6, -0.045], [0.6, 0.045], [0, 0.045], [0.6, -0.15], [1, 0], [0.6, 0.15]]
TWO_HEADS = [[0, -0.045], [0.4, -0.045], [0.4, 0.045], [0, 0.045], [0.65, -0.15], [1, 0], [0.65, 0.15],
             [0.3, -0.15], [0.65, 0], [0.3, 0.15]]


def arrows(starts, vectors, eye, outline=ARROW):
    """Flat arrows that face the eye, as triangles: a shaft and heads."""
    length = np.linalg.norm(vectors, axis=1)
    starts, vectors = starts[length > 0], vectors[length > 0]
    across = np.cross(vectors, eye)
    across *= (length[length > 0] / np.maximum(np.linalg.norm(across, axis=1), 1e-9 * length[length > 0]))[:, None]
    outline = np.array(outline)
    points = starts[:, None] + outline[:, :1] * vectors[:, None] + outline[:, 1:] * across[:, None]
    first = len(outline) * np.arange(len(starts))[:, None, None]
    triangles = [[0, 1, 2], [0, 2, 3], *([i, i + 1, i + 2] for i in range(4, len(outline), 3))]
    data = vtkPolyData()
    data.SetPoints(make_points(points.reshape(-1, 3)))
    data.SetPolys(make_cells((first + triangles).reshape(-1, 3)))
    return actor_of(data, LOAD)


def dots(places, colour, width):
    data = vtkPolyData()
    data.SetPoints(make_points(places))
    data.SetVerts(make_cells(np.arange(len(places))[:, None]))
    actor = actor_of(data, colour)
    actor.GetProperty().SetPointSize(width)
    actor.GetProperty().RenderPointsAsSpheresOn()
    actor.GetProperty().LightingOn()
    return actor


def gradients(body, cells):
    """Deformation gradients of tets, as drawn."""
    offsets = vtk_to_numpy(body.grid.GetCells().GetOffsetsArray())[cells]
    nodes = vtk_to_numpy(body.grid.GetCells().GetConnectivityArray())[offsets[:, None] + np.arange(4)]
    edges = [(places[nodes[:, 1:]] - places[nodes[:, :1]]).transpose(0, 2, 1) for places in (body.moved, body.rest)]
    return edges[0] @ np.linalg.inv(edges[1])


def dashes(surface, axes, turn, size, width):
    """A dash along the fibre on one triangle of each cube of this size. `axes`: fibre of each cell at rest, to which
    the surface's cell array 'cell' refers; `turn`: the deformation gradient of each cell."""
    places = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    corners = places[vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    middle = corners.mean(axis=1)
    chosen = np.unique(bins_of(middle, size), return_index=True)[1]
    cell = vtk_to_numpy(surface.GetCellData().GetArray("cell"))[chosen]
    fibre = np.einsum("tij,tj->ti", turn(cell), axes[cell])
    fibre /= np.linalg.norm(fibre, axis=1)[:, None]
    normal = np.cross(corners[chosen, 1] - corners[chosen, 0], corners[chosen, 2] - corners[chosen, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    start = middle[chosen] + 0.05 * size * normal
    along = 0.4 * size * (fibre - np.sum(fibre * normal, axis=1)[:, None] * normal)  # as seen on the surface
    data = vtkPolyData()
    data.SetPoints(make_points(np.hstack([start - along, start + along]).reshape(-1, 3)))
    data.SetLines(make_cells(np.arange(2 * len(start)).reshape(-1, 2)))
    actor = actor_of(data, FIBRE)
    actor.GetProperty().SetLineWidth(width)
    return actor
