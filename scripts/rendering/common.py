# SPDX-License-Identifier: BSD-3-Clause
"""What all of this folder share: a refusal, and the colours of lines and words."""
INK, FAINT, ALARM = "#30363d", "#8b949e", "#c00000"
SHARPNESS = 2  # the shape is drawn this much larger, then averaged down


class Refusal(Exception):
    """Something about the request, in words for the person who made it."""
