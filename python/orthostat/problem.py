# SPDX-License-Identifier: BSD-3-Clause
"""The discrete problem, and what solves it."""
import os
import types

import numpy

from ._library import array, ffi, lib, pointer_to, struct, view
from .material import Material
from .result import Result, bits_of

_FORMULATIONS = {"linear": "OST_FORMULATION_LINEAR", "consistent": "OST_FORMULATION_CONSISTENT",
                 "classical": "OST_FORMULATION_CLASSICAL"}
_METHODS = {"auto": "OST_METHOD_AUTO", "plain": "OST_METHOD_PLAIN", "metric": "OST_METHOD_METRIC",
            "strong": "OST_METHOD_STRONG", "two_level": "OST_METHOD_TWO_LEVEL", "direct": "OST_METHOD_DIRECT"}

_NEARLY_INCOMPRESSIBLE = 0.45  # as in orthostat/field.h


def take_result(context, status, box, mesh, scene, *parents, step=None):
    """The result of a solve, or a failure that has it."""
    result = None
    if box[0]:
        result = Result(box[0], context.handle_of(box[0], lib.ost_result_destroy, mesh, scene, *parents), mesh, scene, step)
    context.check(status, result)
    return result.find_watched() if result else None


def axes_of(field, mesh):
    axes = numpy.empty((mesh.tet_count, 9))
    start = pointer_to(axes)
    for tet in range(mesh.tet_count):
        lib.ost_field_axes(field, tet, start + 9 * tet)
    return axes.reshape(-1, 3, 3)


class Problem:
    """The discrete problem on a mesh: energy, forces and stiffness as functions of the displacement.

    mesh: a Mesh.  material: a Material, or {region: Material}.
    axes: (3, 3) for all tets or (tet_count, 3, 3), rows e1 e2 e3; (tet_count, 4, 3, 3) at the vertices, between which they
    turn in quadratic tets; None: those of the mesh, or the world's.
    constraints: a list of (nodes, displacement) or (nodes, displacement, direction). Nodes: numbers or a mask of this
    rank's own. Displacement: (3,) or (nodes, 3), nan where free; with a direction a number, or one for each node.
    force: (owned_nodes, 3).  formulation: "linear", or "consistent" or "classical" for large rotations.
    mixed: quadratic tets of nearly incompressible materials have their pressure as an unknown; nu = 1/2 needs it.
    Scenes make problems too (Scene.problem).
    """

    def __init__(self, mesh, material, axes=None, constraints=(), force=None, formulation="linear", free_body=False,
                 mixed=False):
        field = _field(mesh, material, axes)
        if mixed:
            mesh.context.check(lib.ost_field_mixed(field.pointer, _NEARLY_INCOMPRESSIBLE, ffi.new("int *")))
        rows = _constraints(mesh, constraints)
        force = None if force is None else array(force, (mesh.owned_nodes, 3), "force")
        parts = ffi.new("OstProblemParts *", {
            "mesh": mesh.pointer, "field": field.pointer, "constraints": rows, "constraint_count": len(rows),
            "free_body": bool(free_body), "force": pointer_to(force), "formulation": _formulation(formulation)})
        box = mesh.context.box("OstProblem")
        mesh.context.check(lib.ost_problem_create(parts, box))
        self._take(box[0], mesh, field.pointer, None, field)

    def _take(self, pointer, mesh, field, scene, *parents):
        self.pointer, self.mesh, self.scene, self.context = pointer, mesh, scene, mesh.context
        self.owner = self.context.handle_of(pointer, lib.ost_problem_destroy, mesh, scene, *parents)
        self._field = field

    @classmethod
    def borrowed(cls, pointer, mesh, field, scene):
        problem = cls.__new__(cls)
        problem._take(pointer, mesh, field, scene)
        return problem

    is_linear = property(lambda self: bool(lib.ost_problem_is_linear(self.pointer)))

    @property
    def axes(self):
        """(tet_count, 3, 3), rows e1 e2 e3 (a copy)"""
        return axes_of(self._field, self.mesh)

    @property
    def formulation(self):
        number = lib.ost_problem_formulation(self.pointer)
        return next(word for word, name in _FORMULATIONS.items() if getattr(lib, name) == number)

    @formulation.setter
    def formulation(self, word):
        lib.ost_problem_set_formulation(self.pointer, _formulation(word))

    def set_load(self, force):
        """Puts another load, (owned_nodes, 3), in place of the one that grows with t."""
        force = array(force, (self.mesh.owned_nodes, 3), "force")
        lib.ost_problem_set_load(self.pointer, pointer_to(force))

    def _displacement(self, u):
        return None if u is None else array(u, (self.mesh.node_count, 3), "displacement")

    def load(self, u=None, t=1.0):
        """(owned_nodes, 3): the load at t, and at u where a pressure follows the surface"""
        force, u = numpy.empty((self.mesh.owned_nodes, 3)), self._displacement(u)
        lib.ost_problem_load(self.pointer, t, pointer_to(u), pointer_to(force))
        return force

    def internal_force(self, u, t=1.0):
        """(owned_nodes, 3): the gradient of the energy by u (node_count, 3)"""
        force, u = numpy.empty((self.mesh.owned_nodes, 3)), self._displacement(u)
        self.context.check(lib.ost_problem_force(self.pointer, t, pointer_to(u), pointer_to(force)))
        return force

    def energy(self, u, t=1.0):
        """Collective. The strain energy of the body under u (node_count, 3)."""
        energy, u = ffi.new("double *"), self._displacement(u)
        self.context.check(lib.ost_problem_energy(self.pointer, t, pointer_to(u), energy))
        return energy[0]

    def stiffness(self, u=None, t=0.0, definite=False):
        """Collective. This rank's rows by 3×3 blocks: row_start, column, value (…, 3, 3), node (the local node of each row
        and ghost column), without copies: scipy.sparse.bsr_array((k.value, k.column, k.row_start)) takes them as they
        are. Values change with the next call."""
        found, u = ffi.new("OstStiffness *"), self._displacement(u)
        fill = lib.ost_problem_definite_stiffness if definite else lib.ost_problem_stiffness
        self.context.check(fill(self.pointer, t, pointer_to(u), found))
        start = view(found.row_start, (found.rows + 1,), self.owner)
        return types.SimpleNamespace(rows=found.rows, columns=found.columns, global_rows=found.global_rows, row_start=start,
                                     column=view(found.column, (start[-1],), self.owner),
                                     value=view(found.value, (start[-1], 3, 3), self.owner),
                                     node=view(found.node, (found.columns,), self.owner))

    def worst_tet(self, u):
        """Collective. The most compressed tet (OstWorstTet of orthostat/problem.h)."""
        found, u = ffi.new("OstWorstTet *"), self._displacement(u)
        self.context.check(lib.ost_problem_worst_tet(self.pointer, pointer_to(u), found))
        return struct(found[0])

    def analysis(self, **options):
        """Collective. For many loads; options are those of OstSolverOptions (orthostat/solver.h)."""
        return Analysis(self, **options)


class _Field:
    def __init__(self, pointer, mesh):
        self.pointer = pointer
        self.owner = mesh.context.handle_of(pointer, lib.ost_field_destroy, mesh)


def _formulation(word):
    if word not in _FORMULATIONS:
        raise ValueError(f"formulation: '{word}' is none of {', '.join(_FORMULATIONS)}")
    return getattr(lib, _FORMULATIONS[word])


def _field(mesh, material, axes):
    names = mesh.region_names
    of_region = {name: material for name in names} if isinstance(material, Material) else material
    missing = [name for name in names if name not in of_region]
    if missing:
        raise ValueError(f"material: none for region '{missing[0]}'; regions are: {', '.join(names)}")
    materials = ffi.new("OstMaterial[]", len(names))
    specs = ffi.new("OstAxesSpec[]", len(names))
    axes = mesh.axes if axes is None else axes
    given = None
    at_vertices = None
    if numpy.ndim(axes) == 4:
        at_vertices = array(axes, (mesh.tet_count, 4, 3, 3), "axes")
        given = numpy.ascontiguousarray(at_vertices[:, 0])
    elif axes is not None:
        given = array(numpy.broadcast_to(axes, (mesh.tet_count, 3, 3)) if numpy.ndim(axes) == 2 else axes,
                      (mesh.tet_count, 3, 3), "axes")
    for number, name in enumerate(names):
        materials[number] = of_region[name].struct[0]
        specs[number].kind = lib.OST_AXES_NONE if given is None else lib.OST_AXES_CELLS
    box = mesh.context.box("OstMaterialField")
    mesh.context.check(lib.ost_field_create_on(mesh.pointer, materials, specs, pointer_to(given), box))
    field = _Field(box[0], mesh)
    if at_vertices is not None:
        mesh.context.check(lib.ost_field_set_vertex_axes(field.pointer, mesh.tet_count, pointer_to(at_vertices)))
    return field


def _constraints(mesh, constraints):
    """Rows of OstNodeConstraint, filled column by column."""
    parts = [_constraint(mesh, *constraint) for constraint in constraints]
    nodes, directions, values = (numpy.concatenate(column) for column in zip(*parts)) if parts else ((), (), ())
    rows = ffi.new("OstNodeConstraint[]", len(nodes))
    kind = numpy.dtype({"names": ["node", "direction", "displacement"], "formats": [numpy.int32, (float, 3), float],
                        "offsets": [ffi.offsetof("OstNodeConstraint", name) for name in ("node", "direction", "displacement")],
                        "itemsize": ffi.sizeof("OstNodeConstraint")})
    if len(rows):
        table = numpy.frombuffer(ffi.buffer(rows), kind)
        table["node"], table["direction"], table["displacement"] = nodes, directions, values
    return rows


def _constraint(mesh, nodes, displacement, direction=None):
    nodes = numpy.asarray(nodes)
    if nodes.dtype == bool and nodes.shape not in ((mesh.owned_nodes,), (mesh.node_count,)):
        raise ValueError(f"constraints: a mask has an entry for each of the {mesh.owned_nodes} nodes of this rank's own, and "
                         f"this is of shape {nodes.shape}")
    nodes = numpy.flatnonzero(nodes) if nodes.dtype == bool else array(nodes, (None,), "constraints: nodes", numpy.int64)
    wrong = nodes[(nodes < 0) | (nodes >= mesh.node_count)]
    if len(wrong):
        raise ValueError(f"constraints: there is no node {wrong[0]}; this rank's are 0 to {mesh.node_count - 1}")
    own = nodes < mesh.owned_nodes  # ghosts are another rank's
    if direction is not None:
        directions = numpy.broadcast_to(numpy.asarray(direction, float), (len(nodes), 3))
        return nodes[own], directions[own], numpy.broadcast_to(numpy.asarray(displacement, float), (len(nodes),))[own]
    values = numpy.broadcast_to(numpy.asarray(displacement, float), (len(nodes), 3))
    node, component = numpy.nonzero(~numpy.isnan(values) & own[:, None])
    return nodes[node], numpy.eye(3)[component], values[node, component]


def _options(default, given):
    options = ffi.new("OstSolverOptions *", default)
    names = {name for name, _ in ffi.typeof("OstSolverOptions").fields}
    for name, value in given.items():
        if name not in names:
            raise ValueError(f"'{name}' is no option of the solver; there are: {', '.join(sorted(names))}")
        if name == "method" and value not in _METHODS:
            raise ValueError(f"method: '{value}' is none of {', '.join(_METHODS)}")
        setattr(options, name, getattr(lib, _METHODS[value]) if name == "method" else value)
    return options


class Analysis:
    """A problem with its solver, for as many loads as there are: stiffness and hierarchy or factors are made once."""

    def __init__(self, problem, **options):
        self.problem, self.context = problem, problem.context
        scene = problem.scene
        default = lib.ost_case_solver_options(scene.case.pointer)[0] if scene else lib.ost_solver_default_options()
        self._fields = lib.ost_case_output_fields(scene.case.pointer) if scene else lib.OST_FIELDS_BY_DEFAULT
        box = self.context.box("OstAnalysis")
        self.context.check(lib.ost_analysis_create(problem.pointer, _options(default, options), box))
        self.pointer, self.owner = box[0], self.context.handle_of(box[0], lib.ost_analysis_destroy, problem)

    def solve(self, force=None, fields=None):
        """Collective. The answer to a load, (owned_nodes, 3), or to the one that the problem has.

        fields: what to compute beside the displacement, by their words in a case's `output`; () for none, None for those
        of the case. "error" estimates the error of the answer.
        """
        if force is not None:
            self.problem.set_load(force)
        box = self.context.box("OstResult")
        bits = bits_of(fields, self._fields)
        status = lib.ost_analysis_solve(self.pointer, bits, box)
        return take_result(self.context, status, box, self.problem.mesh, self.problem.scene, self.problem)


class Path:
    """A path through pseudo-times: `for result in path` takes one step after another; result.step is OstPathStep of
    orthostat/path.h."""

    def __init__(self, pointer, mesh, scene):
        self.pointer, self.mesh, self.scene, self.context = pointer, mesh, scene, mesh.context
        self.owner = self.context.handle_of(pointer, lib.ost_path_destroy, scene)
        self._fields = lib.ost_case_output_fields(scene.case.pointer)

    def __len__(self):
        return lib.ost_path_count(self.pointer)

    done = property(lambda self: lib.ost_path_done(self.pointer), doc="steps taken")

    def advance(self, fields=None):
        """Collective. Takes the next step."""
        box = self.context.box("OstResult")
        status = lib.ost_path_advance(self.pointer, bits_of(fields, self._fields), box)
        step = None if status else struct(lib.ost_path_step(self.pointer, self.done - 1)[0])
        return take_result(self.context, status, box, self.mesh, self.scene, self, step=step)

    def __iter__(self):
        while self.done < len(self):
            yield self.advance()

    def save(self, file):
        """Collective. Writes a checkpoint."""
        self.context.check(lib.ost_path_save(self.pointer, os.fsencode(file)))

    def resume(self, file):
        """Collective. Goes on from a checkpoint, if there is one."""
        self.context.check(lib.ost_path_resume(self.pointer, os.fsencode(file)))
