"""The examples in the documentation run."""

import doctest
import importlib
import pkgutil

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
