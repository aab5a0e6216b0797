# SPDX-License-Identifier: BSD-3-Clause
"""A display where there is none."""
import ctypes
import os
import signal
import subprocess

PR_SET_PDEATHSIG = 1  # Linux: a child ends with its parent, however that ends


class NoDisplay(Exception):
    """Why there is none, and what to do."""


class Display:
    """A display of our own: VTK as Debian builds it draws with X even off screen."""

    def __enter__(self):
        reading, writing = os.pipe()
        try:
            self.server = subprocess.Popen(
                ["Xvfb", "-displayfd", str(writing), "-screen", "0", "64x64x24", "-nolisten", "tcp", "-noreset"],
                pass_fds=[writing], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                preexec_fn=lambda: ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM))
        except FileNotFoundError:
            self.server = None
        os.close(writing)
        with os.fdopen(reading) as answer:
            number = answer.readline().strip() if self.server else ""
        if number:
            os.environ["DISPLAY"] = ":" + number
        elif not os.environ.get("DISPLAY"):
            self.__exit__()
            raise NoDisplay("there is no display to draw on and Xvfb did not start; apt-get install xvfb")
        return self

    def __exit__(self, *_):
        if self.server:
            self.server.terminate()
            self.server.wait()
