# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts that draw have in common: matplotlib without a display, a refusal, and a picture that is written whole."""
import os
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError as missing:
    sys.exit(f"{os.path.basename(sys.argv[0])}: {missing}; on Debian or Ubuntu: apt-get install python3-matplotlib, and run "
             "this with /usr/bin/python3")


class Refusal(Exception):
    """What to tell the user."""


def save(figure, picture, dpi):
    """Written aside and renamed: a picture that is there is whole."""
    base, ending = os.path.splitext(picture)
    aside = f"{base}.partial{ending}"
    try:
        figure.savefig(aside, dpi=dpi)
        os.replace(aside, picture)
    except (OSError, ValueError) as failure:
        if os.path.exists(aside):
            os.remove(aside)
        raise Refusal(f"{picture}: {failure}") from None
