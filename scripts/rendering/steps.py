# SPDX-License-Identifier: BSD-3-Clause
"""Steps of a VTKHDF file: VTK 9.1 reads the first alone."""
import os

from vtkmodules.util.numpy_support import numpy_to_vtk

ENDINGS = (".vtkhdf", ".hdf")


def split(path):
    """FILE:STEP as file and step; the step is None where there is none."""
    name, colon, step = path.rpartition(":")
    named = colon and not os.path.exists(path) and name.lower().endswith(ENDINGS)
    return (name, step) if named else (path, None)


def names(path):
    """Of the steps of a file; None where it is no series."""
    import h5py
    try:
        with h5py.File(path, "r") as file:
            if "VTKHDF/Steps/Values" not in file:
                return None
            count = len(file["VTKHDF/Steps/Values"])
            known = file["Orthostat/StepNames"][:] if "Orthostat/StepNames" in file else range(1, count + 1)
            return [name.decode() if isinstance(name, bytes) else str(name) for name in known]
    except OSError:  # VTK says what is wrong with the file
        return None


def take(grid, path, number):
    """Gives a grid the arrays of this step, from 0, in place of the first one's."""
    import h5py
    with h5py.File(path, "r") as file:
        for data, group in ((grid.GetPointData(), "PointData"), (grid.GetCellData(), "CellData")):
            for array in [data.GetArray(i) for i in range(data.GetNumberOfArrays())]:
                rows, name = file[f"VTKHDF/{group}/{array.GetName()}"], array.GetName()
                offset = file[f"VTKHDF/Steps/{group}Offsets/{name}"][number]
                values = numpy_to_vtk(rows[offset:offset + array.GetNumberOfTuples()], deep=True)
                values.SetName(name)
                data.AddArray(values)
        flags = grid.GetFieldData()
        for word in ("unfinished", "refused"):
            if f"VTKHDF/FieldData/{word}" in file and not file[f"VTKHDF/FieldData/{word}"][number]:
                flags.RemoveArray(word)
