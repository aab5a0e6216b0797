# SPDX-License-Identifier: BSD-3-Clause
"""What the colours stand for: one number at each node, from a field of the file; and the material axes."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from .common import Refusal

TENSOR, OWN_TENSOR = ("xx", "yy", "zz", "xy", "yz", "zx"), ("11", "22", "33", "12", "23", "31")
VECTOR, PRINCIPAL = ("x", "y", "z"), ("largest", "middle", "least")


def is_principal(name):
    return name in ("principal_stress", "principal_strain")


def is_load_factor(field):
    return field.endswith("load_factor")


def name_and_part(field):
    """NAME:PART; without a part von Mises' stress of a stress, of principal values the largest."""
    name, _, part = field.partition(":")
    return name, part or ("largest" if is_principal(name) else "mises" if name.endswith("stress") else "")


def part_of(path, values, name, component):
    """One number of each vector or tensor: a component by name, or by number from 0, the length, or von Mises' stress."""
    width = 1 if values.ndim == 1 else values.shape[1]
    known = {3: PRINCIPAL if is_principal(name) else VECTOR,
             6: OWN_TENSOR if name.startswith("material_") else TENSOR}.get(width, ())
    if component in known:
        return values[:, known.index(component)]
    if width == 1 and not component:
        return values if values.ndim == 1 else values[:, 0]
    if known == VECTOR and component in ("", "length"):
        return np.linalg.norm(values, axis=1)
    if width == 6 and component == "mises":
        normal, shear = values[:, :3], values[:, 3:]
        return np.sqrt(0.5 * ((normal - np.roll(normal, 1, axis=1)) ** 2).sum(axis=1) + 3 * (shear ** 2).sum(axis=1))
    if component.isdigit() and int(component) < width and width > 1:
        return values[:, int(component)]
    words = [*known, *(["length"] if known == VECTOR else ["mises"] if width == 6 else []),
             *([f"0 to {width - 1}"] if width > 1 else [])]
    raise Refusal(f"{path}: '{name}' has no part '{component}'" +
                  (f"; it has {', '.join(words)}, as in --field {name}:{words[0]}" if words else ", it is one number"))


def read_field(path, whole, first, field):
    """Values at the nodes. What a file has tet by tet is averaged there: over the tets that touch a node."""
    name, component = name_and_part(field)
    for data in (whole.GetPointData(), whole.GetCellData()):
        if data.GetArray(name) is None:
            continue
        values = part_of(path, vtk_to_numpy(data.GetArray(name)).astype(float), name, component)
        return values[first] if data.IsA("vtkPointData") else average(whole, first, values, is_load_factor(name))
    names = [data.GetArrayName(a) for data in (whole.GetPointData(), whole.GetCellData())
             for a in range(data.GetNumberOfArrays())]
    raise Refusal(f"{path}: has no field '{name}'; it has {', '.join(names)}. Which are written says the case: "
                  "output: {fields: [...]}")


NOWHERE = 1e9  # load factor where nothing fails


def average(whole, first, values, is_factor=False):
    cells = whole.GetCells()
    label = whole.GetPointData().GetArray("vertex")
    keys = vtk_to_numpy(label) if label else vtk_to_numpy(whole.GetPoints().GetData()).astype(float)
    node = np.unique(keys, axis=0, return_inverse=True)[1].reshape(-1)
    ids = node[vtk_to_numpy(cells.GetConnectivityArray())]
    counts = np.diff(vtk_to_numpy(cells.GetOffsetsArray()))
    weight = (values < NOWHERE).astype(float) if is_factor else np.ones(len(values))
    sums, weights = (np.bincount(ids, np.repeat(rows, counts), len(first)) for rows in (weight * values, weight))
    return np.where(weights > 0, sums / np.maximum(weights, 1), NOWHERE if is_factor else 0.0)


def axes_of(data):
    """e1, e2, e3 of each tet, NaN for one that is not there; None: none is."""
    if data.GetArray("axes"):
        return vtk_to_numpy(data.GetArray("axes")).reshape(-1, 3, 3)
    rows = [vtk_to_numpy(data.GetArray(name)) if data.GetArray(name) else None for name in ("e1", "e2", "e3")]
    there = [row for row in rows if row is not None]
    return np.stack([np.full_like(there[0], np.nan) if row is None else row for row in rows], axis=1) if there else None
