"""The examples in the documentation run."""

import doctest
import importlib
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest

import polycsg

MODULES = ["polycsg", *(f"polycsg.{found.name}" for found in pkgutil.iter_modules(polycsg.__path__))]


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_everything_public_is_documented():
    for name in polycsg.__all__:
        thing = getattr(polycsg, name)
        assert name == "__version__" or thing.__doc__, name
        for attribute in vars(thing) if isinstance(thing, type) else ():
            member = vars(thing)[attribute]
            assert (
                attribute.startswith("_") or not (callable(member) or isinstance(member, property)) or member.__doc__
            ), attribute


def test_the_picture_is_that_of_the_readme():
    folder = Path(__file__).parents[1]
    drawn = subprocess.run([sys.executable, folder / "examples/picture.py"], check=True, capture_output=True, text=True)
    assert drawn.stdout == (folder / "docs/picture.svg").read_text()
