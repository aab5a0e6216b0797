# SPDX-License-Identifier: BSD-3-Clause
"""A cross-section through the body as it has moved, and the outline of the one before."""
from collections import namedtuple

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.ticker import MaxNLocator
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkCutter

from .bodies import colours_of, grid_at
from .common import FAINT, INK, Refusal

Section = namedtuple("Section", "axis value")


def half_way(points):
    """Across the longest side."""
    low, high = points.min(axis=0), points.max(axis=0)
    axis = int(np.argmax(high - low))
    middle = 0.5 * (low[axis] + high[axis])
    return Section(axis, middle if abs(middle) > 1e-9 * (high[axis] - low[axis]) else 0.0)


def choose_section(asked, body):
    """By the body before, as results of several steps then show the same place; by the one that has moved if that is not met."""
    if asked == "auto":
        section = half_way(body.rest)
        along = body.moved[:, section.axis]
        return section if along.min() < section.value < along.max() else half_way(body.moved)
    name, _, value = asked.partition("=")
    try:
        return Section("xyz".index(name.strip().lower() or "?"), float(value))
    except ValueError:
        raise Refusal(f"--section {asked}: expected an axis and where, as in y=5, auto or none") from None


def cut(grid, section):
    """Points in the plane, triangles, values and the outline of a section."""
    plane = vtkPlane()
    plane.SetNormal(*np.eye(3)[section.axis])
    plane.SetOrigin(*(section.value * np.eye(3)[section.axis]))
    cutter = vtkCutter()
    cutter.SetInputData(grid)
    cutter.SetCutFunction(plane)
    cutter.GenerateTrianglesOn()
    cutter.Update()
    found = cutter.GetOutput()
    if found.GetNumberOfPolys() == 0:
        return None
    places = vtk_to_numpy(found.GetPoints().GetData())[:, [k for k in range(3) if k != section.axis]].astype(float)
    triangles = vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    places, first, triangles = merge_section(places, triangles)
    return places, triangles, vtk_to_numpy(found.GetPointData().GetScalars())[first], outline(places, triangles)


def merge_section(places, triangles):
    """VTK cuts tet by tet: what neighbours share becomes one, and faces that lie in the plane are there once."""
    grain = 1e-5 * np.ptp(places, axis=0).max()
    _, first, number = np.unique(np.round(places / grain).astype(np.int64), axis=0, return_index=True,
                                 return_inverse=True)
    triangles = np.unique(np.sort(number.reshape(-1)[triangles], axis=1), axis=0)
    flat = (triangles[:, 0] == triangles[:, 1]) | (triangles[:, 1] == triangles[:, 2])
    return places[first], first, triangles[~flat]


def outline(places, triangles):
    """Edges of one triangle only."""
    edges = np.vstack([triangles[:, pair] for pair in ([0, 1], [1, 2], [0, 2])])
    edges, uses = np.unique(edges, axis=0, return_counts=True)
    return places[edges[uses == 1]]


def draw_section(axes, body, section, shade):
    name = "xyz"[section.axis]
    moved = cut(grid_at(body, body.moved), section)
    rest = cut(grid_at(body, body.rest), section)
    if moved is None:
        low, high = body.moved[:, section.axis].min(), body.moved[:, section.axis].max()
        raise Refusal(f"the plane {name} = {section.value:g} misses the deformed body, which lies between "
                      f"{low:g} and {high:g}; choose another --section")
    places, triangles, size, border = moved
    axes.tripcolor(*places.T, triangles, size, shading="gouraud", cmap=colours_of(shade),
                   norm=Normalize(shade.low, shade.high))
    axes.add_collection(LineCollection(border, colors=INK, linewidths=1.1, capstyle="round"))
    seen = [places]
    if rest is not None:
        axes.add_collection(LineCollection(rest[3], colors=FAINT, linewidths=0.8, capstyle="round"))
        seen.append(rest[0])
    seen = np.vstack(seen)
    low, high = seen.min(axis=0), seen.max(axis=0)
    margin = 0.06 * (high - low).max()
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.set_aspect("equal", adjustable="box", anchor="C")
    wide, tall = high - low
    if wide < 0.6 * tall:
        axes.xaxis.set_major_locator(MaxNLocator(2))  # more labels would overlap on a narrow section
    across = [k for k in "xyz" if k != name]
    axes.set_xlabel(across[0])
    axes.set_ylabel(across[1], rotation=0, labelpad=10)
    axes.tick_params(labelsize=9, length=3, color=FAINT, labelcolor=INK)
    for side in axes.spines.values():
        side.set_color("#d0d7de")
