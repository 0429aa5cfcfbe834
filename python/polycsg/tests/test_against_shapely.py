"""The laws of Booleans, and shapely's answers where the input is ordinary."""

import math

import hypothesis.strategies as st
import numpy as np
import pytest
import shapely
from hypothesis import given, settings

import polycsg

OPERATIONS = {
    polycsg.union: shapely.union,
    polycsg.intersection: shapely.intersection,
    polycsg.difference: shapely.difference,
    polycsg.symmetric_difference: shapely.symmetric_difference,
}


def outline(count, seed):
    """A wobbling ring around somewhere near 0, without crossings."""
    rng = np.random.default_rng(seed)
    angles = np.linspace(0, math.tau, count, endpoint=False)
    radii = 1 + rng.uniform(-0.4, 0.4, count)
    return rng.uniform(-0.8, 0.8, 2) + radii[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])


outlines = st.builds(outline, st.integers(3, 60), st.integers(0, 2**32 - 1))
lattice_ring = st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=3, max_size=8)


@pytest.mark.parametrize("operation", OPERATIONS, ids=lambda operation: operation.__name__)
@given(a=outlines, b=outlines)
@settings(max_examples=100, deadline=None)
def test_areas_are_shapelys(operation, a, b):
    mine = operation(a, b)
    its = OPERATIONS[operation](shapely.Polygon(a), shapely.Polygon(b))
    assert mine.area == pytest.approx(its.area, rel=1e-12, abs=1e-14)
    assert mine.is_empty or mine.to_shapely().is_valid
    assert shapely.symmetric_difference(mine.to_shapely(), its).area < 1e-13


@given(a=lattice_ring, b=lattice_ring)
@settings(max_examples=300, deadline=None)
def test_nasty_rings_give_valid_results(a, b):
    for operation in OPERATIONS:
        region = operation(a, b)
        shape = region.to_shapely()
        assert shape.is_valid
        assert polycsg.is_valid(region)
        assert polycsg.make_valid(region) == region
    both, either = polycsg.intersection(a, b).area, polycsg.union(a, b).area
    assert both + either == pytest.approx(polycsg.area(a) + polycsg.area(b), rel=1e-13, abs=1e-13)


def made(rings, polygons):
    """Multipolygons of lattice rings, valid or not."""
    ends = np.cumsum([0, *polygons])
    shells = [rings[first:last] for first, last in zip(ends, ends[1:]) if last <= len(rings)]
    return shapely.MultiPolygon([(shell[0], shell[1:]) for shell in shells])


@given(
    rings=st.lists(lattice_ring, min_size=1, max_size=4), polygons=st.lists(st.integers(1, 3), min_size=1, max_size=3)
)
@settings(max_examples=1000, deadline=None)
def test_valid_is_what_shapely_says(rings, polygons):
    shape = made(rings, polygons)
    assert polycsg.is_valid(shape) == shape.is_valid, polycsg.is_valid_reason(shape)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (0 0, 2 1, 1 2, 0 0))", "valid"),
        ("POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (2 0, 3 1, 1 1, 2 0))", "valid"),
        ("POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (2 0, 3 2, 2 4, 1 2, 2 0))", "cut the interior in parts"),
        ("POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (5 5, 6 5, 6 6, 5 5))", "ring 1: a hole lies outside"),
        (
            "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 8 1, 8 8, 1 8, 1 1), (2 2, 3 2, 3 3, 2 2))",
            "ring 2: a hole lies outside",
        ),
        ("MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0)), ((1 1, 2 1, 2 2, 1 1)))", "ring 1: a polygon lies inside another"),
        ("MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((2 2, 4 2, 4 4, 2 4, 2 2)))", "valid"),
        ("MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((2 0, 4 0, 4 2, 2 2, 2 0)))", "ring 0, vertex 1: "),
        (
            "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0), (2 2, 7 2, 7 7, 2 7, 2 2)), ((2 2, 7 2, 5 5, 2 2)))",
            "covers another edge",
        ),
        ("MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0), (2 2, 7 2, 7 7, 2 7, 2 2)), ((2 2, 6 4, 7 7, 2 2)))", "valid"),
        ("POLYGON ((0 0, 4 0, 2 2, 4 4, 0 4, 2 2, 0 0))", "ring 0: it touches itself in (2, 2)"),
        ("POLYGON ((0 0, 4 0, 4 4, 2 4, 2 5, 2 4, 0 4, 0 0))", "ring 0, vertex 3: "),
        ("POLYGON ((0 0, 0 0, 0 0, 0 0))", "ring 0: all of its vertices are equal"),
        ("POLYGON ((0 0, 1 1, 0 0, 0 0))", "ring 0, vertex 0"),
        ("POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (2 2, 6 2, 2 6, 2 2))", "crosses or covers another edge"),
        ("POLYGON EMPTY", "valid"),
    ],
)
def test_reasons(text, reason):
    shape = shapely.from_wkt(text)
    assert polycsg.is_valid(shape) == shape.is_valid == (reason == "valid")
    assert reason in polycsg.is_valid_reason(shape)


def test_a_crossing_by_a_last_bit():
    """Doubles that a division away from the others would lose."""
    ends = np.array([[0, 0], [1, 1 / 3], [0.5, np.nextafter(1 / 6, 1)], [0.5, 1]])
    inside = np.array([[0, 0], [1, 1 / 3], [0.5, np.nextafter(1 / 6, 0)], [0.5, 1]])
    assert polycsg.is_valid(ends)
    assert not polycsg.is_valid(inside)


@given(rings=st.lists(outlines, max_size=12), seed=st.integers(0, 1000))
@settings(max_examples=50, deadline=None)
def test_unary_union_in_any_order(rings, seed):
    whole = polycsg.unary_union(rings)
    mixed = [rings[i] for i in np.random.default_rng(seed).permutation(len(rings))]
    assert polycsg.unary_union(mixed) == whole
    its = shapely.union_all([shapely.Polygon(ring) for ring in rings])
    assert whole.area == pytest.approx(its.area, rel=1e-12)


@given(a=outlines, b=outlines, c=outlines)
@settings(max_examples=50, deadline=None)
def test_expressions(a, b, c):
    one, two, three = polycsg.Csg(a), polycsg.Csg(b), polycsg.Csg(c)
    left = polycsg.evaluate(one & (two | three))
    right = polycsg.evaluate((one & two) | (one & three))
    assert left.area == pytest.approx(right.area, rel=1e-12, abs=1e-14)
    assert polycsg.evaluate(polycsg.Csg.union([a, b, c])) == polycsg.unary_union([a, b, c])
    nothing = polycsg.evaluate(one - polycsg.Csg.union([a, b]))
    assert nothing.is_empty
    assert polycsg.evaluate(polycsg.Csg.union([])).is_empty


@given(rings=st.lists(outlines, min_size=1, max_size=8), clip=outlines)
@settings(max_examples=50, deadline=None)
def test_arrays_are_many_of_one(rings, clip):
    for operation in OPERATIONS:
        many = operation(rings, clip)
        assert [region for region in many] == [operation(ring, clip) for ring in rings]
    assert polycsg.prepare(clip).clip(rings) == polycsg.intersection(rings, clip)
    each = polycsg.union(rings, rings)
    np.testing.assert_array_equal(each.area, polycsg.make_valid(rings).area)


@given(ring=outlines, points=st.lists(st.tuples(st.floats(-2, 2), st.floats(-2, 2)), min_size=1))
@settings(max_examples=50, deadline=None)
def test_places(ring, points):
    shape = shapely.Polygon(ring)
    found = polycsg.locate(ring, np.array(points))
    for point, place in zip(points, found):
        assert (place >= 0) == shape.intersects(shapely.Point(point))
    assert (polycsg.locate(ring, ring) == 0).all()


@given(rings=st.lists(outlines, min_size=1, max_size=5))
@settings(max_examples=50, deadline=None)
def test_triangles(rings):
    triangles, owners = polycsg.triangulate(rings)
    (x0, y0), (x1, y1), (x2, y2) = np.moveaxis(triangles, 0, 2)
    areas = ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) / 2
    assert (areas > 0).all()
    np.testing.assert_allclose(np.bincount(owners, areas), polycsg.area(rings), rtol=1e-12)


def test_fill_rules():
    star = [(0.0, 3.0), (-1.8, -2.4), (2.9, 0.9), (-2.9, 0.9), (1.8, -2.4)]
    areas = [polycsg.area(star, fill=fill) for fill in ("evenodd", "nonzero", "positive")]
    assert areas[0] < areas[1] == areas[2]
    assert polycsg.area(star[::-1], fill="positive") == 0


def test_results_are_regularised():
    square = shapely.box(0, 0, 1, 1)
    for touching in (shapely.box(1, 0, 2, 1), shapely.box(1, 1, 2, 2)):
        assert polycsg.intersection(square, touching).is_empty
        assert not shapely.intersection(square, touching).is_empty
