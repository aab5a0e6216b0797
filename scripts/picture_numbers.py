# SPDX-License-Identifier: BSD-3-Clause
"""The numbers that pictures of studies show, from the studies' JSON: docs/pictures/record.json keeps them."""
import math

ROUNDING = 1e-9  # differences below this come from machine and number of ranks
SHAPES = {"soft": "soft inclusions", "stiff": "stiff inclusions", "checker": "checkerboard"}  # whose names are longer here


def short(number, digits=6):
    return None if number is None else float(f"{number:.{digits}g}")


def median(values):
    values = sorted(values)
    middle = len(values) // 2
    return values[middle] if len(values) % 2 else 0.5 * (values[middle - 1] + values[middle])


def numbers_of_verify(report):
    """Of each case its verdict, and of each quantity and order the errors on all meshes and the order observed."""
    cases = {}
    for case in report["cases"]:
        readings = {}
        for quantity in case["quantities"]:
            for step in quantity["steps"]:
                errors = [short(level["error"], 3) for level in step["levels"]]
                rate = None if errors[-1] < ROUNDING else short(step["rate"], 5)
                readings[f"{quantity['name']}, order {step['order']}"] = {
                    "formula": short(step["levels"][-1]["expected"], 7), "errors": errors,
                    "rate": rate, "locks": step["locks"], "passed": step["passed"]}
        cases[case["name"]] = {"passed": case["passed"], "readings": readings}
    return cases


def numbers_of_hard(all_points):
    """Of each shape how its points ended."""
    shapes = {}
    for point in all_points:
        shapes.setdefault(point["shape"], []).append(point)
    return {SHAPES.get(shape, shape): numbers_of_shape(points) for shape, points in shapes.items()}


def numbers_of_hard_size(reports):
    """Of each shape and order the bodies at size: [unknowns, iterations, digits, how it ended], by growing size."""
    tiles = {}
    for report in sorted(reports, key=lambda report: report["size"]):
        for point in report["points"]:
            tile = tiles.setdefault(f"{SHAPES.get(point['shape'], point['shape'])}, order {point['order']}", {})
            body = f"{point['poisson']}, {point['stiffness_and_axes']}"
            digits = point.get("digits")
            tile.setdefault(body, []).append([point.get("unknowns", report["size"]), point.get("iterations"),
                                              None if digits is None else short(digits, 3), point["outcome"].lower()])
    return tiles


def numbers_of_shape(points):
    sound = [point for point in points if not point["flawed"]]
    flawed = [point for point in points if point["flawed"]]
    solved = [point for point in sound if point["outcome"].startswith("solved")]

    def count(group, outcome):
        return sum(point["outcome"].lower() == outcome for point in group)  # a false success is written large

    return {"points": len(sound), "solved": count(sound, "solved"), "solved to rounding": count(sound, "solved to rounding"),
            "refused rightly": count(sound, "refused rightly"), "given up": count(sound, "given up"),
            "false success": count(points, "false success"), "flawed": len(flawed),
            "flawed refused": count(flawed, "refused rightly"),
            "median iterations": round(median([point["iterations"] for point in solved])),
            "most iterations": max(point["iterations"] for point in solved),
            "fewest digits": short(math.floor(10 * min(point["digits"] for point in solved)) / 10)}
