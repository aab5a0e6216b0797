#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/render draws a result with no display, and says what is wrong when it cannot."""
import os
import runpy
import subprocess
import sys
import tempfile
import unittest
from types import SimpleNamespace
from unittest import mock

import numpy
from matplotlib.image import imread
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_QUADRATIC_TETRA, VTK_TETRA, vtkPolyData, vtkUnstructuredGrid

RENDER = os.path.join(os.environ["ORTHOSTAT_SOURCE"], "scripts", "render")
sys.path.insert(0, os.path.dirname(RENDER))
from rendering.bodies import choose_scale, keeps_lengths, shade_of  # noqa: E402
from rendering.fields import average, axes_of, part_of  # noqa: E402
from rendering.marks import dashes, gather_loads, make_cells, make_points  # noqa: E402
from rendering.results import each_step  # noqa: E402
from rendering.section import choose_section  # noqa: E402
from rendering.shape import surface_of  # noqa: E402
from rendering.view import load_arrows  # noqa: E402


class Render(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.result = os.path.join(cls.folder.name, "tube.vtkhdf")
        program = os.path.join(os.environ["ORTHOSTAT_TEST_BIN"], "formats_mpi_test_vtkhdf")
        subprocess.run([os.environ["ORTHOSTAT_MPIEXEC"], "-n", "2", program], cwd=cls.folder.name, check=True,
                       env={**os.environ, "ORTHOSTAT_WRITE_TO": cls.result}, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def render(self, *arguments):
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        return subprocess.run([RENDER, *arguments], env=environment, capture_output=True, text=True, timeout=120)

    def refusal(self, *arguments):
        """In this process, which has loaded VTK."""
        with mock.patch.object(sys, "argv", [RENDER, *arguments]), self.assertRaises(SystemExit) as end:
            runpy.run_path(RENDER, run_name="__main__")
        return end.exception.code

    def test_a_picture_of_the_size_asked_for_shows_shape_and_section(self):
        picture = os.path.join(self.folder.name, "picture.png")
        done = self.render(self.result, picture, "--size", "800x500", "--scale", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        # the largest displacement is 0.8 at mid height
        self.assertEqual(done.stdout, f"{picture}: largest |u| 0.8, drawn × 2\n")
        pixels = imread(picture)
        self.assertEqual(pixels.shape[:2], (500, 800))
        coloured = abs(pixels[80:420, :, 0] - pixels[80:420, :, 2]) > 0.1
        self.assertGreater(coloured[:, :300].mean(), 0.05)  # the shape
        self.assertGreater(coloured[:, 400:].mean(), 0.05)  # the section

    def test_several_results_share_one_picture(self):
        picture = os.path.join(self.folder.name, "several.png")
        done = self.render(self.result, "--size", "900x500", self.result, self.result, "--scale", "1", picture,
                           "--section", "y=5", "--labels", "a,b,c", "--columns", "3")
        self.assertEqual(done.returncode, 0, done.stderr)
        pixels = imread(picture)
        coloured = abs(pixels[110:390, :, 0] - pixels[110:390, :, 2]) > 0.1
        panels = [coloured[:, 300 * i:300 * (i + 1)] for i in range(3)]
        for panel in panels:
            self.assertGreater(panel[:150].mean(), 0.02)  # a shape
            self.assertGreater(panel[170:].mean(), 0.02)  # its section
            self.assertLess(abs(panel.mean() - panels[0].mean()), 0.01)

    def test_the_title_names_the_load_case(self):
        title_of = runpy.run_path(RENDER)["title_of"]
        self.assertEqual([title_of("shelf", results) for results in (["shelf.vtu"], ["t/shelf.vtkhdf:full"], ["a.vtu", "b.vtu"])],
                         ["shelf", "shelf, full", "shelf"])

    def test_von_mises_is_named_once(self):
        bodies = [SimpleNamespace(value=numpy.array([0.0, 1.0]), envelope=False)]
        for field, name in (("von_mises", "von Mises"), ("stress", "stress von Mises"), ("stress:mises", "stress von Mises"),
                            ("largest_von_mises", "largest von Mises"), ("material_stress:11", "material stress 11"),
                            ("principal_stress", "principal stress largest"), (None, "|u|")):
            self.assertEqual(shade_of(bodies, field).name, name)

    def test_parts_have_the_names_of_the_docs(self):
        for width, parts in ((6, {"stress": "xx yy zz xy yz zx", "material_stress": "11 22 33 12 23 31",
                                  "material_strain_tensor": "11 22 33 12 23 31"}),
                             (3, {"principal_stress": "largest middle least", "principal_direction_1": "x y z"})):
            for name, words in parts.items():
                found = [part_of("", numpy.arange(width, dtype=float)[None], name, part)[0] for part in words.split()]
                self.assertEqual(found, list(range(width)))
        with self.assertRaisesRegex(Exception, "has no part 'length'; it has largest, middle, least, 0 to 2"):
            part_of("", numpy.zeros((1, 3)), "principal_stress", "length")

    def test_a_case_is_solved_and_its_envelope_drawn_at_rest(self):
        picture, case = (os.path.join(self.folder.name, name) for name in ("case.png", "case.yaml"))
        with open(case, "w") as stream:
            stream.write("""mesh: {block: {size: [2, 1, 1], divisions: [2, 1, 1]}}
materials: [{region: all, youngs_modulus: [3, 2, 1], poissons_ratio: 0}]
constraints: [{on: {boundary: xmin}, displacement: [0, free, free]}, {on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]},
  {on: {nearest: [0, 1, 0]}, displacement: [0, free, 0]}]
loads: [{on: {boundary: xmax}, total_force: [0.03, 0, 0]}]
output: {fields: [displacement, load, reaction, material_stress]}
""")
        done = self.render(case, picture, "--size", "600x400", "--field", "material_stress:11")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, f"{picture}: largest |u| 0.02, drawn × 10\n")
        with open(case, "a") as stream:
            stream.write("cases: [{name: more, loads: [{on: {boundary: xmax}, total_force: [0.03, 0, 0]}]}]\n")
        subprocess.run([os.environ["ORTHOSTAT_PROGRAM"], "solve", case, "--set", "output.envelope=true", "--output",
                        os.path.join(self.folder.name, "both.vtkhdf")], check=True, capture_output=True)
        envelope = os.path.join(self.folder.name, "both_envelope.vtkhdf")
        done = self.render(envelope, picture, "--size", "600x400", "--scale", "5", "--field", "largest_von_mises")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, f"{picture}: largest |u| 0.04, drawn at rest\n")

    def test_colours_stand_for_the_field_asked_for(self):
        picture = os.path.join(self.folder.name, "field.png")
        pictures = []
        for field in ("displacement:length", "displacement:y", "tet"):
            done = self.render(self.result, picture, "--size", "800x500", "--scale", "2", "--field", field)
            self.assertEqual(done.returncode, 0, done.stderr)
            pictures.append(imread(picture)[80:420])
        self.assertGreater(abs(pictures[0] - pictures[1]).mean(), 0.005)
        self.assertGreater(abs(pictures[0] - pictures[2]).mean(), 0.005)
        self.assertIn("has no field 'stres'; it has displacement", self.refusal(self.result, picture, "--field", "stres"))
        self.assertIn("'displacement' has no part 'xx'; it has x, y, z, length",
                      self.refusal(self.result, picture, "--field", "displacement:xx"))

    def test_loads_that_lie_together_become_one_arrow(self):
        places = numpy.array([[0, 0, 0], [0.1, 0, 0], [5, 0, 0], [9, 9, 9], [9, 8, 9], [9, 9, 8], [8, 9, 9]], float)
        load = numpy.array([[1, 0, 0], [3, 0, 0], [0, 2, 0]] + 4 * [[0, 0, 0]], float)
        (starts, sums), (turned, _) = gather_loads(places, places, load, 1.0)
        self.assertEqual(len(turned), 0)
        numpy.testing.assert_allclose(starts, [[0.075, 0, 0], [5, 0, 0]])  # two become one, nearer to the larger
        numpy.testing.assert_allclose(sums, [[4, 0, 0], [0, 2, 0]])
        (_, sums), _ = gather_loads(places, places, numpy.tile([0.0, 0, -1], (7, 1)), 1.0)
        numpy.testing.assert_allclose(sums, [[0, 0, -7]])  # a weight is one arrow

    def test_loads_that_cancel_are_a_moment_or_nothing(self):
        end = numpy.array([[0, y, z] for y in (-1, 1) for z in (-1, 1)] + 6 * [[40, 0, 0]], float)
        torque = numpy.array([[0, -z, y] for _, y, z in end])
        (starts, _), (turned, moments) = gather_loads(end, end, torque, 5.0)
        self.assertEqual(len(starts), 0)
        numpy.testing.assert_allclose(turned, [[0, 0, 0]])
        numpy.testing.assert_allclose(moments, [[8, 0, 0]])
        for found, _ in gather_loads(end, end, numpy.array([[0, y, z] for _, y, z in end]), 5.0):  # pulled apart
            self.assertEqual(len(found), 0)

    def test_every_body_shows_its_loads(self):
        rest = numpy.array([[0, 0, 0], [10, 0, 0], [0, 1, 0], [0, 0, 1]], float)
        bodies = [SimpleNamespace(rest=rest, moved=rest, load=size * numpy.eye(4, 3, 1)) for size in (1e-3, 2.0, 4.0)]
        forces, moments = load_arrows(bodies)
        longest = [numpy.linalg.norm(forces[i][1], axis=1).max() for i in range(3)]
        numpy.testing.assert_allclose(numpy.array(longest) / longest[2], [1 / 3, 1 / 2, 1])
        self.assertEqual(moments, {})

    def test_large_rotations_are_drawn_as_they_are(self):
        grid = vtkUnstructuredGrid()
        rest = numpy.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        grid.SetCells(VTK_TETRA, make_cells(numpy.arange(4)[None]))
        body = SimpleNamespace(grid=grid, rest=rest)
        turn = numpy.array([[-1.0, -1, 0], [1, -1, 0], [0, 0, 0]])  # by 90 degrees about z, less the identity
        self.assertTrue(keeps_lengths(body, rest @ turn.T))
        self.assertFalse(keeps_lengths(body, 0.7 * rest @ turn.T))
        self.assertEqual([choose_scale("auto", 0.7, 1.0, kept) for kept in (True, False)], [1.0, 0.2])

    def test_load_factors_of_tets_that_do_not_fail_are_left_out(self):
        shade = shade_of([SimpleNamespace(value=numpy.array([2.0, 5.0, 1e9]), envelope=False)], "tsai_wu_load_factor")
        self.assertEqual((shade.low, shade.high, shade.beyond), (0.0, 20.0, True))
        grid = vtkUnstructuredGrid()
        grid.SetPoints(make_points(numpy.arange(15.0).reshape(5, 3)))
        grid.SetCells(VTK_TETRA, make_cells(numpy.array([[0, 1, 2, 3], [1, 2, 3, 4]])))
        found = average(grid, numpy.arange(5), numpy.array([3.0, 1e9]), True)
        numpy.testing.assert_allclose(found, [3, 3, 3, 3, 1e9])

    def test_a_section_through_the_origin_is_at_zero(self):
        for low, high, middle in ((-1.0, 1.0 - 1e-13, 0.0), (-1.0, 2.0, 0.5)):
            rest = numpy.array([[low, 0, 0], [high, 0.1, 0.1]])
            body = SimpleNamespace(rest=rest, moved=rest)
            self.assertEqual(choose_section("auto", body).value, middle)

    def test_fibres_lie_on_the_surface_and_turn_with_the_body(self):
        surface = vtkPolyData()
        surface.SetPoints(make_points(numpy.array([[0.0, 0, 0], [3, 0, 0], [0, 3, 0]])))
        surface.SetPolys(make_cells(numpy.array([[0, 1, 2]])))
        cell = numpy_to_vtk(numpy.array([1]), deep=True)
        cell.SetName("cell")
        surface.GetCellData().AddArray(cell)
        axes = numpy.array([[9.0, 9, 9], [0.6, 0, 0.8]])
        quarter = numpy.array([[[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]])
        actor = dashes(surface, axes, lambda cells: numpy.repeat(quarter, len(cells), axis=0), 10.0, 1.0)
        ends = vtk_to_numpy(actor.GetMapper().GetInput().GetPoints().GetData())
        numpy.testing.assert_allclose(ends.mean(axis=0), [1, 1, 0.5], atol=1e-6)  # a little above its triangle
        numpy.testing.assert_allclose(ends[1] - ends[0], [0, 4.8, 0], atol=1e-6)  # of 0.8 × 10 what lies in its plane

    def test_triangles_of_a_surface_know_their_tet(self):
        corners = numpy.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        middles = [(corners[a] + corners[b]) / 2 for a, b in ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))]
        for kind, places in ((VTK_TETRA, corners), (VTK_QUADRATIC_TETRA, numpy.vstack([corners, middles]))):
            grid = vtkUnstructuredGrid()  # three tets apart, ten along x
            grid.SetPoints(make_points(numpy.vstack([places + [10 * tet, 0, 0] for tet in range(3)])))
            grid.SetCells(kind, make_cells(numpy.arange(3 * len(places)).reshape(3, -1)))
            surface = surface_of(grid)
            first = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)[:, 0]
            tet = numpy.floor(vtk_to_numpy(surface.GetPoints().GetData())[first, 0] / 10)
            numpy.testing.assert_array_equal(vtk_to_numpy(surface.GetCellData().GetArray("cell")), tet)

    def test_one_axis_is_enough_for_fibres(self):
        data = vtkUnstructuredGrid().GetCellData()
        self.assertIsNone(axes_of(data))
        one = numpy_to_vtk(numpy.array([[0.0, 0, 1], [0, 1, 0]]), deep=True)
        one.SetName("e3")
        data.AddArray(one)
        numpy.testing.assert_array_equal(axes_of(data)[:, 2], [[0, 0, 1], [0, 1, 0]])
        self.assertTrue(numpy.isnan(axes_of(data)[:, :2]).all())
        self.assertIn("output: {fields: [e1]}, or [axes]", self.refusal(self.result, "--fibres", "e1"))

    def test_a_list_stands_for_its_files(self):
        pvd, series = (os.path.join(self.folder.name, name) for name in ("all.pvd", "all.hdf.series"))
        with open(pvd, "w") as stream:
            stream.write('<VTKFile type="Collection"><Collection><DataSet timestep="1" file="a.vtu"/>'
                         '<DataSet timestep="2" file="b.vtu"/></Collection></VTKFile>')
        with open(series, "w") as stream:
            stream.write('{"file-series-version": "1.0", "files": [{"name": "a.hdf", "time": 1}]}')
        self.assertEqual(each_step(pvd), [os.path.join(self.folder.name, name) for name in ("a.vtu", "b.vtu")])
        self.assertEqual(each_step(series), [os.path.join(self.folder.name, "a.hdf")])
        with open(pvd, "w") as stream:
            stream.write("no list")
        self.assertIn("cannot be read as a list of results", self.refusal(pvd))

    def test_a_section_is_found_through_what_has_swung_away(self):
        rest = numpy.array([[0.0, 0, 0], [10, 0, 0], [0, 1, 0]])
        swung = numpy.array([[0.0, 0, 0], [3, 0, -9], [0, 1, 0]])
        self.assertEqual(choose_section("auto", SimpleNamespace(rest=rest, moved=rest)), (0, 5))
        self.assertEqual(choose_section("auto", SimpleNamespace(rest=rest, moved=swung)), (2, -4.5))
        done = self.render(self.result, os.path.join(self.folder.name, "alone.png"), "--section", "none")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_cannot_be_drawn_is_refused_in_words(self):
        self.assertIn("no such file", self.refusal("nothing.vtkhdf"))
        self.assertIn("not a VTKHDF file", self.refusal(__file__))
        done = self.render(self.result, "--section", "y=11")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn("misses the deformed body", done.stderr)
        self.assertIn("expected an axis and where", self.refusal(self.result, "--section", "w=1"))


if __name__ == "__main__":
    sys.exit(not unittest.main(exit=False).result.wasSuccessful())
