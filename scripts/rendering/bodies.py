# SPDX-License-Identifier: BSD-3-Clause
"""The bodies that are drawn: where their nodes are, and what is shown on them."""
import math
from collections import namedtuple

import numpy as np
from matplotlib import colormaps
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_ID_TYPE
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid

from .common import BEYOND, Refusal
from .fields import axes_of, is_load_factor, name_and_part, read_field
from .marks import make_points
from .results import read_step

COLOURS, SIGNED = "viridis", "coolwarm"  # of what has one sign, and of what has both
# The body as it was; where its nodes are drawn now; |u|; and how much u was enlarged. Load and reaction of the nodes,
# material axes of the tets: None where the file has none.
# What is it instead of an answer, by the file's own words (solve --keep)? None: an answer. `value`: what colours stand for.
# Is it an envelope, which has |u| and no u?
Body = namedtuple("Body", "grid rest moved size scale status load reaction axes value envelope")
# Is anything drawn beyond the range?
Shade = namedtuple("Shade", "name low high colours beyond")


def merge_pieces(grid):
    """Points that pieces share become one again, so that no faces are left between pieces."""
    label = grid.GetPointData().GetArray("vertex")
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    keys = vtk_to_numpy(label) if label else points
    _, first, node = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    merged = vtkUnstructuredGrid()
    ids = node.reshape(-1)[vtk_to_numpy(grid.GetCells().GetConnectivityArray())]
    cells = vtkCellArray()
    ids = numpy_to_vtk(ids.astype(np.int64), deep=True, array_type=VTK_ID_TYPE)
    cells.SetData(grid.GetCells().GetOffsetsArray(), ids)
    merged.SetPoints(make_points(points[first]))
    merged.SetCells(grid.GetCellTypesArray(), cells)
    return merged, first


def round_scale(scale):
    """The nearest of 1, 2, 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(scale))
    return min((1, 2, 5, 10), key=lambda m: abs(math.log(m * power / scale))) * power


def choose_scale(asked, largest, extent, keeps_lengths=False):
    """A displacement of 2 to 40 percent of the body shows as it is, and a larger one that is found with large rotations,
    where the body keeps its lengths; any other is brought to about 12 percent."""
    if asked != "auto":
        return float(asked)
    if largest == 0.0 or 0.02 * extent <= largest and (largest <= 0.4 * extent or keeps_lengths):
        return 1.0
    return round_scale(0.12 * extent / largest)


def keeps_lengths(body, u):
    """Do edges of tets change by less than 5 percent, in the mean?"""
    first = vtk_to_numpy(body.grid.GetCells().GetOffsetsArray())[:-1]
    nodes = vtk_to_numpy(body.grid.GetCells().GetConnectivityArray())[first[:, None] + np.arange(4)]
    before, after = (np.linalg.norm(at[nodes[:, 1:]] - at[nodes[:, :1]], axis=2) for at in (body.rest, body.rest + u))
    return np.sqrt(np.mean((after / before - 1.0) ** 2)) < 0.05


def load_bodies(paths, asked_scale, field=None):
    """The bodies of several results, all with the scale that suits the one that moves most."""
    loaded = [load_fields(path, field) for path in paths]
    largest_of = [np.linalg.norm(u, axis=1).max() for _, u, _ in loaded]
    scale = choose_scale(asked_scale, max(largest_of), max(np.ptp(body.rest, axis=0).max() for body, _, _ in loaded),
                         keeps_lengths(*loaded[np.argmax(largest_of)][:2]))
    scale = 1.0 if all(body.envelope for body, _, _ in loaded) else scale
    return [body._replace(moved=body.rest + scale * u, scale=scale, status=status) for body, u, status in loaded]


def load_fields(path, field=None):
    whole = read_step(path)
    data = whole.GetPointData()
    is_envelope = data.GetArray("largest_displacement") is not None  # of load cases: drawn as it was
    if not is_envelope and (data.GetArray("displacement") is None or data.GetArray("displacement").GetNumberOfComponents() != 3):
        names = [data.GetArrayName(a) for a in range(data.GetNumberOfArrays())]
        raise Refusal(f"{path}: has no point array 'displacement' of 3 components (it has: {', '.join(names)}); "
                      "ask for it in the case: output: {fields: [displacement]}")
    grid, first = merge_pieces(whole)

    def on_nodes(name):
        return vtk_to_numpy(data.GetArray(name))[first].astype(float) if data.GetArray(name) else None

    rest = vtk_to_numpy(grid.GetPoints().GetData())
    u = np.zeros(rest.shape) if is_envelope else on_nodes("displacement")
    size = on_nodes("largest_displacement") if is_envelope else np.linalg.norm(u, axis=1)
    marks = [word for word in ("unfinished", "refused") if whole.GetFieldData().GetAbstractArray(word) is not None]
    body = Body(grid, rest, None, size, None, None, on_nodes("load"), on_nodes("reaction"), axes_of(whole.GetCellData()),
                read_field(path, whole, first, field) if field else size, is_envelope)
    return body, u, marks[0] if marks else None


def has_axis(body, number):
    return body.axes is not None and not np.isnan(body.axes[:, number]).all()


def largest(bodies):
    return max(body.size.max() for body in bodies)


def shade_of(bodies, field):
    """The range of all bodies, from 0 where it has one sign; equal to both sides of 0 where it has two. Of load factors it
    ends at ten times the least: those of tets with little stress say nothing."""
    low, high = min(body.value.min() for body in bodies), max(body.value.max() for body in bodies)
    is_cut = field is not None and is_load_factor(field) and 0 < 10 * low < high
    high = 10 * low if is_cut else high
    both = low < -1e-9 * high and high > 0
    size = max(-low, high)
    name = "largest |u|" if all(body.envelope for body in bodies) else "|u|"
    if field is not None:
        name = " ".join(name_and_part(field)).strip().replace("_", " ")
        name = name.replace("von mises", "mises").replace("mises", "von Mises")
    if both:
        return Shade(name, -size, size, SIGNED, False)
    low, high = (0.0, high) if high > 0 else (low, 0.0)
    return Shade(name, low, high if high > low else 1.0, COLOURS, bool(is_cut))


def colours_of(shade):
    colours = colormaps[shade.colours].copy()
    if shade.beyond:
        colours.set_over(BEYOND)
    return colours


def grid_at(body, places):
    """The body with its nodes at these places, and what is drawn in colours on them."""
    grid = vtkUnstructuredGrid()
    grid.ShallowCopy(body.grid)
    grid.SetPoints(make_points(places))
    values = numpy_to_vtk(np.ascontiguousarray(body.value), deep=True)
    values.SetName("value")
    grid.GetPointData().SetScalars(values)
    return grid
