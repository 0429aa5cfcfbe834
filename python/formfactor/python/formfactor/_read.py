"""Polygons and meshes in the forms that people have, as ragged arrays."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ._formfactor import GeometryError

#: Doubles hold all integers up to this.
_EXACT = 2**53

#: meshio's cells that are surfaces.
_SURFACES = ("triangle", "quad", "polygon")


class Polygons(NamedTuple):
    """Vertices (n, 3), and where the loops begin in them, and the polygons in the loops."""

    vertices: npt.NDArray[np.float64]
    loops: npt.NDArray[np.int64]
    polygons: npt.NDArray[np.int64]


def read_polygon(polygon: object) -> Polygons:
    """One polygon: a loop (n, 3), or a tuple of loops, of which the first is the outer one."""
    loops = [doubles(loop) for loop in polygon] if _is_tuple_of_loops(polygon) else [doubles(polygon)]  # type: ignore[attr-defined]
    return Polygons(np.concatenate(loops), ends([len(loop) for loop in loops]), np.array([0, len(loops)]))


def read(geometry: object) -> Polygons:
    """A mesh, or polygons."""
    if isinstance(geometry, np.ndarray) and geometry.dtype != object:
        return _of_alike(geometry)
    if _is_mesh(geometry):
        return _of_faces(*geometry)  # type: ignore[misc]
    for vertices in ("vertices", "points"):
        if hasattr(geometry, vertices):
            return _of_mesh(geometry, getattr(geometry, vertices))
    if isinstance(geometry, Iterable) and not isinstance(geometry, str | bytes):
        parts = []
        for number, polygon in enumerate(geometry):
            try:
                parts.append(read_polygon(polygon))
            except GeometryError as error:
                raise GeometryError(f"polygon {number}: {error}") from None
        return joined(parts)
    raise GeometryError(f"a {type(geometry).__name__} is no mesh; give polygons, or vertices and faces")


def joined(parts: Sequence[Polygons]) -> Polygons:
    """All polygons of several."""
    vertices = np.concatenate([np.empty((0, 3)), *(part.vertices for part in parts)])
    loops = ends(np.concatenate([np.empty(0, np.int64), *(np.diff(part.loops) for part in parts)]))
    return Polygons(
        vertices, loops, ends(np.concatenate([np.empty(0, np.int64), *(np.diff(part.polygons) for part in parts)]))
    )


def ends(counts: Any) -> npt.NDArray[np.int64]:
    """Where each begins, and the last one ends."""
    return np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)


def doubles(points: object) -> npt.NDArray[np.float64]:
    """Points (n, 3) as doubles, the same numbers."""
    try:
        array = points if isinstance(points, np.ndarray) else np.asarray(points)
    except ValueError as error:
        raise GeometryError(f"points have three coordinates each: {error}") from None
    if np.ma.is_masked(array):
        raise GeometryError("coordinates are masked; leave out what is missing")
    if array.ndim != 2 or array.shape[1] != 3:
        raise GeometryError(f"points have the shape (n, 3), not {array.shape}")
    if array.dtype.kind not in "fiu" or array.dtype.itemsize > 8:
        raise GeometryError(f"coordinates are numbers that fit in doubles, not {array.dtype}")
    if array.dtype.kind != "f" and array.size and (array.max() > _EXACT or array.min() < -_EXACT):
        raise GeometryError("an integer coordinate lies beyond 2**53, where doubles leave numbers out")
    return np.ascontiguousarray(array, dtype=np.float64)


def integers(numbers: object, what: str) -> npt.NDArray[np.int64]:
    """A row of integers."""
    array = np.asarray(numbers)
    if array.size == 0:
        array = array.astype(np.int64)
    if array.ndim != 1 or array.dtype.kind not in "iu":
        raise ValueError(f"{what} are a row of integers, not {array.dtype} of shape {array.shape}")
    return np.ascontiguousarray(array, dtype=np.int64)


def _is_tuple_of_loops(value: object) -> bool:
    return isinstance(value, tuple) and len(value) > 0 and np.ndim(value[0]) == 2


def _is_mesh(value: object) -> bool:
    if not isinstance(value, tuple) or len(value) != 2:
        return False
    return all(isinstance(part, np.ndarray) and part.ndim == 2 for part in value) and value[1].dtype.kind in "iu"


def _of_alike(polygons: npt.NDArray[Any]) -> Polygons:
    if polygons.ndim != 3:
        raise GeometryError(f"polygons have the shape (k, n, 3), not {polygons.shape}")
    count, corners = polygons.shape[:2]
    return Polygons(
        doubles(polygons.reshape(-1, polygons.shape[2])), np.arange(count + 1) * corners, np.arange(count + 1)
    )


def _of_mesh(mesh: Any, points: Any) -> Polygons:
    points = np.asarray(points)
    if hasattr(mesh, "cells") and isinstance(mesh.cells, list):
        blocks = [block for block in mesh.cells if block.type in _SURFACES]
        return joined([_of_faces(points, np.asarray(block.data)) for block in blocks])
    faces = mesh.faces
    if hasattr(mesh, "is_all_triangles") and np.ndim(faces) == 1:
        return _of_counted(points, np.asarray(faces))
    return _of_faces(points, np.asarray(faces))


def _of_counted(points: npt.NDArray[Any], faces: npt.NDArray[Any]) -> Polygons:
    """Faces each with its number of corners before them, as pyvista has them."""
    counts, corners, at = [], [], 0
    while at < len(faces):
        count = int(faces[at])
        if count < 1 or at + 1 + count > len(faces):
            raise GeometryError(f"faces are cut short in place {at}")
        counts.append(count)
        corners.append(faces[at + 1 : at + 1 + count])
        at += 1 + count
    chosen = np.concatenate([np.empty(0, np.int64), *corners])
    return Polygons(_chosen(points, chosen), ends(counts), np.arange(len(counts) + 1))


def _of_faces(points: npt.NDArray[Any], faces: npt.NDArray[Any]) -> Polygons:
    if faces.ndim != 2 or faces.dtype.kind not in "iu":
        raise GeometryError(f"faces are integers of the shape (m, k), not {faces.dtype} of {faces.shape}")
    count, corners = faces.shape
    return Polygons(_chosen(points, faces.ravel()), np.arange(count + 1) * corners, np.arange(count + 1))


def _chosen(points: npt.NDArray[Any], corners: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    wrong = (corners < 0) | (corners >= len(points))
    if wrong.any():
        raise GeometryError(f"there are {len(points)} vertices, none has the number {corners[wrong][0]}")
    return np.ascontiguousarray(doubles(points)[corners])
