# SPDX-License-Identifier: BSD-3-Clause
"""The C library: its handles, its arrays as numpy's, and its structs as Python's."""
import atexit
import itertools
import os
import sys
import types
import weakref

import numpy

from ._declarations import ffi
from ._location import LIBRARY
from .errors import OrthostatError


def _open():
    """Beside this package as it was built or installed, or else where the system looks for libraries."""
    path = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), LIBRARY))
    return ffi.dlopen(path if os.path.exists(path) else os.path.basename(path))


lib = _open()


_alive = {}  # of all handles: how each is destroyed, in the order of making
_keys = itertools.count()


class Group:
    """The handles of one communicator. Its ranks make them together, and destroy them together: Python's collector comes
    when it likes, and elsewhere on each rank. So a handle that is dropped waits until it is dropped on all of them."""

    def __init__(self, size):
        self.size, self.made, self.dropped = size, 0, {}

    def drop(self, number, key):
        if self.size == 1:
            _destroy(key)
        else:
            self.dropped[number] = key

    def collect(self, gather):
        """Collective. Destroys what all ranks have dropped; `gather` joins arrays of all of them."""
        if self.size == 1:
            return
        numbers, ranks = numpy.unique(gather(numpy.array(sorted(self.dropped), numpy.int64)), return_counts=True)
        for number in numbers[ranks == self.size][::-1].tolist():
            _destroy(self.dropped.pop(number))


class Handle:
    """A handle of the library, destroyed when nothing refers to it any more, before what it was made of (`parents`)."""

    def __init__(self, pointer, destroy, group, *parents):
        self.parents = parents
        key = next(_keys)
        _alive[key] = destroy, ffi.new(ffi.getctype(ffi.typeof(pointer), "*"), pointer), group
        weakref.finalize(self, group.drop, group.made, key).atexit = False
        group.made += 1


def _destroy(key):
    destroy, box, _ = _alive.pop(key, (None, None, None))
    if destroy:
        destroy(box)


@atexit.register
def _end():
    """All handles, and then MPI, where the library started it. A rank that ends by an exception of its own does not wait
    for the others, whom mpirun then ends."""
    failed = getattr(sys, "last_type", None)
    if failed and not issubclass(failed, OrthostatError) and any(group.size > 1 for _, _, group in _alive.values()):
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(1)
    for key in sorted(_alive, reverse=True):
        _destroy(key)
    lib.ost_end_mpi()


_DTYPES = {"double": numpy.dtype(float), "int32_t": numpy.dtype(numpy.int32), "int64_t": numpy.dtype(numpy.int64),
           "int": numpy.dtype(numpy.intc)}


class _Memory:
    """Memory of the library, as numpy asks for it; `owner` is what keeps it."""

    def __init__(self, address, shape, dtype, owner):
        self.owner = owner
        self.__array_interface__ = {"version": 3, "data": (address, True), "shape": shape, "typestr": dtype.str}


def view(pointer, shape, owner):
    """An array on the library's memory, without a copy and not to be written to; keeps `owner` alive. None for NULL."""
    if pointer == ffi.NULL:
        return None
    dtype = _DTYPES[ffi.typeof(pointer).item.cname]
    if 0 in shape:
        return numpy.empty(shape, dtype)
    return numpy.asarray(_Memory(int(ffi.cast("uintptr_t", pointer)), tuple(shape), dtype, owner))


def array(values, shape, what, dtype=float):
    """`values` as a contiguous array for the library; a number of `shape` that is None may be any. Not copied where it
    is one already."""
    given = numpy.asarray(values)
    if given.dtype.kind == "c":
        raise ValueError(f"{what}: real numbers are wanted, and these are complex")
    made = numpy.ascontiguousarray(given, dtype)
    if given.dtype.kind in "fiu" and given.dtype != made.dtype and made.dtype.kind == "i" and not (made == given).all():
        raise ValueError(f"{what}: whole numbers are wanted, up to {numpy.iinfo(dtype).max}, and these are others")
    if made.ndim != len(shape) or any(wanted not in (None, found) for wanted, found in zip(shape, made.shape)):
        words = " × ".join("any" if number is None else str(number) for number in shape)
        raise ValueError(f"{what}: an array of {words} is wanted, and this is {' × '.join(map(str, made.shape)) or 'a number'}")
    return made


def pointer_to(values):
    """The memory of a contiguous array, which what is returned keeps; NULL for None."""
    if values is None:
        return ffi.NULL
    name = next(name for name, dtype in _DTYPES.items() if dtype == values.dtype)
    return ffi.from_buffer(name + "[]", values)


def text_of(pointer):
    return None if pointer == ffi.NULL else ffi.string(pointer).decode("utf-8", "replace")


def struct(value):
    """A struct of the library with all that it holds, copied: numbers, texts, arrays, structs."""
    fields = ffi.typeof(value).fields
    return types.SimpleNamespace(**{name: _member(getattr(value, name), field.type) for name, field in fields})


def _member(value, kind):
    if kind.kind == "struct":
        return struct(value)
    if kind.kind == "pointer":
        return text_of(value) if kind.item.cname == "char" else value
    if kind.kind != "array":
        return value
    if kind.item.cname == "char":
        return text_of(value)
    if kind.item.kind == "primitive":
        return numpy.array(list(value), _DTYPES.get(kind.item.cname))
    return [_member(item, kind.item) for item in value]
