# SPDX-License-Identifier: BSD-3-Clause
"""Answers."""
import os

import numpy

from ._declarations import FIELDS
from ._library import ffi, lib, pointer_to, struct, text_of, view


def bits_of(fields, default):
    """Fields by their words in a case's `output` ("stress", "error", …), or "all"; None: the default."""
    if fields is None:
        return default
    words = FIELDS if fields == "all" else [fields] if isinstance(fields, str) else fields
    unknown = [word for word in words if word not in FIELDS]
    if unknown:
        raise ValueError(f"fields: '{unknown[0]}' is none of {', '.join(FIELDS)}")
    return sum(1 << FIELDS[word] for word in set(words))


class Result:
    """One rank's piece of an answer. Arrays are the library's, without copies and not to be written to; each keeps the
    answer alive. Symmetric tensors are 11 22 33 12 23 31 in world axes. None: the field was not asked for."""

    def __init__(self, pointer, owner, mesh, scene=None, step=None):
        self.pointer, self.owner, self.mesh, self.scene = pointer, owner, mesh, scene
        self.step = step    # of a path
        self.levels = None  # of a mesh that was refined to an accuracy
        self._watched = None
        self.context = mesh.context

    def _view(self, pointer, *shape):
        return view(pointer, shape, self.owner)

    @property
    def displacement(self):
        """(node_count, 3)"""
        return self._view(lib.ost_result_displacement(self.pointer), self.mesh.node_count, 3)

    @property
    def reaction(self):
        """(node_count, 3), 0 where nothing constrains"""
        return self._view(lib.ost_result_reaction(self.pointer), self.mesh.node_count, 3)

    @property
    def load(self):
        """(owned_nodes, 3): the forces on the nodes"""
        return self._view(lib.ost_result_load(self.pointer), self.mesh.owned_nodes, 3)

    @property
    def stress(self):
        """(owned_tets, 6): the mean over each tet"""
        return self._view(lib.ost_result_stress(self.pointer), self.mesh.owned_tets, 6)

    @property
    def strain(self):
        """(owned_tets, 6): the mean over each tet, shear doubled: 2e12, 2e23, 2e31"""
        return self._view(lib.ost_result_strain(self.pointer), self.mesh.owned_tets, 6)

    @property
    def node_stress(self):
        """(node_count, 6)"""
        return self._view(lib.ost_result_node_stress(self.pointer), self.mesh.node_count, 6)

    @property
    def strain_energy_density(self):
        """(owned_tets,)"""
        return self._view(lib.ost_result_strain_energy_density(self.pointer), self.mesh.owned_tets)

    @property
    def tet_error(self):
        """(owned_tets,): each one's error in the norm of the energy; their squares add up to that of error.energy_norm"""
        return self._view(lib.ost_result_tet_error(self.pointer), self.mesh.owned_tets)

    def field(self, word):
        """Collective. Any field of docs/output.md, as the file has it, those that follow from others among them
        ("von_mises", "principal_stress", "strain_tensor", …). On nodes (node_count) or on tets (owned_tets); None where
        there is nothing that it could be made of."""
        if word not in FIELDS:
            raise ValueError(f"field: '{word}' is none of {', '.join(FIELDS)}")
        found = ffi.new("OstFieldValues *")
        self.context.check(lib.ost_result_field(self.pointer, FIELDS[word], found))
        if found.values == ffi.NULL:
            return None
        owner = self.owner
        if found.is_made:
            owner = self.context.handle_of(found.values, lambda box: lib.ost_free_memory(box[0]), self.owner)
        shape = {1: (), 9: (3, 3)}.get(found.components, (found.components,))
        return view(ffi.cast("int32_t *" if found.is_integer else "double *", found.values), (found.rows, *shape), owner)

    # --- the whole body ---

    @property
    def status(self):
        """"accepted", "unfinished" (the solver stopped early) or "refused" (a check failed)"""
        return text_of(lib.ost_result_status(self.pointer))

    @property
    def objections(self):
        """What speaks against the answer, in words."""
        count = lib.ost_result_objection_count(self.pointer)
        return [text_of(lib.ost_result_objection(self.pointer, i)) for i in range(count)]

    @property
    def largest_displacement(self):
        return lib.ost_result_largest_displacement(self.pointer, ffi.NULL)

    @property
    def largest_displacement_at(self):
        place = numpy.empty(3)
        lib.ost_result_largest_displacement(self.pointer, pointer_to(place))
        return place

    unknowns = property(lambda self: lib.ost_result_unknowns(self.pointer))
    checks = property(lambda self: struct(lib.ost_result_checks(self.pointer)[0]), doc="OstChecks of orthostat/result.h")
    solver = property(lambda self: struct(lib.ost_result_solve_report(self.pointer)[0]),
                      doc="OstSolveReport of orthostat/solver.h")
    newton = property(lambda self: struct(lib.ost_result_newton_report(self.pointer)[0]),
                      doc="OstNewtonReport of orthostat/result.h")
    error = property(lambda self: struct(lib.ost_result_answer_error(self.pointer)[0]),
                     doc="the estimated error that the mesh makes: OstAnswerError of orthostat/result.h")

    @property
    def failure(self):
        """The least load factors to failure: OstFailure of orthostat/result.h; None: no material has strengths, or
        none was asked for."""
        found = lib.ost_result_failure(self.pointer)[0]
        return struct(found) if found.known else None

    strain_energy = property(lambda self: lib.ost_result_checks(self.pointer).strain_energy)
    work = property(lambda self: lib.ost_result_checks(self.pointer).work)

    @property
    def iterations(self):
        """of the linear solver, over all of Newton's where rotations are large"""
        newton = lib.ost_result_newton_report(self.pointer)
        return newton.linear_iterations if newton.used else lib.ost_result_solve_report(self.pointer).iterations

    def find_watched(self):
        """Collective. Finds what `watch` gives; a solve that succeeds has done so."""
        self._watched = {}
        count = lib.ost_case_watch_count(self.scene.case.pointer) if self.scene else 0
        if count > 0:
            box = ffi.new("OstWatchedValue **")
            self.context.check(lib.ost_watch_evaluate_all(self.scene.pointer, self.pointer, box))
            for item in box[0][0:count]:
                self._watched[text_of(item.name)] = struct(item)
            lib.ost_free_memory(box[0])
        return self

    @property
    def watch(self):
        """The quantities that the case watches: {name: value, expected and error (nan: not known)}. Collective for the result
        of a failure."""
        return self._watched if self._watched is not None else self.find_watched()._watched

    def write(self, path, fields=None):
        """Collective. Writes the file of fields for ParaView (.vtkhdf, .hdf, .vtu, .pvtu): those of `fields` that the
        answer has, or that follow from them; None: what the case's `output` says."""
        self.context.check(lib.ost_result_write(self.pointer, bits_of(fields, self._default_fields()), os.fsencode(path)))

    def _default_fields(self):
        return lib.ost_case_output_fields(self.scene.case.pointer) if self.scene else lib.OST_FIELDS_BY_DEFAULT

    def __repr__(self):
        return (f"<orthostat.Result: {self.status}, {self.unknowns} unknowns, moves by {self.largest_displacement:.6g} at "
                f"most, {self.iterations} iterations>")


def write_steps(results, path, fields=None):
    """Collective. Writes several results on one mesh ({name: result}, as of load cases) as steps of one file, which ends
    with .vtkhdf; `fields` as for Result.write."""
    if not results:
        raise ValueError("write_steps: there is no result to write")
    one = next(iter(results.values()))
    box = one.context.box("OstStepsFile")
    one.context.check(lib.ost_steps_file_create(one.context.pointer, os.fsencode(path), len(results), box))
    try:
        for number, (name, result) in enumerate(results.items(), 1):
            result.context.check(lib.ost_result_write_step(result.pointer, bits_of(fields, result._default_fields()), box[0],
                                                           number, name.encode()))
    finally:
        status = lib.ost_steps_file_finish(box)
    one.context.check(status)
