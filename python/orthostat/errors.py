# SPDX-License-Identifier: BSD-3-Clause
"""Failures of the library as exceptions. Their text is the library's: what was found where, and what to do."""
from ._declarations import STATUSES


class OrthostatError(Exception):
    """Any failure of the library. `result`: what there is of an answer, or None."""

    result = None


class InvalidInput(OrthostatError, ValueError):
    """A case, mesh, material or axis is not usable as given."""


class FileFailed(OrthostatError, OSError):
    """A file could not be opened, read or written."""


class LimitExceeded(OrthostatError):
    """A count exceeds what a library below can number."""


class OutOfMemory(OrthostatError, MemoryError):
    """Memory could not be had."""


class LibraryFailed(OrthostatError):
    """A library below reported an error."""


class NotConverged(OrthostatError):
    """The solver stopped before the requested residual; `result` has what it reached."""


class CheckFailed(OrthostatError):
    """The answer did not pass its checks; `result` has it, marked as refused."""


class OrthostatWarning(UserWarning):
    """What the library warns of."""


_OF_STATUS = {"OST_INVALID_USAGE": InvalidInput, "OST_INVALID_INPUT": InvalidInput, "OST_FILE_FAILED": FileFailed,
              "OST_LIMIT_EXCEEDED": LimitExceeded, "OST_OUT_OF_MEMORY": OutOfMemory, "OST_LIBRARY_FAILED": LibraryFailed,
              "OST_NOT_CONVERGED": NotConverged, "OST_CHECK_FAILED": CheckFailed}


def error_of(status, text):
    name = STATUSES[status] if 0 <= status < len(STATUSES) else ""
    return _OF_STATUS.get(name, OrthostatError)(text)
