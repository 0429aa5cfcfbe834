"""Signals."""

import signal

import pytest


@pytest.fixture
def interruptible():
    """Ctrl-C interrupts, even where the tests run in the background of a shell that ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
