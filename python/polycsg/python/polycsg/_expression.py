"""Expressions of geometries."""

from __future__ import annotations


class Csg:
    """An expression: a geometry, or others combined by ``|``, ``&``, ``-`` and ``^``. Nothing is found before :func:`evaluate`."""

    __slots__ = ("_operands", "_program")

    def __init__(self, geometry: object) -> None:
        self._operands: list[object] = [geometry]
        self._program: list[str] = [""]

    def postfix(self) -> tuple[list[object], list[str]]:
        """The operands in their order, and what is done: an empty word takes the next one, an operator the last two results."""
        return self._operands, self._program

    def _then(self, operator: str, other: Csg) -> Csg:
        both = Csg.__new__(Csg)
        both._operands = self._operands + other._operands
        both._program = [*self._program, *other._program, operator]
        return both

    def __or__(self, other: Csg) -> Csg:
        return self._then("|", other)

    def __and__(self, other: Csg) -> Csg:
        return self._then("&", other)

    def __sub__(self, other: Csg) -> Csg:
        return self._then("-", other)

    def __xor__(self, other: Csg) -> Csg:
        return self._then("^", other)
