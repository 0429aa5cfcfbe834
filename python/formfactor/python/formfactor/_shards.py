"""Rows that were found, on disk: a folder of files that are whole or not there."""

from __future__ import annotations

import os
import uuid
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt


class ExchangeRows(NamedTuple):
    """What some polygons exchange with those of higher numbers: A F, the same in both directions."""

    #: The number of the first polygon.
    first: int
    #: Where each row begins, and the last one ends.
    starts: npt.NDArray[np.int64]
    #: The other polygons.
    to: npt.NDArray[np.uint32]
    #: The exchange areas.
    area: npt.NDArray[np.float64]
    #: Estimates of their errors.
    error: npt.NDArray[np.float64]

    @property
    def last(self) -> int:
        """The number behind that of the last polygon."""
        return self.first + len(self.starts) - 1

    @classmethod
    def load(cls, path: Path) -> ExchangeRows:
        """Reads a file."""
        with np.load(path, allow_pickle=False) as file:
            return cls(int(file["first"]), file["starts"], file["to"], file["area"], file["error"])


class Rows(NamedTuple):
    """Rows of form factors."""

    #: The number of the first polygon.
    first: int
    #: Where each row begins, and the last one ends.
    starts: npt.NDArray[np.int64]
    #: The receivers.
    columns: npt.NDArray[np.uint32]
    values: npt.NDArray[np.float64]
    #: Estimates of the factors' errors.
    errors: npt.NDArray[np.float64]

    @classmethod
    def load(cls, path: Path) -> Rows:
        """Reads a file."""
        with np.load(path, allow_pickle=False) as file:
            return cls(int(file["first"]), file["starts"], file["columns"], file["values"], file["errors"])


def save(path: Path, arrays: Mapping[str, Any]) -> None:
    """Writes a file that is whole once it has its name."""
    unfinished = path.with_name(f".{path.name}.{uuid.uuid4().hex}.tmp")
    try:
        with open(unfinished, "xb") as file:
            np.savez(file, **arrays)
            file.flush()
            os.fsync(file.fileno())
        os.replace(unfinished, path)
    finally:
        unfinished.unlink(missing_ok=True)


def shard(folder: Path, first: int, last: int) -> Path:
    """The file of the rows from one number to before another one."""
    return folder / f"rows-{first:09}-{last:09}.npz"


def claim(folder: Path, fingerprint: str) -> None:
    """Makes a folder that of one question; one of another question is refused."""
    folder.mkdir(parents=True, exist_ok=True)
    label = folder / "question.sha256"
    try:
        with open(label, "x", encoding="ascii") as file:
            file.write(fingerprint)
    except FileExistsError:
        if label.read_text(encoding="ascii") != fingerprint:
            raise ValueError(
                f"{folder} holds rows of another scene, tolerance or version; name another folder"
            ) from None
