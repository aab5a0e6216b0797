# SPDX-License-Identifier: BSD-3-Clause
"""Cases, and the scenes they make."""
import itertools
import json
import math
import os
import re
from functools import partial

import numpy

from ._library import ffi, lib, struct, text_of
from .context import context_of
from .errors import NotConverged, OrthostatError
from .mesh import Mesh
from .problem import Analysis, Path, Problem, axes_of, take_result
from .result import Result


_MAY_BE_FREE = ("displacement", "rotation")

# What PyYAML, which is of YAML 1.1, leaves a text: 1e6, 1.5e-3; and the keys that it takes for truth values.
_NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_TRUTH = {True: "on", False: "off"}


def _plain(value, key=None):
    """What json knows, for numpy's arrays and numbers, and paths; in lists None is the case's `free`, and so is nan in
    those of displacements: elsewhere it is a mistake, which the case's reader names."""
    if isinstance(value, (numpy.ndarray, numpy.generic)):
        value = value.tolist()
    if isinstance(value, dict):
        return {_TRUTH[name] if isinstance(name, bool) else name: _plain(item, name) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return ["free" if item is None or (item != item and key in _MAY_BE_FREE) else _plain(item, key) for item in value]
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def _written(value):
    """What _plain makes as the case's text, in which numbers have no quotes."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(str(name))}: {_written(item)}" for name, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_written, value)) + "]"
    return value if isinstance(value, str) and _NUMBER.fullmatch(value) else json.dumps(value)


def _text_of(sections):
    """A dict as the text of a case, a line for each section: messages name the line."""
    return "{" + ",\n".join(f"{json.dumps(key)}: {_written(value)}" for key, value in _plain(sections).items()) + "\n}\n"


def _value(value):
    """A value of a setting as the case's text."""
    value = _plain(value)
    return value if isinstance(value, str) else "free" if value is None else _written(value)


class Case:
    """A case, read from a file, from text, or from a dict of the same keys.

    source: a path; a text (a str with a line break or ": "); or a dict, in which arrays of numpy may stand for lists,
    and None for the case's word `free`.
    settings: {key: value}, changes as by the program's --set KEY=VALUE.
    name: what messages call a text or a dict; files that it names are relative to the folder of this name.
    swept: of a sweep: two settings of one value are refused, where else the last counts.
    """

    def __init__(self, source, name="case", comm=None, settings=None, swept=False):
        self.context = context_of(comm)
        box = self.context.box("OstCase")
        source = _text_of(source) if isinstance(source, dict) else source.decode() if isinstance(source, bytes) else source
        texts = [ffi.new("char[]", f"{key}={_value(value)}".encode()) for key, value in (settings or {}).items()]
        if isinstance(source, str) and ("\n" in source or ": " in source):
            parse = lib.ost_case_parse_swept if swept else lib.ost_case_parse_with
            status = parse(self.context.pointer, os.fspath(name).encode(), source.encode(), len(texts), texts, box)
        else:
            read = lib.ost_case_read_swept if swept else lib.ost_case_read_with
            status = read(self.context.pointer, os.fsencode(source), len(texts), texts, box)
        self.context.check(status)
        self.pointer, self.owner = box[0], self.context.handle_of(box[0], lib.ost_case_destroy)

    @classmethod
    def borrowed(cls, context, pointer, owner):
        """A load case, which `owner` keeps."""
        case = cls.__new__(cls)
        case.context, case.pointer, case.owner = context, pointer, owner
        return case

    title = property(lambda self: text_of(lib.ost_case_title(self.pointer)))
    output_file = property(lambda self: text_of(lib.ost_case_output_file(self.pointer)), doc="None: the case names none")
    has_path = property(lambda self: bool(lib.ost_case_has_path(self.pointer)))
    asks_error = property(lambda self: bool(lib.ost_case_asks_error(self.pointer)), doc="is an accuracy asked for?")

    def __repr__(self):
        return f"<orthostat.Case: {self.title}>"

    @property
    def load_cases(self):
        """{name: Case}: the load cases (`cases`), each with what is stated for all."""
        return {text_of(lib.ost_case_load_case_name(self.pointer, i)):
                Case.borrowed(self.context, lib.ost_case_load_case(self.pointer, i), self.owner)
                for i in range(lib.ost_case_load_case_count(self.pointer))}

    def scene(self, mesh=None):
        """Collective. Mesh, materials and axes made; `mesh`: MeshArrays in place of the case's own."""
        return Scene(self, mesh)

    def solve(self, mesh=None, max_seconds=math.inf, max_bytes=math.inf):
        """Collective. Solves as `orthostat solve` does: where the case asks for an accuracy the mesh is refined until it
        is met or a limit is in the way (NotConverged, with the result); a path is gone to its end. Where there are load
        cases the answer is {name: Result}; one that fails keeps no other from being solved, and is raised at the end,
        with those of the others as `error.result`."""
        load_cases = self.load_cases
        if load_cases and self.asks_error and mesh is None:
            return _solve_all((name, partial(case.solve, None, max_seconds, max_bytes)) for name, case in load_cases.items())
        if load_cases:
            cases = self.scene(mesh).load_cases()
            found = _solve_all((cases.next_name, partial(next, cases)) for _ in load_cases)
            return {name: found[name] for name in load_cases}
        if self.asks_error and not self.has_path and mesh is None:
            return _adapt(self, max_seconds, max_bytes)
        return self.scene(mesh).solve()


class Scene:
    """A case made concrete on this rank: its piece of the mesh, its materials and axes."""

    def __init__(self, case, mesh=None):
        context, box = case.context, case.context.box("OstScene")
        if mesh is None:
            status = lib.ost_scene_create(case.pointer, box)
        else:
            chunk = mesh.chunk(context)
            status = lib.ost_scene_create_on(case.pointer, chunk, box)
        context.check(status)
        self._take(case, box[0], context.handle_of(box[0], lib.ost_scene_destroy, case))
        context.check(lib.ost_watch_check(self.pointer))

    def _take(self, case, pointer, owner):
        self.case, self.pointer, self.owner, self.context = case, pointer, owner, case.context
        self.mesh = Mesh.borrowed(self.context, lib.ost_scene_mesh(pointer), owner)

    @classmethod
    def borrowed(cls, case, pointer, owner):
        scene = cls.__new__(cls)
        scene._take(case, pointer, owner)
        return scene

    @property
    def axes(self):
        """(tet_count, 3, 3), rows e1 e2 e3: the material axes of each tet (a copy)."""
        return axes_of(lib.ost_scene_field(self.pointer), self.mesh)

    def check(self):
        """Collective. A dry run: all that is checked before a solver is built."""
        self.context.check(lib.ost_scene_dry_run(self.pointer))

    def solve(self):
        """Collective. Solves once, in the least memory; where the case has a path, the answer is that at its end."""
        box = self.context.box("OstResult")
        return take_result(self.context, lib.ost_scene_solve(self.pointer, box), box, self.mesh, self)

    def problem(self):
        """Collective. Supports and loads of the case as a problem, for loads of your own, energies, forces, stiffness:
        with large_rotation "on" those of large rotations, with "auto" those of linear theory until it is solved."""
        box = self.context.box("OstProblem")
        self.context.check(lib.ost_scene_problem(self.pointer, box))
        if lib.ost_scene_formulation(self.pointer) != lib.OST_FORMULATION_LINEAR:
            lib.ost_problem_set_formulation(box[0], lib.ost_scene_formulation(self.pointer))
        return Problem.borrowed(box[0], self.mesh, lib.ost_scene_field(self.pointer), self)

    def analysis(self):
        """Collective. For many loads: what does not depend on the load is made once."""
        return Analysis(self.problem())

    def load_cases(self):
        """Collective. The case's load cases, to be solved one after another."""
        return LoadCases(self)

    def path(self):
        """Collective. The case's path, step by step."""
        box = self.context.box("OstPath")
        self.context.check(lib.ost_scene_path(self.pointer, box))
        return Path(box[0], self.mesh, self)


class LoadCases:
    """The load cases of a scene: `for result in cases` solves one after another; next_name names the next. Those
    with the same supports share stiffness and hierarchy, and follow each other."""

    def __init__(self, scene):
        self.scene, self.context = scene, scene.context
        box = self.context.box("OstLoadCases")
        self.context.check(lib.ost_load_cases_create(scene.pointer, box))
        self.pointer, self.owner = box[0], self.context.handle_of(box[0], lib.ost_load_cases_destroy, scene)
        self.cases = list(scene.case.load_cases.items())
        for number in range(len(self)):
            self.context.check(lib.ost_watch_check(lib.ost_load_cases_scene(self.pointer, number)))

    def __len__(self):
        return lib.ost_load_cases_count(self.pointer)

    stiffnesses = property(lambda self: lib.ost_load_cases_stiffnesses(self.pointer), doc="how many are made in all")

    @property
    def next_name(self):
        return self.cases[lib.ost_load_cases_next(self.pointer)][0]

    def __iter__(self):
        return self

    def __next__(self):
        """Collective. Solves the next one; after a failure one may go on."""
        if lib.ost_load_cases_left(self.pointer) == 0:
            raise StopIteration
        number = lib.ost_load_cases_next(self.pointer)
        case = self.cases[number][1]
        scene = Scene.borrowed(case, ffi.cast("OstScene *", lib.ost_load_cases_scene(self.pointer, number)), self.owner)
        box = self.context.box("OstResult")
        status = lib.ost_load_cases_solve(self.pointer, lib.ost_case_output_fields(case.pointer), box)
        try:
            return take_result(self.context, status, box, scene.mesh, scene, self)
        except OrthostatError as error:
            error.args = (f"load case '{self.cases[number][0]}': {error.args[0]}",)
            raise


class Sweep:
    """A case for several values of some of its keys, each combined with each: `for values, result in sweep` solves one
    after another, with `values` a dict of the keys. After a failure, which has `values` too, one may go on."""

    def __init__(self, source, over, mesh=None, comm=None, **limits):
        self.source, self.mesh, self.comm, self.limits = source, mesh, comm, limits
        over = {key: list(values) for key, values in over.items()}
        self.all = [dict(zip(over, values)) for values in itertools.product(*over.values())]
        self.done = 0

    def __len__(self):
        return len(self.all)

    def __iter__(self):
        return self

    def __next__(self):
        """Collective. Solves for the next values."""
        if self.done == len(self.all):
            raise StopIteration
        values = self.all[self.done]
        self.done += 1
        try:
            case = Case(self.source, comm=self.comm, settings=values, swept=True)
            return values, case.solve(self.mesh, **self.limits)
        except OrthostatError as error:
            error.values = values
            error.args = (f"{', '.join(f'{key}={_value(value)}' for key, value in values.items())}: {error.args[0]}",)
            raise


def sweep(source, over, mesh=None, comm=None, **limits):
    """Collective. Solves a case, given as for Case, over values of its keys: see Sweep.

    over: {key: values}, keys as for settings; the first varies slowest."""
    return Sweep(source, over, mesh, comm, **limits)


def _solve_all(solves):
    """{name: answer} of pairs (name, function): all are tried, and the first failure is raised then, with the answers of
    the others as its result."""
    results, failure = {}, None
    for name, solve in solves:
        try:
            results[name] = solve()
        except OrthostatError as error:
            failure = failure or error
    if failure:
        failure.result = results
        raise failure
    return results


def _adapt(case, seconds, size):
    box = case.context.box("OstAdaption")
    limits = ffi.new("OstAdaptLimits *", {"seconds": seconds, "bytes": size})
    status = lib.ost_adapt(case.pointer, limits, box)
    owner = case.context.handle_of(box[0], lib.ost_adaption_destroy, case)
    found = lib.ost_adaption_result(box[0]) if box[0] else ffi.NULL
    result = None
    if found:
        scene = Scene.borrowed(case, lib.ost_adaption_scene(box[0]), owner)
        result = Result(found, owner, scene.mesh, scene)
        count = lib.ost_adaption_level_count(box[0])
        result.levels = [struct(lib.ost_adaption_level(box[0], i)[0]) for i in range(count)]
    case.context.check(status, result)
    if lib.ost_adaption_end(box[0]) != lib.OST_ADAPT_MET:
        words = ffi.new("char[]", lib.OST_LONGEST_ADAPT_WORDS)
        lib.ost_adaption_words(box[0], words)
        error = NotConverged(text_of(words))
        error.result = result
        raise error
    return result.find_watched()


def solve(case, mesh=None, comm=None, **limits):
    """Collective. Solves a case: a Case, or a path, a text or a dict that makes one (Case); see Case.solve."""
    case = case if isinstance(case, Case) else Case(case, comm=comm)
    return case.solve(mesh, **limits)
