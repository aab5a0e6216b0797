# SPDX-License-Identifier: BSD-3-Clause
"""The whole picture: shapes and sections in their places, titles, range of colours and key."""
import math

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from .bodies import colours_of, shade_of
from .common import ALARM, BEYOND, FAINT, INK
from .marks import HELD, LOAD, MOVED
from .section import choose_section, draw_section
from .shape import draw_shape
from .view import load_arrows


def compose(body, view, asked):
    """One body: its shape, and beside it the section, if one is asked for."""
    width, height = asked.size
    figure = make_figure(asked, [body], width, height)
    bottom, top = 0.15, 0.88
    needed = (top - bottom) * height / width * view.width / view.height
    share = min(max(needed + 0.06, 0.34), 0.6) if asked.section != "none" else 0.98  # of the width, for the shape
    show(figure, [0.03, bottom, share - 0.04, top - bottom], [body], 0, view, asked)
    times = times_of(body)
    caption(figure, 0.01 + share / 2, 0.915, "Body at rest" if body.envelope else f"Deformed shape{times}", fontsize=12)
    if asked.section == "none":
        return figure
    section = choose_section(asked.section, body)
    plane = figure.add_axes([share + 0.09, bottom + 0.03, 0.88 - share, top - bottom - 0.03])
    draw_section(plane, body, section, shade_of([body], asked.field))
    where = f"Section {'xyz'[section.axis]} = {section.value:g}"
    caption(figure, share + 0.09 + (0.88 - share) / 2, 0.915, where + times, fontsize=12)
    return figure


def compose_sheet(bodies, view, asked):
    """Several bodies in columns, each with its name; the section, if one is asked for, below the shape."""
    width, height = asked.size
    figure = make_figure(asked, bodies, width, height)
    columns = asked.columns or min(len(bodies), 4)
    rows = math.ceil(len(bodies) / columns)
    bottom, top = 95 / height, 1 - 80 / height
    step = (top - bottom) / rows
    for number, body in enumerate(bodies):
        left, high = number % columns / columns, top - number // columns * step
        caption(figure, left + 0.5 / columns, high, asked.labels[number] + mark_of(body), fontsize=12,
                color=ALARM if body.status else INK)
        high, tall = high - 22 / height, step - 30 / height
        shape = tall if asked.section == "none" else 0.55 * tall
        show(figure, [left + 0.005, high - shape, 1 / columns - 0.01, shape], bodies, number, view, asked)
        if asked.section != "none":
            plane = figure.add_axes([left + 0.2 / columns, high - tall + 0.06 * tall, 0.76 / columns, 0.37 * tall])
            draw_section(plane, body, choose_section(asked.section, body), shade_of(bodies, asked.field))
    if asked.section != "none":
        share_limits(figure.axes)
    return figure


def share_limits(axes):
    """Sections of several bodies are drawn to one scale: those with a frame."""
    planes = [plane for plane in axes if plane.axison and plane.get_xlabel()]
    for get, put in (("get_xlim", "set_xlim"), ("get_ylim", "set_ylim")):
        limits = np.array([getattr(plane, get)() for plane in planes])
        for plane in planes:
            getattr(plane, put)(limits[:, 0].min(), limits[:, 1].max())


def make_figure(asked, bodies, width, height):
    figure = Figure(figsize=(width / 100, height / 100), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    draw_colour_bar(figure, shade_of(bodies, asked.field))
    draw_key(figure, bodies, asked)
    status = mark_of(bodies[0]) if len(bodies) == 1 else times_of(bodies[0])
    caption(figure, 0.5, 1 - 20 / height, asked.title + status, fontsize=17, weight="bold",
            color=ALARM if len(bodies) == 1 and bodies[0].status else INK)
    return figure


def mark_of(body):
    return f" – {body.status.upper()}, no answer" if body.status else ""


def times_of(body):
    return "" if body.scale == 1.0 else f", displacement × {body.scale:g}"


def show(figure, box, bodies, number, view, asked):
    """The shape of one body in a box of the figure."""
    pixels = [round(share * size) for share, size in zip(box[2:], asked.size)]
    shape = figure.add_axes(box)
    shape.imshow(draw_shape(bodies, number, view, asked, *pixels), interpolation="none", aspect="auto")
    shape.set_axis_off()


def draw_colour_bar(figure, shade):
    height = 100 * figure.get_figheight()
    bar = figure.add_axes([0.3, 56 / height, 0.4, 16 / height])
    colours = figure.colorbar(ScalarMappable(Normalize(shade.low, shade.high), colours_of(shade)), cax=bar,
                              orientation="horizontal")
    colours.locator = MaxNLocator(5)  # six labels of six digits fit side by side
    colours.update_ticks()
    colours.outline.set_visible(False)
    colours.ax.tick_params(labelsize=10, length=3, color=FAINT, labelcolor=INK)
    figure.text(0.288, 64 / height, shade.name, ha="right", va="center", fontsize=13, color=INK,
                style="italic")


def draw_key(figure, bodies, asked):
    """What arrows, dots and dashes stand for: those that are there."""
    held = [np.linalg.norm(body.reaction, axis=1) > 0 for body in bodies if body.reaction is not None]
    moves = [body.size > 0 for body in bodies if body.reaction is not None]
    forces, moments = load_arrows(bodies)
    marks = [(bool(forces), Line2D([], [], color=LOAD, marker=">", linewidth=2.2, markersize=7), "load"),
             (bool(moments), Line2D([0, 0.5, 1], [0, 0, 0], color=LOAD, marker=">", markevery=[1, 2], linewidth=2.2, markersize=7),
              "moment"),
             (any((h & ~m).any() for h, m in zip(held, moves)), Line2D([], [], color=HELD, marker="o", linewidth=0), "held"),
             (any((h & m).any() for h, m in zip(held, moves)), Line2D([], [], color=MOVED, marker="o", linewidth=0),
              "on a support that moves"),
             (asked.fibres is not None, Line2D([], [], color=FAINT, linewidth=2.2), f"fibre e{(asked.fibres or 0) + 1}"),
             (shade_of(bodies, asked.field).beyond, Line2D([], [], color=BEYOND, marker="s", linewidth=0), "more, or no failure"),
             (not all(body.envelope for body in bodies), Line2D([], [], color=FAINT, linewidth=1.2), "before")]
    shown = [(line, word) for there, line, word in marks if there]
    if not shown:  # an envelope
        return
    figure.legend(*zip(*shown), loc="lower right", bbox_to_anchor=(0.995, 8 / (100 * figure.get_figheight())), fontsize=9,
                  frameon=False, labelcolor=INK, handlelength=1.4, borderaxespad=0.0, labelspacing=0.25,
                  ncol=2 if len(shown) > 3 else 1, columnspacing=1.0)


def caption(figure, x, y, text, **style):
    figure.text(x, y, text, ha="center", va="top", **{"color": INK, **style})
