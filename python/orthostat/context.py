# SPDX-License-Identifier: BSD-3-Clause
"""The processes that work together, and what they have to say."""
import warnings

import numpy

from ._declarations import PHASES
from ._library import Group, Handle, ffi, lib, text_of
from .errors import OrthostatWarning, error_of

_LEVELS = {"quiet": "OST_LOG_QUIET", "normal": "OST_LOG_NORMAL", "verbose": "OST_LOG_VERBOSE"}


class Context:
    """A communicator with its log, its warnings and its account of seconds and bytes.

    comm: a communicator of mpi4py, which is duplicated, or None: all processes (MPI is started if nobody has done so
    yet, so that a script runs under mpirun without mpi4py).
    """

    def __init__(self, comm=None):
        box = ffi.new("OstContext **")
        status = lib.ost_context_create_on_all(box) if comm is None else lib.ost_context_create_by_number(comm.py2f(), box)
        if status:
            raise error_of(status, "MPI could not be started, or gave no communicator")
        self.pointer = box[0]
        self.group = Group(self.size)
        self.handle = Handle(self.pointer, lib.ost_context_destroy, self.group)
        self._told = 0
        self.log_level = "quiet"

    @property
    def rank(self):
        return lib.ost_rank(self.pointer)

    @property
    def size(self):
        return lib.ost_size(self.pointer)

    @property
    def log_level(self):
        """What rank 0 prints to standard error: "quiet", "normal" or "verbose". Warnings come as Python's anyway."""
        level = lib.ost_log_level(self.pointer)
        return next(word for word, name in _LEVELS.items() if getattr(lib, name) == level)

    @log_level.setter
    def log_level(self, word):
        if word not in _LEVELS:
            raise ValueError(f"log_level: '{word}' is none of {', '.join(_LEVELS)}")
        lib.ost_log_set_level(self.pointer, getattr(lib, _LEVELS[word]))

    @property
    def warnings(self):
        """All warnings so far (on rank 0)."""
        return [text_of(lib.ost_warning(self.pointer, i)) for i in range(lib.ost_warning_count(self.pointer))]

    def ledger(self):
        """{account: (seconds, bytes held, most bytes held)} of this rank, of all accounts that were opened."""
        accounts = {}
        for account in range(lib.OST_LEDGER_ACCOUNTS):
            entry = lib.ost_ledger_entry(self.pointer, account)
            label = text_of(lib.ost_ledger_label(self.pointer, account))
            if entry.entries > 0 or account < len(PHASES):
                accounts[label or str(account)] = (entry.seconds, entry.bytes, entry.peak_bytes)
        return accounts

    def box(self, kind):
        """Collective. Room for a handle that is about to be made, after those that all ranks have dropped are gone."""
        self.collect()
        return ffi.new(kind + " **")

    def handle_of(self, pointer, destroy, *parents):
        return Handle(pointer, destroy, self.group, self, *parents)

    def collect(self):
        """Collective. Frees what all ranks have dropped. (On one rank that is freed at once; on several, here, and when
        something new is made.)"""
        self.group.collect(self.gather)

    def gather(self, values):
        """Collective. The rows of all ranks' arrays, in the order of ranks, on every rank."""
        values = numpy.ascontiguousarray(values)
        size = values.dtype.itemsize * int(numpy.prod(values.shape[1:], dtype=int))
        memory, total = ffi.new("void **"), ffi.new("OstLocal *")
        data = ffi.cast("void *", values.ctypes.data)
        self.check(lib.ost_gather(self.pointer, size, data, len(values), memory, total))
        whole = numpy.frombuffer(ffi.buffer(memory[0], total[0] * size), values.dtype).reshape(-1, *values.shape[1:]).copy()
        lib.ost_free_memory(memory[0])
        return whole

    def check(self, status, result=None):
        """Collective. Warns of what the library has warned of since the last call; raises a failure."""
        said = self.warnings
        for text in said[self._told:]:
            warnings.warn(text, OrthostatWarning, stacklevel=4)
        self._told = len(said)
        if status:
            error = error_of(status, text_of(lib.ost_error_text(self.pointer)))
            error.result = result
            raise error


_default = None
_keyval = None  # under which communicators of mpi4py keep their contexts


def context_of(comm):
    """A context as it is; for None that of all processes; and that of a communicator. Each is made once."""
    global _default, _keyval
    if isinstance(comm, Context):
        return comm
    if comm is None:
        _default = _default or Context()
        return _default
    if _keyval is None:
        _keyval = type(comm).Create_keyval()
    context = comm.Get_attr(_keyval)
    if context is None:
        context = Context(comm)
        comm.Set_attr(_keyval, context)
    return context
