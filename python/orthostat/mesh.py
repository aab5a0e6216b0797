# SPDX-License-Identifier: BSD-3-Clause
"""Meshes: from arrays, from files, and as the ranks share them."""
import os

import numpy

from ._library import array, ffi, lib, pointer_to, text_of, view
from .context import context_of

_DIMENSIONS = {4: {1: 0, 2: 1, 3: 2}, 10: {1: 0, 3: 1, 6: 2}}  # of a boundary's items, by their nodes


class MeshArrays:
    """A mesh of tets as a program holds it, in numpy's arrays. Numbers of nodes count from 0.

    points: (nodes, 3).  tets: (tets, 4 or 10), vertices positively oriented, mid-edge nodes in VTK's order.
    regions: (tets,), numbers into region_names.  boundaries: {name: (items, nodes of an item)}: points, curves or faces.
    axes: (tets, 3, 3), rows e1 e2 e3; a case takes them where its material says `axes: {cells: mesh}`.

    Under MPI the arrays of rank 0 are the mesh, and those of the others are not looked at (they may be left out); with
    spread=True each rank brings a share, whose nodes and tets follow those of the ranks before it.
    """

    def __init__(self, points=(), tets=(), regions=None, region_names=("body",), boundaries=None, axes=None, spread=False):
        self.spread = spread
        self.points = array(numpy.reshape(points, (0, 3)) if len(points) == 0 else points, (None, 3), "points")
        tets = numpy.asarray(tets)
        self.tets = array(tets.reshape(0, 4) if tets.size == 0 else tets, (None, None), "tets", numpy.int64)
        if self.tets.shape[1] not in _DIMENSIONS:
            raise ValueError(f"tets: a tet has 4 or 10 nodes, and these have {self.tets.shape[1]}")
        count = len(self.tets)
        self.regions = None if regions is None else array(regions, (count,), "regions", numpy.int32)
        self.region_names = tuple(region_names)
        self.boundaries = {name: self._items(name, items) for name, items in (boundaries or {}).items()}
        self.axes = None if axes is None else array(axes, (count, 3, 3), "axes")

    def _items(self, name, items):
        items = numpy.asarray(items)
        items = array(items[:, None] if items.ndim == 1 else items, (None, None), f"boundary '{name}'", numpy.int64)
        widths = _DIMENSIONS[self.tets.shape[1]]
        if items.shape[1] not in widths:
            raise ValueError(f"boundary '{name}': its items have {items.shape[1]} nodes; they can have "
                             f"{', '.join(map(str, widths))} (points, curves, faces)")
        return items

    def chunk(self, context):
        """Collective. The library's own copy, before it is spread over the ranks."""
        keep = []  # what the struct points to
        box = ffi.new("OstMeshChunk **")
        arrays = self._struct(keep) if self.spread or context.rank == 0 else ffi.NULL
        context.check(lib.ost_chunk_create_from_arrays(context.pointer, arrays, box))
        return box

    def _struct(self, keep):
        def names(words):
            texts = [ffi.new("char[]", word.encode()) for word in words]
            keep.extend(texts)
            return texts

        boundaries = ffi.new("OstBoundaryArrays[]", len(self.boundaries))
        widths = _DIMENSIONS[self.tets.shape[1]]
        for item, name, nodes in zip(boundaries, names(self.boundaries), self.boundaries.values()):
            item.name, item.dimension, item.count, item.nodes = name, widths[nodes.shape[1]], len(nodes), pointer_to(nodes)
        regions = ffi.new("char *[]", names(self.region_names))
        arrays = ffi.new("OstMeshArrays *", {
            "nodes_per_tet": self.tets.shape[1], "node_count": len(self.points), "coordinates": pointer_to(self.points),
            "tet_count": len(self.tets), "tet_nodes": pointer_to(self.tets), "tet_axes": pointer_to(self.axes),
            "tet_region": pointer_to(self.regions), "region_count": len(self.region_names),
            "region_names": ffi.cast("const char *const *", regions), "boundary_count": len(self.boundaries),
            "boundaries": boundaries})
        keep += [boundaries, regions]
        return arrays


class MeshFile:
    """A mesh file of any kind that the library reads."""

    def __init__(self, path):
        self.path = path

    def chunk(self, context):
        box = ffi.new("OstMeshChunk **")
        context.check(lib.ost_chunk_read(context.pointer, os.fsencode(self.path), box))
        return box


class Mesh:
    """One rank's piece of a mesh: the nodes it owns, then copies of its neighbours' (ghosts); likewise tets.

    Made from MeshArrays or the path of a mesh file; a scene has one too. On one rank there are no ghosts. Arrays are the
    library's, without copies.
    """

    def __init__(self, source, comm=None):
        context = context_of(comm)
        source = source if hasattr(source, "chunk") else MeshFile(source)
        box, chunk = context.box("OstMesh"), source.chunk(context)
        try:
            context.check(lib.ost_mesh_distribute(context.pointer, chunk, box))
        finally:
            lib.ost_chunk_destroy(chunk)
        self._take(context, box[0], context.handle_of(box[0], lib.ost_mesh_destroy))

    def _take(self, context, pointer, owner):
        self.context, self.pointer, self.owner = context, pointer, owner

    @classmethod
    def borrowed(cls, context, pointer, owner):
        """The mesh of something that keeps it (`owner`)."""
        mesh = cls.__new__(cls)
        mesh._take(context, ffi.cast("OstMesh *", pointer), owner)
        return mesh

    def __repr__(self):
        return f"<orthostat.Mesh: {self.global_nodes} nodes, {self.global_tets} tets of {self.nodes_per_tet} nodes>"

    def _made(self, make, *arguments):
        box = self.context.box("OstMesh")
        self.context.check(make(self.pointer, *arguments, box))
        return Mesh.borrowed(self.context, box[0], self.context.handle_of(box[0], lib.ost_mesh_destroy))

    def quadratic(self):
        """Collective. The same tets with 10 nodes."""
        return self._made(lib.ost_mesh_raise, ffi.NULL)

    def refined(self):
        """Collective. Eight tets of each."""
        return self._made(lib.ost_mesh_refine, ffi.NULL)

    nodes_per_tet = property(lambda self: lib.ost_mesh_nodes_per_tet(self.pointer))
    global_nodes = property(lambda self: lib.ost_mesh_global_nodes(self.pointer), doc="over all ranks")
    global_tets = property(lambda self: lib.ost_mesh_global_tets(self.pointer), doc="over all ranks")
    node_count = property(lambda self: lib.ost_mesh_node_count(self.pointer), doc="here, ghosts included")
    owned_nodes = property(lambda self: lib.ost_mesh_owned_nodes(self.pointer), doc="the first ones are this rank's own")
    tet_count = property(lambda self: lib.ost_mesh_tet_count(self.pointer), doc="here, ghosts included")
    owned_tets = property(lambda self: lib.ost_mesh_owned_tets(self.pointer), doc="the first ones are this rank's own")

    def _view(self, pointer, *shape):
        return view(pointer, shape, self.owner)

    @property
    def points(self):
        """(node_count, 3)"""
        return self._view(lib.ost_mesh_coordinates(self.pointer), self.node_count, 3)

    @property
    def tets(self):
        """(tet_count, 4 or 10), numbers of local nodes"""
        return self._view(lib.ost_mesh_tet_nodes(self.pointer), self.tet_count, self.nodes_per_tet)

    @property
    def node_labels(self):
        """(node_count,): numbers of the file (plus 1 if that counts from 0), or those of the caller's arrays plus 1"""
        return self._view(lib.ost_mesh_node_labels(self.pointer), self.node_count)

    @property
    def tet_labels(self):
        """(tet_count,)"""
        return self._view(lib.ost_mesh_tet_labels(self.pointer), self.tet_count)

    @property
    def regions(self):
        """(tet_count,): numbers into region_names"""
        return self._view(lib.ost_mesh_tet_regions(self.pointer), self.tet_count)

    @property
    def axes(self):
        """(tet_count, 3, 3), rows e1 e2 e3, as they came with the mesh; None if none did"""
        return self._view(lib.ost_mesh_tet_axes(self.pointer), self.tet_count, 3, 3)

    @property
    def region_names(self):
        return [text_of(lib.ost_mesh_region_name(self.pointer, i)) for i in range(lib.ost_mesh_region_count(self.pointer))]

    @property
    def boundary_names(self):
        count = lib.ost_mesh_boundary_count(self.pointer)
        return [text_of(lib.ost_mesh_boundary_name(self.pointer, i)) for i in range(count)]

    def boundary(self, name):
        """(items, nodes of an item): local nodes of the points, curves or faces that touch a node of this rank's own."""
        number = lib.ost_mesh_find_boundary(self.pointer, name.encode())
        if number < 0:
            raise KeyError(f"there is no boundary '{name}'; there are: {', '.join(self.boundary_names)}")
        width, nodes = ffi.new("int *"), ffi.new("OstGlobal const **")
        count = lib.ost_mesh_boundary_items(self.pointer, number, width, nodes)
        return self._view(nodes[0], count, width[0])

    def centroids(self):
        """(tet_count, 3): the mean of each tet's vertices"""
        return self.points[self.tets[:, :4]].mean(axis=1) if self.tet_count else numpy.empty((0, 3))

    # --- arrays over the whole body ---

    def share(self, whole):
        """Collective. Of an array over all nodes, as gather_nodes gives it, the rows of this rank's own (a copy)."""
        whole, labels = numpy.asarray(whole), self.node_labels[:self.owned_nodes]
        place = numpy.searchsorted(numpy.sort(self.context.gather(labels)), labels)
        if numpy.shape(whole)[:1] != (self.global_nodes,):
            raise ValueError(f"share: rows for all {self.global_nodes} nodes are wanted, and this is of shape {whole.shape}")
        return whole[place]

    def gather_nodes(self, values):
        """Collective. Of an array over this rank's nodes, the rows of all nodes of the body in the order of their labels,
        on every rank. (The labels of MeshArrays are in the order of their points.)"""
        return self._gather("gather_nodes", self.node_labels, self.owned_nodes, values)

    def gather_tets(self, values):
        """Collective. The same over tets."""
        return self._gather("gather_tets", self.tet_labels, self.owned_tets, values)

    def whole(self):
        """Collective. (points, tets) of the whole body on every rank, in the order of gather_nodes and gather_tets."""
        labels = self.context.gather(self.node_labels[:self.owned_nodes])
        tets = self.gather_tets(self.node_labels[self.tets[:self.owned_tets]])
        return self.gather_nodes(self.points), numpy.searchsorted(numpy.sort(labels), tets)

    def _gather(self, name, labels, owned, values):
        values = numpy.asarray(values)
        if numpy.shape(values)[:1] not in ((len(labels),), (owned,)):
            raise ValueError(f"{name}: a row of each of this rank's {len(labels)} is wanted, or of each of its own {owned}, "
                             f"and this is of shape {values.shape}")
        return self.context.gather(values[:owned])[numpy.argsort(self.context.gather(labels[:owned]), kind="stable")]
