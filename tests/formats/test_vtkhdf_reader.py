#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""VTK's own reader opens what Orthostat writes, whole and piece by piece.

The file is the tube of mpi_test_vtkhdf.c: 12 x 2 x 8 hexes of six tets, length 10, radii 0.9 to 1.5, with
displacement u_x = 0.8 sin(pi y / 10), stress component k of tet L = L + 0.1 k, and the rank of each tet."""
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOHDF import vtkHDFReader

AROUND, RADIAL, AXIAL = 12, 2, 8
NODES = AROUND * (RADIAL + 1) * (AXIAL + 1)
TETS = AROUND * RADIAL * AXIAL * 6
# a prism with a regular polygon's ring as base
VOLUME = 0.5 * AROUND * np.sin(2 * np.pi / AROUND) * (1.5**2 - 0.9**2) * 10.0


def write_tube(ranks, folder):
    path = os.path.join(folder, f"tube-{ranks}.vtkhdf")
    program = os.path.join(os.environ["ORTHOSTAT_TEST_BIN"], "formats_mpi_test_vtkhdf")
    command = [os.environ.get("ORTHOSTAT_MPIEXEC", "mpirun"), "-n", str(ranks), program]
    done = subprocess.run(command, cwd=folder, env={**os.environ, "ORTHOSTAT_WRITE_TO": path}, capture_output=True)
    if done.returncode != 0:
        raise RuntimeError(f"{program} failed:\n{done.stdout.decode()}\n{done.stderr.decode()}")
    return path


def read(path, piece=0, pieces=1):
    reader = vtkHDFReader()
    reader.SetFileName(path)
    if not reader.CanReadFile(path):
        raise RuntimeError(f"VTK cannot read {path}")
    reader.UpdateInformation()
    reader.UpdatePiece(piece, pieces, 0)
    return reader.GetOutput()


def array(data, name):
    found = data.GetArray(name)
    if found is None:
        raise KeyError(f"no array {name}")
    return vtk_to_numpy(found)


def volume(grid):
    size = vtkCellSizeFilter()
    size.SetInputData(grid)
    size.Update()
    return array(size.GetOutput().GetCellData(), "Volume").sum()


class Reader:
    """What must hold on any number of ranks."""

    ranks = 0

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = write_tube(cls.ranks, cls.folder.name)
        cls.grid = read(cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_tet_is_there_once(self):
        self.assertEqual(self.grid.GetNumberOfCells(), TETS)
        labels = array(self.grid.GetCellData(), "tet")
        self.assertTrue(np.array_equal(np.sort(labels), np.arange(1, TETS + 1)))
        self.assertEqual({self.grid.GetCellType(c) for c in range(TETS)}, {10})

    def test_every_vertex_is_there(self):
        labels = array(self.grid.GetPointData(), "vertex")
        self.assertTrue(np.array_equal(np.unique(labels), np.arange(1, NODES + 1)))
        if self.ranks == 1:
            self.assertEqual(self.grid.GetNumberOfPoints(), NODES)

    def test_vertices_lie_where_their_labels_say(self):
        place = vtk_to_numpy(self.grid.GetPoints().GetData())
        rest, i = np.divmod(array(self.grid.GetPointData(), "vertex") - 1, RADIAL + 1)
        k, j = np.divmod(rest, AROUND)
        r, angle = 0.9 + 0.6 * i / RADIAL, 2 * np.pi * j / AROUND
        expected = np.column_stack([r * np.cos(angle), 10.0 * k / AXIAL, r * np.sin(angle)])
        self.assertLess(np.abs(place - expected).max(), 1e-14 * 10)

    def test_the_volume_is_the_tubes(self):
        self.assertAlmostEqual(volume(self.grid), VOLUME, delta=1e-12 * VOLUME)

    def test_arrays_hold_what_was_written(self):
        place = vtk_to_numpy(self.grid.GetPoints().GetData())
        u = array(self.grid.GetPointData(), "displacement")
        self.assertEqual(u.shape, place.shape)
        self.assertLess(np.abs(u[:, 0] - 0.8 * np.sin(np.pi * place[:, 1] / 10)).max(), 1e-15)
        self.assertFalse(u[:, 1:].any())
        cells = self.grid.GetCellData()
        stress, label = array(cells, "stress"), array(cells, "tet")
        self.assertTrue(np.array_equal(stress, label[:, None] + 0.1 * np.arange(6)))
        self.assertEqual(sorted(np.unique(array(cells, "rank"))), list(range(self.ranks)))
        self.assertEqual(sorted(np.unique(array(cells, "region"))), [0, 1])

    def test_nothing_else_is_seen(self):
        points, cells = self.grid.GetPointData(), self.grid.GetCellData()
        names = lambda data: {data.GetArrayName(a) for a in range(data.GetNumberOfArrays())}
        self.assertEqual(names(points), {"vertex", "displacement"})
        self.assertEqual(names(cells), {"tet", "region", "stress", "rank"})
        self.assertEqual(self.grid.GetFieldData().GetNumberOfArrays(), 0)

    def test_pieces_can_be_read_one_by_one(self):
        pieces = [read(self.path, p, self.ranks) for p in range(self.ranks)]
        for p, piece in enumerate(pieces):
            self.assertEqual(set(array(piece.GetCellData(), "rank")), {p})
        labels = np.concatenate([array(piece.GetCellData(), "tet") for piece in pieces])
        self.assertTrue(np.array_equal(np.sort(labels), np.arange(1, TETS + 1)))
        self.assertAlmostEqual(sum(volume(piece) for piece in pieces), VOLUME, delta=1e-12 * VOLUME)


class OnOneRank(Reader, unittest.TestCase):
    ranks = 1


class OnThreeRanks(Reader, unittest.TestCase):
    ranks = 3


if __name__ == "__main__":
    sys.exit(not unittest.main(exit=False).result.wasSuccessful())
