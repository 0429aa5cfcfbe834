"""The corpus of the Rust crates: the areas that it names, and results that shapely takes for valid."""

import json
from pathlib import Path

import pytest

import polycsg

CASES = sorted((Path(__file__).parents[3] / "tests/corpus").glob("*.json"))
FILLS = {"even-odd": "evenodd", "non-zero": "nonzero", "positive": "positive"}


def operand(given):
    """Rings are read under a rule of their own: as one geometry of polygons without holes."""
    polygons = [[ring] for ring in given["rings"] if ring]
    return polycsg.make_valid({"type": "MultiPolygon", "coordinates": polygons}, fill=FILLS[given["rule"]])


@pytest.mark.skipif(not CASES, reason="the corpus stands in the repository")
@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_areas_and_validity(path):
    case = json.loads(path.read_text())
    a, b = operand(case["a"]), operand(case["b"])
    for operation in ("union", "intersection", "difference", "symmetric_difference"):
        region = getattr(polycsg, operation)(a, b)
        assert polycsg.is_valid(region), polycsg.is_valid_reason(region)
        assert region.to_shapely().is_valid
        if operation in case.get("areas", {}):
            wanted = case["areas"][operation]
            assert region.area == pytest.approx(wanted, rel=1e-9, abs=1e-12), operation
