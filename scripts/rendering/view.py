# SPDX-License-Identifier: BSD-3-Clause
"""From where the bodies are seen, and how much of them; the loads' arrows, which are seen too."""
import math
from collections import namedtuple

import numpy as np

from .marks import gather_loads

View = namedtuple("View", "eye up centre width height")


def unit(vector):
    length = np.linalg.norm(vector)
    return vector / length if length > 0 else vector


def choose_up(extent):
    """Tall bodies stand, all others lie."""
    long_axis = int(np.argmax(extent))
    tall = long_axis > 0 and extent[long_axis] > 1.2 * np.median(extent)
    return np.eye(3)[long_axis if tall else 2]


def choose_right(body, up):
    """Along a lying body, else the way it moved, so that the motion is seen from the side."""
    extent = np.ptp(body.rest, axis=0)
    along = np.eye(3)[np.argmax(extent)]
    motion = (body.moved - body.rest)[np.argmax(body.size)]
    right = along if along @ up == 0 else motion - up * (motion @ up)
    if np.linalg.norm(right) <= 0.2 * np.linalg.norm(motion):
        right = np.eye(3)[(np.argmax(up) + 1) % 3]
    return unit(right)


def choose_view(bodies, turn):
    """From the side, turned a little (in degrees) and from a little above; and what is then seen of all of them."""
    up = choose_up(np.ptp(bodies[0].rest, axis=0))
    side = choose_right(bodies[0], up)
    turn, lift = math.radians(turn), math.radians(16.0)
    front = math.cos(turn) * np.cross(side, up) + math.sin(turn) * side
    eye = math.cos(lift) * front + math.sin(lift) * up
    right = unit(np.cross(up, eye))
    screen = np.column_stack([right, np.cross(eye, right)])
    heads = [starts + vectors for loads in load_arrows(bodies) for starts, vectors in loads.values()]
    seen = np.vstack([places @ screen for body in bodies for places in (body.rest, body.moved)]
                     + [places @ screen for places in heads])
    low, high = seen.min(axis=0), seen.max(axis=0)
    rest = bodies[0].rest @ eye
    depth = 0.5 * (rest.max() + rest.min())
    return View(eye, up, screen @ (0.5 * (low + high)) + depth * eye, *(high - low))


def set_camera(camera, view, aspect):
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*view.centre)
    camera.SetPosition(*(view.centre + 10.0 * max(view.width, view.height) * view.eye))
    camera.SetViewUp(*view.up)
    camera.SetParallelScale(0.5 * 1.04 * max(view.height, view.width / aspect))


def load_arrows(bodies):
    """Starts and vectors of the arrows of each body that has forces; and of each that has moments."""
    extent = np.linalg.norm(np.ptp(bodies[0].rest, axis=0))
    loads = {i: gather_loads(body.rest, body.moved, body.load, 0.12 * extent)
             for i, body in enumerate(bodies) if body.load is not None and body.load.any()}
    return [to_scale({i: both[kind] for i, both in loads.items() if len(both[kind][0]) > 0}, 0.14 * extent)
            for kind in (0, 1)]


def to_scale(loads, length):
    """The longest arrow of all bodies has this length, and no body's longest is shorter than a third of it."""
    longest = {i: np.linalg.norm(vectors, axis=1).max() for i, (_, vectors) in loads.items()}
    most = max(longest.values(), default=1.0)
    return {i: (starts, length / longest[i] * max(longest[i] / most, 1 / 3) * vectors)
            for i, (starts, vectors) in loads.items()}
