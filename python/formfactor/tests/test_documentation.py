"""The examples in the documentation run."""

import doctest
import importlib
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest

import formfactor

MODULES = ["formfactor", *(f"formfactor.{found.name}" for found in pkgutil.iter_modules(formfactor.__path__))]


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_everything_public_is_documented():
    for name in formfactor.__all__:
        thing = getattr(formfactor, name)
        assert name == "__version__" or thing.__doc__, name
        for attribute in vars(thing) if isinstance(thing, type) else ():
            member = vars(thing)[attribute]
            assert (
                attribute.startswith("_") or not (callable(member) or isinstance(member, property)) or member.__doc__
            ), attribute


@pytest.mark.parametrize(("example", "needs"), [("exposure", "matplotlib"), ("town", "pyvista")])
def test_examples_draw(example, needs, tmp_path):
    pytest.importorskip(needs, exc_type=ImportError)
    script, picture = Path(__file__).parents[1] / "examples" / f"{example}.py", tmp_path / "picture.png"
    subprocess.run([sys.executable, script, picture], check=True, cwd=tmp_path)
    assert picture.stat().st_size > 50_000
