# SPDX-License-Identifier: BSD-3-Clause
"""Static poses of orthotropic solids on tetrahedral meshes.

    import orthostat
    result = orthostat.solve("tube.yaml")   # or a text, or a dict
    result.displacement                     # numpy's array on the library's memory

docs/python.md shows what there is. Functions and methods marked collective are called by all ranks, in the same order.
"""
from ._location import VERSION as __version__
from .case import Case, LoadCases, Scene, Sweep, solve, sweep
from .context import Context
from .errors import (CheckFailed, FileFailed, InvalidInput, LibraryFailed, LimitExceeded, NotConverged, OrthostatError,
                     OrthostatWarning, OutOfMemory)
from .material import Material
from .mesh import Mesh, MeshArrays, MeshFile
from .problem import Analysis, Path, Problem
from .result import Result, write_steps

__all__ = ["Analysis", "Case", "CheckFailed", "Context", "FileFailed", "InvalidInput", "LibraryFailed", "LimitExceeded",
           "LoadCases", "Material", "Mesh", "MeshArrays", "MeshFile", "NotConverged", "OrthostatError", "OrthostatWarning",
           "OutOfMemory", "Path", "Problem", "Result", "Scene", "Sweep", "solve", "sweep",
           "write_steps"]
