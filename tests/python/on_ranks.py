"""What the Python package does, on however many ranks it is started: test_package.py starts it."""
import gc
import os
import sys
import traceback
import warnings

import numpy as np

import orthostat

SOURCE = os.environ["ORTHOSTAT_SOURCE"]
WOOD = {"region": "all", "youngs_modulus": [10, 0.8, 0.5], "poissons_ratio": {"nu12": 0.4, "nu23": 0.3, "nu31": 0.02},
        "shear_modulus": {"G12": 0.6, "G23": 0.04, "G31": 0.6}}
BAR = {"title": "a bar", "mesh": {"block": {"size": np.array([4, 1, 1]), "divisions": (8, 2, 2)}}, "materials": [WOOD],
       "constraints": [{"on": {"boundary": "xmin"}, "displacement": [0, None, np.nan]},
                       {"on": {"boundary": "ymin"}, "displacement": ["free", 0, "free"]},
                       {"on": {"boundary": "zmin"}, "displacement": ["free", "free", 0]}],
       "loads": [{"on": {"boundary": "xmax"}, "total_force": [np.float64(0.02), 0, 0]}],
       "watch": {"end": {"displacement": {"nearest": [4, 1, 1]}, "component": "x", "expected": 0.008}}}
LEFT_FIXED = [{"on": {"boundary": "xmin"}, "displacement": [0, 0, 0]}]


def close(found, wanted, tolerance=1e-7):
    np.testing.assert_allclose(found, wanted, rtol=0, atol=tolerance * max(np.abs(wanted).max(), 1e-300) if np.size(wanted) else 0)


def raises(kind, words, call, *arguments, **named):
    try:
        call(*arguments, **named)
    except kind as error:
        assert words in str(error), f"'{words}' is not in: {error}"
        return error
    raise AssertionError(f"no {kind.__name__} with '{words}'")


def a_uniform_stretch_has_the_formula(folder):
    result = orthostat.solve(BAR)
    assert result.status == "accepted" and result.objections == [], result.objections
    x = result.mesh.points
    close(result.displacement, x * [0.002, -0.4 * 0.002, -0.02 * 10 / 0.5 * 0.002], 1e-6)
    close(result.stress, np.tile([0.02, 0, 0, 0, 0, 0], (result.mesh.owned_tets, 1)), 1e-6)
    close(result.strain[:, 0], np.full(result.mesh.owned_tets, 0.002), 1e-6)
    close(result.strain_energy, 0.5 * 0.02 * 0.008, 1e-6)
    close(result.strain_energy_density, np.full(result.mesh.owned_tets, 2e-5), 1e-6)
    close(result.node_stress[:, 0], np.full(result.mesh.node_count, 0.02), 1e-6)
    close(result.largest_displacement_at[0], 4.0)
    if result.context.rank == 0:  # the others need not read it
        watched = result.watch["end"]
        assert not watched.placed and np.isnan(watched.place).all()
        close(watched.value, 0.008, 1e-6)
        assert watched.expected == 0.008
    assert result.iterations == result.solver.iterations > 0
    assert result.checks.finite == 1 and result.error.known and "MUMPS" in result.solver.engine
    file = os.path.join(folder, "bar.yaml")
    text = open(os.path.join(SOURCE, "cases", "block", "sliding.yaml"), encoding="utf-8").read()
    if result.context.rank == 0:
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(text)
    of_text, of_file = orthostat.solve(text), orthostat.Case(file, comm=result.context).solve()
    close(of_file.displacement, of_text.displacement, 1e-9)
    finer = orthostat.Case(file, settings={"title": "finer", "element.order": 2})
    assert finer.title == "finer" and finer.solve().unknowns > of_file.unknowns
    changed = orthostat.Case(BAR, settings={"title": "x", "materials.0.youngs_modulus": np.array([20.0, 0.8, 0.5])})
    assert changed.title == "x"
    close(changed.solve().watch["end"].value, 0.004, 1e-6)
    raises(orthostat.InvalidInput, "did you mean 'title'", orthostat.Case, BAR, settings={"titel": "x"})
    read = {**BAR, "large_rotation": False, "constraints": [{True: item["on"], **{k: v for k, v in item.items() if k != "on"}}
                                                            for item in BAR["constraints"]],
            "loads": [{True: {"boundary": "xmax"}, "total_force": ["2e-2", "-.0", "0."]}], "accuracy": {"relative_residual": "1e-8"}}
    close(orthostat.solve(read).watch["end"].value, 0.008, 1e-6)  # as PyYAML reads `on` and such numbers
    assert orthostat.Case({**BAR, "title": "1.10"}).title == "1.10"
    loads = [{"on": {"boundary": "xmax"}, "total_force": [0, float("nan"), 0]}]
    raises(orthostat.InvalidInput, "NaN', expected a finite number", orthostat.Case, {**BAR, "loads": loads})
    result.write(os.path.join(folder, "bar.vtkhdf"), fields=["displacement", "stress"])
    assert open(os.path.join(folder, "bar.vtkhdf"), "rb").read(8) == b"\x89HDF\r\n\x1a\n"


def arrays_are_views_that_keep_their_owner(folder):
    result = orthostat.solve(BAR)
    u, stress, points = result.displacement, result.stress, result.mesh.points
    assert u.ctypes.data == result.displacement.ctypes.data and not u.flags.owndata
    raises(ValueError, "read-only", u.__setitem__, 0, 1.0)
    before = u.copy(), stress.copy(), points.copy()
    held = result.context.ledger()
    del result
    gc.collect()
    for _ in range(3):  # whatever was freed is written over
        orthostat.solve({**BAR, "mesh": {"block": {"size": [4, 1, 1], "divisions": [8, 3, 3]}}})
    for now, then in zip((u, stress, points), before):
        assert np.array_equal(now, then)
    assert held["mesh"][1] > 0


def nothing_is_left_when_all_is_dropped(folder):
    context = orthostat.Context()
    scene = orthostat.Case(BAR, comm=context).scene()
    analysis = scene.analysis()
    result = analysis.solve()
    u = result.displacement
    del scene, analysis, result
    gc.collect()
    context.collect()
    assert sum(entry[1] for entry in context.ledger().values()) > u.nbytes
    if context.rank == 0:
        del u  # dropped on one rank alone, it waits for the others
    context.collect()
    assert context.size == 1 or sum(entry[1] for entry in context.ledger().values()) > 0
    u = None
    context.collect()
    assert sum(entry[1] for entry in context.ledger().values()) == 0, context.ledger()


def many_loads_share_one_hierarchy(folder):
    scene = orthostat.Case({**BAR, "constraints": LEFT_FIXED, "accuracy": {"relative_residual": 1e-10}}).scene()
    analysis, mesh = scene.analysis(), scene.mesh
    at_end = mesh.points[:mesh.owned_nodes, 0] == 4
    count = mesh.gather_nodes(at_end).sum()
    assert count == 9, count
    answers, setups = [], []
    for direction in [1, 0, 0], [0, 1, 0], [1, 1, 0]:
        force = np.zeros((mesh.owned_nodes, 3))
        force[at_end] = np.array(direction) * 0.001 / count
        answers.append(analysis.solve(force, fields=()))
        assert answers[-1].stress is None
        ledger = scene.context.ledger()
        setups.append({account: ledger[account][0] for account in ("multigrid setup", "stiffness", "stiffness pattern")})
    close(answers[2].displacement, answers[0].displacement + answers[1].displacement, 1e-7)
    close(analysis.problem.load()[at_end], force[at_end])
    assert all(setups[0][account] == setups[2][account] > 0 for account in setups[0]), setups
    estimated = analysis.solve(fields=["error", "stress"])
    squares = mesh.gather_tets(estimated.tet_error ** 2).sum()
    close(squares, estimated.error.energy_norm ** 2, 1e-9)
    assert 0 < estimated.error.relative < 1 and estimated.stress is not None and estimated.strain is None


def load_cases_share_a_stiffness(folder):
    bend = [{"on": {"boundary": "xmax"}, "total_force": [0, -0.001, 0]}]
    other = [{"on": {"boundary": "xmin"}, "displacement": [0.004, 0, 0]}]
    case = orthostat.Case({**BAR, "constraints": LEFT_FIXED, "accuracy": {"relative_residual": 1e-10}, "cases": [
        {"name": "pull"}, {"name": "both", "loads": bend}, {"name": "moved", "constraints": other},
        {"name": "loose", "constraints": [{"on": {"boundary": "xmin"}, "displacement": [0, None, None]}]}]})
    assert list(case.load_cases) == ["pull", "both", "moved", "loose"]
    cases = case.scene().load_cases()
    assert len(cases) == 4 and cases.stiffnesses == 2
    failure = raises(orthostat.InvalidInput, "loose", case.solve)
    results = failure.result
    assert set(results) == {"pull", "both", "moved"} and "both" in results["both"].scene.case.title
    close(results["moved"].displacement - results["pull"].displacement, np.tile([0.004, 0, 0], (results["pull"].mesh.node_count, 1)), 1e-6)
    together = os.path.join(folder, "together.vtkhdf")
    orthostat.write_steps(results, together)
    raises(ValueError, "no result to write", orthostat.write_steps, {}, together)
    assert os.path.exists(together)
    other = orthostat.solve({**BAR, "element": {"order": 2}})
    raises(orthostat.InvalidInput, "takes no other mesh", orthostat.write_steps, {**results, "other": other},
           os.path.join(folder, "mixed.vtkhdf"))
    alone = orthostat.Case({**BAR, "constraints": LEFT_FIXED, "loads": BAR["loads"] + bend, "accuracy": {"relative_residual": 1e-10}}).solve()
    close(results["both"].displacement, alone.displacement, 1e-7)
    close(results["both"].watch["end"].value, alone.watch["end"].value, 1e-7)


def fields_are_those_of_the_file(folder):
    strong = {**WOOD, "strengths": {"tension": [0.04, 0.02, 0.02], "compression": [0.04, 0.02, 0.02], "shear": {"S12": 0.01, "S23": 0.01, "S31": 0.01}}}
    result = orthostat.solve({**BAR, "materials": [strong]})
    tets = result.mesh.owned_tets
    assert np.array_equal(result.field("stress"), result.stress) and not result.field("stress").flags.owndata
    close(result.field("von_mises"), np.full(tets, 0.02), 1e-6)
    close(result.field("principal_stress")[:, 0], np.full(tets, 0.02), 1e-6)
    close(result.field("maximum_stress_load_factor"), np.full(tets, 2.0), 1e-6)
    close(result.failure.least[2].factor, 2.0, 1e-6)
    close(result.field("strain_tensor")[:, 3:], 0.5 * result.strain[:, 3:], 1e-6)
    close(result.field("load")[:result.mesh.owned_nodes], result.load)
    assert result.field("load").shape == (result.mesh.node_count, 3) and result.field("region").dtype == np.int32
    assert np.array_equal(result.field("rank"), np.full(tets, result.context.rank))
    close(result.field("axes"), np.tile(np.eye(3), (tets, 1, 1)))
    weak = orthostat.solve(BAR)  # no strengths
    assert weak.field("hill_load_factor") is None and weak.failure is None
    raises(ValueError, "field: 'misses' is none of", result.field, "misses")
    held = result.field("pressure")
    del result
    gc.collect()
    orthostat.solve(BAR)
    close(held, np.full(tets, -0.02 / 3), 1e-6)


def failures_are_exceptions_with_the_librarys_words(folder):
    raises(orthostat.FileFailed, "nowhere.yaml: cannot be opened", orthostat.solve, "nowhere.yaml")
    raises(orthostat.InvalidInput, "unknown key 'mush'", orthostat.solve, "mush: from_program")
    raises(orthostat.InvalidInput, "unknown key 'mush'", orthostat.solve, b"mush: from_program")
    raises(orthostat.FileFailed, "nowhere.yaml: cannot be opened", orthostat.solve, b"nowhere.yaml")
    raises(ValueError, "three shear moduli", orthostat.Material, [1, 2, 3], [0.1, 0.2, 0.3])
    raises(OSError, "nowhere.yaml", orthostat.solve, "nowhere.yaml")
    raises(orthostat.InvalidInput, "did you mean 'loads'", orthostat.solve, {**BAR, "loots": []})
    raises(orthostat.InvalidInput, "region 'bone'", orthostat.solve, {**BAR, "materials": [WOOD, {**WOOD, "region": "bone"}]})
    raises(orthostat.InvalidInput, "not stable", orthostat.Material, [1, 1000, 1], [0.4, 0.3, 0.9], [1, 1, 1])
    raises(orthostat.InvalidInput, "tet 1 (index 0) is inverted", orthostat.Mesh,
           orthostat.MeshArrays(np.eye(4, 3), [[0, 1, 2, 3]]))
    raises(ValueError, "fields: 'stres' is none of", orthostat.Case(BAR).scene().analysis().solve, fields=["stres"])
    raises(ValueError, "this is 8 × 3", orthostat.Case(BAR).scene().analysis().solve, np.zeros((8, 3)))
    raises(ValueError, "'metode' is no option", orthostat.Case(BAR).scene().problem().analysis, metode=1)
    stopped = raises(orthostat.NotConverged, "1 iteration", orthostat.Case(
        {**BAR, "mesh": {"block": {"size": [4, 1, 1], "divisions": [32, 8, 8]}}, "constraints": LEFT_FIXED}).scene().problem()
                     .analysis(method="metric", max_iterations=1).solve)
    assert stopped.result.status == "unfinished" and np.isfinite(stopped.result.displacement).all()
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        watch = {"end": {"displacement": {"nearest": [4.2, 1, 1]}, "component": "x"}}
        context = orthostat.Context()
        orthostat.Case({**BAR, "watch": watch}, comm=context).scene().check()
    expected = 1 if context.rank == 0 else 0
    assert len([w for w in heard if w.category is orthostat.OrthostatWarning and "4.2" in str(w.message)]) == expected, heard
    assert len(context.warnings) == expected


def cubes(n):
    """n cubes in a row, each of six tets, and its two ends."""
    number = np.arange(4 * (n + 1)).reshape(n + 1, 2, 2)
    points = np.stack(np.meshgrid(np.arange(n + 1.0), [0.0, 1.0], [0.0, 1.0], indexing="ij"), axis=-1).reshape(-1, 3)
    tets = []
    for cube in range(n):
        for order, odd in ((0, 1, 2), 0), ((1, 2, 0), 0), ((2, 0, 1), 0), ((0, 2, 1), 1), ((2, 1, 0), 1), ((1, 0, 2), 1):
            at, nodes = np.array([cube, 0, 0]), [number[cube, 0, 0]]
            for direction in order:
                at[direction] += 1
                nodes.append(number[tuple(at)])
            tets.append([nodes[i] for i in ((0, 2, 1, 3) if odd else (0, 1, 2, 3))])
    ends = {"left": [0, 1, 2, 3], "right": number[n].ravel()}
    return points, np.array(tets), ends


def a_mesh_of_arrays_serves_cases_and_problems(folder):
    points, tets, ends = cubes(4)
    rank, size = orthostat.Context().rank, orthostat.Context().size
    middle = points[tets].mean(axis=1)
    axes = np.tile([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]], (len(tets), 1, 1))  # e1 across the bar
    regions = (middle[:, 0] > 2).astype(int)
    soft = {**WOOD, "axes": {"cells": "mesh"}}
    case = {**BAR, "mesh": "from_program", "materials": [{**soft, "region": "near"}, {**soft, "region": "far"}],
            "constraints": [{"on": {"boundary": "left"}, "displacement": [0, 0, 0]}],
            "loads": [{"on": {"vertices": [17, 18, 19, 20]}, "point_force": [0.005, 0, 0]}]}
    mine = orthostat.MeshArrays(points, tets, regions, ("near", "far"), ends, axes)
    scene = orthostat.Case(case).scene(mine if rank == 0 else orthostat.MeshArrays())
    assert scene.mesh.region_names == ["near", "far"] and scene.mesh.boundary_names == ["left", "right"]
    close(scene.axes, np.tile(axes[0], (scene.mesh.tet_count, 1, 1)))
    close(scene.mesh.axes, scene.axes)
    unused = {**case, "materials": [{**WOOD, "region": "all"}]}
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        orthostat.Case(unused).scene(mine if rank == 0 else orthostat.MeshArrays())
    expected = [True] if rank == 0 else []
    assert ["no material uses them: a material with 'axes: {cells: mesh}' does" in str(one.message) for one in heard] == expected, heard
    result = scene.solve()
    assert result.largest_displacement > 1.2 * 0.02 * 4 / 10, result  # across the grain it is softer
    found_points, found_tets = scene.mesh.whole()
    assert np.array_equal(found_points, points) and np.array_equal(found_tets, tets)
    assert np.array_equal(scene.mesh.gather_tets(scene.mesh.regions), regions)
    close(scene.mesh.share(points), scene.mesh.points[:scene.mesh.owned_nodes])
    gaps = os.path.join(folder, "gaps.node")  # labels from 0, with gaps, in another order than the nodes'
    if rank == 0:
        with open(gaps, "w") as stream, open(os.path.join(folder, "gaps.ele"), "w") as tet_stream:
            label = [3 * (len(points) - 1 - n) for n in range(len(points))]
            print(len(points), 3, 0, 0, *("\n%d %g %g %g" % (label[n], *x) for n, x in enumerate(points)), file=stream)
            print(len(tets), 4, 0, *("\n%d %d %d %d %d" % (t, *(label[n] for n in tet)) for t, tet in enumerate(tets)),
                  file=tet_stream)
    for mesh in (scene.mesh.quadratic(), scene.mesh.refined(), orthostat.Mesh(gaps), orthostat.Mesh(gaps).quadratic()):
        own = mesh.points[:mesh.owned_nodes]
        assert np.array_equal(mesh.share(mesh.gather_nodes(own)), own) and len(own) > 0
        raises(ValueError, f"rows for all {mesh.global_nodes} nodes", mesh.share, np.zeros(mesh.global_nodes + 1))
        raises(ValueError, "gather_nodes: a row of each", mesh.gather_nodes, np.zeros(mesh.owned_nodes - 1))
        raises(ValueError, "gather_tets: a row of each", mesh.gather_tets, np.zeros(mesh.tet_count + 1))

    # The same by shares of all ranks, and as a problem of its own parts.
    nodes, mine = np.array_split(np.arange(len(points)), size)[rank], np.array_split(np.arange(len(tets)), size)[rank]
    spread = orthostat.MeshArrays(points[nodes], tets[mine], axes=axes[mine], spread=True)
    mesh = orthostat.Mesh(spread)
    wood = orthostat.Material(WOOD["youngs_modulus"], WOOD["poissons_ratio"], [0.6, 0.04, 0.6])
    force = np.zeros((len(points), 3))
    force[16:, 0] = 0.005
    problem = orthostat.Problem(mesh, {"body": wood}, constraints=[(mesh.points[:, 0] == 0, [0, 0, 0])], force=mesh.share(force))
    answer = problem.analysis(relative_residual=1e-12).solve()
    close(mesh.gather_nodes(answer.displacement), scene.mesh.gather_nodes(result.displacement), 1e-6)
    close(problem.energy(answer.displacement), 0.5 * (mesh.gather_nodes(answer.displacement) * force).sum(), 1e-8)
    close(problem.energy(answer.displacement), answer.strain_energy, 1e-8)
    inside = problem.internal_force(answer.displacement)
    close(inside, answer.load + answer.reaction[:mesh.owned_nodes], 1e-7)

    # Rows of the stiffness, times the displacement, are the internal force where nothing is constrained.
    k = problem.stiffness()
    u = answer.displacement[k.node]
    row = np.repeat(np.arange(k.rows), np.diff(k.row_start))
    product = np.zeros((k.rows, 3))
    np.add.at(product, row, np.einsum("eij,ej->ei", k.value, u[k.column]))
    assert np.abs(product - inside[k.node[:k.rows]]).max(initial=0) < 1e-10 * 0.005
    assert problem.mesh.quadratic().global_nodes > mesh.global_nodes and mesh.refined().global_tets == 8 * len(tets)
    raises(ValueError, "tets: whole numbers are wanted", orthostat.MeshArrays, points, tets + 0.5)
    raises(ValueError, "regions: whole numbers are wanted, up to 2147483647", orthostat.MeshArrays, points, tets,
           regions=np.full(len(tets), 2**32))
    raises(ValueError, "points: real numbers are wanted", orthostat.MeshArrays, points + 1j, tets)
    raises(ValueError, "a tet has 4 or 10 nodes", orthostat.MeshArrays, points, tets[:, :3])
    raises(orthostat.InvalidInput, "tet 1", orthostat.Mesh, orthostat.MeshArrays(points, tets[:, [1, 0, 2, 3]]))


def constraints_may_be_given_along_directions(folder):
    points, tets, _ = cubes(2)
    mesh = orthostat.Mesh(orthostat.MeshArrays(points, tets))
    x, nan = mesh.points, np.nan
    steel = orthostat.Material(200.0, 0.0)
    problem = orthostat.Problem(mesh, steel, constraints=[
        (x[:, 0] == 0, 0.0, [1, 0, 0]), (np.flatnonzero(x[:, 0] == 2), [[0.02, nan, nan]] * (x[:, 0] == 2).sum()),
        (np.ones(len(x), bool), [nan, 0, 0])])
    answer = problem.analysis().solve()
    close(answer.displacement, x * [0.01, 0, 0])
    own = mesh.owned_nodes
    for nodes, words in (([99], "there is no node 99"), ([2 ** 32], "there is no node 4294967296"), ([0.6], "whole numbers"),
                         (np.ones(own - 1, bool), f"each of the {own} nodes"),
                         (np.ones((own, 1), bool), f"each of the {own} nodes")):
        raises(ValueError, words, orthostat.Problem, mesh, steel, constraints=[(nodes, [0, 0, 0])])
    masked = [(x[:own, 0] == 0, [0, 0, 0])]  # a mask may leave out ghosts
    assert not orthostat.Problem(mesh, steel, constraints=masked, force=np.zeros((own, 3))).analysis().solve().displacement.any()
    close(mesh.gather_nodes(answer.reaction)[mesh.gather_nodes(x)[:, 0] == 2].sum(axis=0), [2, 0, 0], 1e-6)
    force, rank = np.zeros((own, 3)), mesh.context.rank
    force[own - 1, 1] = 1.0 if rank else nan
    wrong = orthostat.Problem(mesh, steel, constraints=masked, force=force).analysis()
    raises(orthostat.InvalidInput, f"the force on node {'' if rank else f'{own - 1} of rank 0, at ('}", wrong.solve)
    raises(orthostat.InvalidInput, "is nan along y; expected a finite number: give 0 where no force acts", wrong.solve)


def incompressible_bodies_have_the_mixed_form(folder):
    points, tets, _ = cubes(2)
    mesh = orthostat.Mesh(orthostat.MeshArrays(points, tets)).quadratic()
    x, rubber = mesh.points, orthostat.Material(2.0, 0.5)
    pull = [(x[:, k] == 0, 0.0, np.eye(3)[k]) for k in range(3)] + [(x[:, 0] == 2, 0.02, [1, 0, 0])]
    raises(orthostat.InvalidInput, "mixed=True", orthostat.Problem, mesh, rubber, constraints=pull)
    answer = orthostat.Problem(mesh, rubber, constraints=pull, mixed=True).analysis().solve()
    close(answer.displacement, x * [0.01, -0.005, -0.005], 1e-6)


def poses_turn_rigidly_without_energy(folder):
    points, tets, _ = cubes(2)
    mesh = orthostat.Mesh(orthostat.MeshArrays(points, tets))
    wood = orthostat.Material(WOOD["youngs_modulus"], WOOD["poissons_ratio"], [0.6, 0.04, 0.6])
    problem = orthostat.Problem(mesh, wood, axes=np.eye(3)[[1, 2, 0]], constraints=[(mesh.points[:, 0] == 0, [0, 0, 0])])
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    u = mesh.points @ turn.T - mesh.points
    close(problem.axes, np.tile(np.eye(3)[[1, 2, 0]], (mesh.tet_count, 1, 1)))
    assert problem.is_linear and problem.energy(u) > 0.1
    problem.formulation = "consistent"
    assert not problem.is_linear and problem.formulation == "consistent" and problem.energy(u) < 1e-12
    close(problem.worst_tet(u).stretch, 1.0)
    raises(ValueError, "formulation: 'cubic' is none of", setattr, problem, "formulation", "cubic")
    scene = orthostat.Case({**BAR, "constraints": LEFT_FIXED, "large_rotation": "on",
                            "loads": [{"on": {"boundary": "xmax"}, "total_force": [0, -0.03, 0]}]}).scene()
    bent, problem = scene.solve(), scene.problem()
    assert problem.formulation == "consistent"
    close(problem.energy(bent.displacement) / bent.strain_energy, 1, 1e-6)
    assert bent.newton.used and bent.newton.iterations > 2 and bent.iterations == bent.newton.linear_iterations
    assert 0.5 < bent.largest_displacement < 1, bent


def axes_at_vertices_vary_within_quadratic_tets(folder):
    points, tets, _ = cubes(2)
    mesh = orthostat.Mesh(orthostat.MeshArrays(points, tets)).quadratic()
    wood = orthostat.Material([10, 1000, 10], 0.3)
    held = [(mesh.points[:, 0] == 0, [0, 0, 0])]
    at = mesh.points[mesh.tets[:, :4]]
    radial = (at + [1, 0, 0]) * [1, 1, 0]
    radial /= np.linalg.norm(radial, axis=2, keepdims=True)
    axes = np.stack([radial, np.cross([0, 0, 1], radial), np.tile([0.0, 0, 1], at.shape[:2] + (1,))], axis=2)
    problem = orthostat.Problem(mesh, wood, axes=axes, constraints=held)
    u = mesh.points @ np.diag([0.01, 0.02, 0])
    close(problem.axes[:, 2], np.tile([0.0, 0, 1], (mesh.tet_count, 1)))
    uniform = orthostat.Problem(mesh, wood, axes=problem.axes, constraints=held).energy(u)
    assert 1e-3 < abs(problem.energy(u) / uniform - 1) < 0.2, (problem.energy(u), uniform)
    turned = np.broadcast_to(problem.axes[:, None], axes.shape)
    close(orthostat.Problem(mesh, wood, axes=turned, constraints=held).energy(u) / uniform, 1, 1e-6)
    axes[0, 1] *= 2
    raises(orthostat.InvalidInput, "axes at vertex 1 of local tet 0: e1 has length 2", orthostat.Problem, mesh, wood, axes=axes)


def paths_and_accuracies_are_followed(folder):
    case = orthostat.Case({**BAR, "path": {"steps": 3}})
    path = case.scene().path()
    results = list(path)
    assert case.has_path and len(path) == path.done == 3
    close([result.step.t for result in results], [1 / 3, 2 / 3, 1])
    close(results[0].displacement * 3, results[2].displacement, 1e-6)
    file = os.path.join(folder, "path.check")
    path.save(file)
    again = case.scene().path()
    again.resume(file)
    assert again.done == 3
    bent = {**BAR, "constraints": LEFT_FIXED, "loads": [{"on": {"boundary": "xmax"}, "total_force": [0, -0.001, 0]}],
            "large_rotation": "off"}
    refined = orthostat.solve({**bent, "accuracy": {"relative_error": 0.2}})
    assert len(refined.levels) > 1 and refined.error.relative < 0.2 < refined.levels[0].error.relative
    assert refined.levels[-1].tets == refined.mesh.global_tets
    stopped = raises(orthostat.NotConverged, "", orthostat.Case({**bent, "accuracy": {"relative_error": 1e-3}}).solve,
                     max_seconds=1e-3)
    assert stopped.result.error.relative > 1e-3


def sweeps_combine_values(folder):
    sweep = orthostat.sweep(BAR, {"materials.0.E1": np.array([10.0, 20.0]), "loads.0.total_force.x": [0.02, 0.03, 0.04]})
    assert len(sweep) == 6
    found = [(values, result.watch["end"].value) for values, result in sweep]
    assert [list(values.values()) for values, _ in found] == [[e, f] for e in (10, 20) for f in (0.02, 0.03, 0.04)]
    for values, end in found:
        close(end, 4 * values["loads.0.total_force.x"] / values["materials.0.E1"], 1e-6)
    sweep = orthostat.sweep(BAR, {"materials.0.E1": [10, -1, 20]})
    close(next(sweep)[1].watch["end"].value, 0.008, 1e-6)
    failure = raises(orthostat.InvalidInput, "materials.0.E1=-1: ", next, sweep)
    assert failure.values == {"materials.0.E1": -1}
    close(next(sweep)[1].watch["end"].value, 0.004, 1e-6)  # a failure ends no sweep
    raises(StopIteration, "", next, sweep)
    twice = {"materials.0.E1": [10, 20], "materials.all.E1": [30]}  # one value by two names
    raises(orthostat.OrthostatError, "the sweep sets one value by two keys, materials.0.E1=10 and materials.all.E1=30; leave one out",
           next, orthostat.sweep(BAR, twice))
    assert orthostat.Case(BAR, settings={key: values[0] for key, values in twice.items()})  # of settings the last counts
    for values, results in orthostat.sweep({**BAR, "cases": [{"name": "as-is"}, {"name": "more", "loads": BAR["loads"]}]},
                                           {"element.order": [1, 2]}):
        close(results["more"].watch["end"].value, 2 * results["as-is"].watch["end"].value, 1e-6)
        assert results["more"].mesh.nodes_per_tet == (4 if values["element.order"] == 1 else 10)


def communicators_are_handed_over(folder):
    try:
        from mpi4py import MPI
    except ImportError:
        return
    world = MPI.COMM_WORLD
    assert orthostat.Context().size == world.size and orthostat.Context(MPI.COMM_SELF).size == 1
    alone = orthostat.solve({**BAR, "loads": [{"on": {"boundary": "xmax"}, "total_force": [0.02 * (world.rank + 1), 0, 0]}]},
                            comm=MPI.COMM_SELF)
    assert alone.mesh.owned_nodes == alone.mesh.global_nodes == 81
    close(world.allgather(alone.largest_displacement), alone.largest_displacement / (world.rank + 1) * np.arange(1, world.size + 1), 1e-6)


def materials_have_their_matrices(folder):
    wood = orthostat.Material(WOOD["youngs_modulus"], [0.4, 0.3, 0.02], [0.6, 0.04, 0.6], density=0.4, name="spruce")
    close(wood.stiffness() @ wood.compliance(), np.eye(6))
    assert wood.name == "spruce" and wood.density == 0.4 and not wood.is_isotropic
    turned = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    close(wood.compliance(turned)[1, 1], 1 / 10)
    close(wood.stiffness(turned)[1, 1], wood.stiffness()[0, 0])
    for axes, words in ((np.ones((3, 3)), "e1 and e2 are not orthogonal"), (2 * np.eye(3), "e1 has length 2"),
                        (np.diag([1, 1, -1]), "left-handed"), (np.full((3, 3), np.nan), "finite number")):
        for matrix in wood.stiffness, wood.compliance:
            raises(orthostat.InvalidInput, words, matrix, axes)
    close(orthostat.Material([8, 4, 2], 0.3).youngs_modulus, [8, 4, 2])
    assert orthostat.Material(2.0, 0.25).is_isotropic


def main():
    if sys.argv[1] == "mpi4py":
        from mpi4py import MPI  # which starts MPI, and ends it
        assert MPI.Is_initialized()
    else:
        sys.modules["mpi4py"] = None  # not to be had
    context = orthostat.Context()
    folder = sys.argv[2]
    for test in (a_uniform_stretch_has_the_formula, arrays_are_views_that_keep_their_owner, nothing_is_left_when_all_is_dropped,
                 many_loads_share_one_hierarchy, load_cases_share_a_stiffness, fields_are_those_of_the_file, failures_are_exceptions_with_the_librarys_words,
                 a_mesh_of_arrays_serves_cases_and_problems, constraints_may_be_given_along_directions,
                 incompressible_bodies_have_the_mixed_form, poses_turn_rigidly_without_energy, axes_at_vertices_vary_within_quadratic_tets, paths_and_accuracies_are_followed, sweeps_combine_values, communicators_are_handed_over,
                 materials_have_their_matrices):
        try:
            test(folder)
        except BaseException:  # on one rank alone: the others are not to wait for it
            traceback.print_exc()
            sys.stderr.flush()
            os._exit(1)
    if context.rank == 0:
        print("done")


main()
