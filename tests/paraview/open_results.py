"""Run by scripts/test-paraview in ParaView's own Python: it opens results by their endings alone, and shows what is in them."""
import os
import sys

from paraview import servermanager
from paraview.simple import ExtractSurface, GetParaViewVersion, OpenDataFile, VTKHDFReader

folder = sys.argv[1]
SURFACE = 2 * 2 * (6 * 2 + 6 * 2 + 2 * 2)


def check(condition, message):
    if not condition:
        sys.exit(f"FAILED: {message}")


def look(name):
    source = OpenDataFile(os.path.join(folder, name))
    check(source is not None, f"{name} does not open")
    source.UpdatePipeline()
    return source


def names(information):
    return {information.GetArray(i).Name for i in range(len(information))}


single = None
for name in "one.vtu", "three.vtu", "three.pvtu", "one.hdf", "three.hdf":
    source = look(name)
    grid = source.GetDataInformation()
    single = single or grid.GetNumberOfPoints()
    check(grid.GetNumberOfCells() == 6 * 6 * 2 * 2, f"{name}: {grid.GetNumberOfCells()} cells")
    check({"displacement", "vertex"} <= names(source.PointData), f"{name}: {names(source.PointData)}")
    check({"stress", "von_mises", "e1", "region", "tet"} <= names(source.CellData), f"{name}: {names(source.CellData)}")
    if name.endswith("vtu"):
        check(source.CellData["stress"].GetComponentName(5) == "zx", f"{name}: {source.CellData['stress'].GetComponentName(5)}")
    if name != "three.hdf":
        check(grid.GetNumberOfPoints() == single, f"{name}: {grid.GetNumberOfPoints()} points, not {single}")
        surface = ExtractSurface(source)
        surface.NonlinearSubdivisionLevel = 0
        surface.UpdatePipeline()
        faces = surface.GetDataInformation().GetNumberOfCells()
        check(faces == SURFACE, f"{name}: {faces} faces are drawn, not {SURFACE}")

for name in "steps.pvd", "steps.hdf.series":
    source = look(name)
    check(list(source.TimestepValues) == [0.5, 1.0], f"{name}: times {list(source.TimestepValues)}")
    source.UpdatePipeline(0.5)
    half = source.PointData["displacement"].GetRange(-1)[1]
    source.UpdatePipeline(1.0)
    check(abs(source.PointData["displacement"].GetRange(-1)[1] - 2 * half) < 1e-6 * half, f"{name}: the steps do not differ")

# 5.11 knows no steps: of a file with some it shows the first, that of the case `weight`, if it is told the reader.
source = VTKHDFReader(FileName=os.path.join(folder, "cases.vtkhdf"))
source.UpdatePipeline()
check(source.GetDataInformation().GetNumberOfCells() == 6 * 6 * 2 * 2, "cases.vtkhdf: the mesh")
check("displacement" in names(source.PointData), f"cases.vtkhdf: {names(source.PointData)}")

print(f"ParaView {GetParaViewVersion().major}.{GetParaViewVersion().minor} opens every form of a result")
