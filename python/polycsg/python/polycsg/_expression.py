"""Expressions of geometries."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np


class Csg:
    """An expression: a geometry, or others combined by ``|``, ``&``, ``-`` and ``^``. Nothing is found before
    :func:`evaluate`.

    >>> import numpy as np
    >>> from polycsg import evaluate
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> evaluate(Csg.union([square, square + 1, square + 2]) - Csg(square + 1)).area
    6.0
    """

    __slots__ = ("_operands", "_program")

    def __init__(self, geometry: object) -> None:
        self._operands: list[object] = [geometry]
        self._program: list[str] = [""]

    @classmethod
    def union(cls, geometries: Iterable[object]) -> Csg:
        """All points in any of geometries or expressions."""
        return cls._of("|", geometries)

    @classmethod
    def intersection(cls, geometries: Iterable[object]) -> Csg:
        """All points in every one of geometries or expressions."""
        return cls._of("&", geometries)

    @classmethod
    def symmetric_difference(cls, geometries: Iterable[object]) -> Csg:
        """All points in an odd number of geometries or expressions."""
        return cls._of("^", geometries)

    @classmethod
    def _of(cls, operator: str, geometries: Iterable[object]) -> Csg:
        found: Csg | None = None
        for geometry in geometries:
            next = geometry if isinstance(geometry, Csg) else cls(geometry)
            if found is None:
                found = cls.__new__(cls)
                found._operands, found._program = [*next._operands], [*next._program]
            else:
                found._operands += next._operands
                found._program += [*next._program, operator]
        return cls(np.empty((0, 2))) if found is None else found

    def postfix(self) -> tuple[list[object], list[str]]:
        """The operands in their order, and what is done: an empty word takes the next one, an operator the last two
        results."""
        return self._operands, self._program

    def __or__(self, other: object) -> Csg:
        return Csg._of("|", [self, other])

    def __and__(self, other: object) -> Csg:
        return Csg._of("&", [self, other])

    def __sub__(self, other: object) -> Csg:
        return Csg._of("-", [self, other])

    def __xor__(self, other: object) -> Csg:
        return Csg._of("^", [self, other])
