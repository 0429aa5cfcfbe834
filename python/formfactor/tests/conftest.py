"""Rooms and signals."""

import signal

import numpy as np
import pytest


def box(low, high, parts, inward):
    """The faces of a box, each in parts x parts squares."""
    squares = []
    low, high = np.array(low, float), np.array(high, float)
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end, flip in ((low, not inward), (high, inward)):
            steps = [np.linspace(low[k], high[k], parts + 1) for k in (u, v)]
            for i in range(parts):
                for j in range(parts):
                    corners = np.empty((4, 3))
                    corners[:, axis] = end[axis]
                    corners[:, u] = steps[0][[i, i + 1, i + 1, i]]
                    corners[:, v] = steps[1][[j, j, j + 1, j + 1]]
                    squares.append(corners[::-1] if flip else corners)
    return np.array(squares)


@pytest.fixture(scope="session")
def room():
    """A closed room with a box in it: polygons (k, 4, 3)."""
    return np.concatenate([box((0, 0, 0), (3, 3, 3), 3, True), box((1, 1.2, 0.9), (1.7, 2, 1.8), 1, False)])


@pytest.fixture
def interruptible():
    """Ctrl-C interrupts, even where the tests run in the background of a shell that ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
