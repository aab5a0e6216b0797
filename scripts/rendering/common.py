# SPDX-License-Identifier: BSD-3-Clause
"""What all of this folder share: a refusal, and the colours of lines, words, and what is beyond the range."""
INK, FAINT, ALARM, BEYOND = "#30363d", "#8b949e", "#c00000", "#d8dce0"
SHARPNESS = 2  # the shape is drawn this much larger, then averaged down


class Refusal(Exception):
    """Something about the request, in words for the person who made it."""
