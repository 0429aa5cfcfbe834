"""What cannot be read raises, and says where."""

import numpy as np
import pytest
import shapely

import polycsg

SQUARE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
FUNCTIONS = [
    polycsg.area,
    polycsg.make_valid,
    polycsg.unary_union,
    polycsg.triangulate,
    polycsg.is_valid,
    polycsg.prepare,
    lambda bad: polycsg.union(bad, SQUARE),
    lambda bad: polycsg.union(SQUARE, bad),
    lambda bad: polycsg.prepare(SQUARE).clip(bad),
]


@pytest.mark.parametrize(
    "bad",
    [
        None,
        7,
        "POLYGON ((0 0, 1 0, 1 1, 0 0))",
        np.zeros(3),
        np.zeros((4, 3)),
        np.zeros((2, 2, 2, 2)),
        np.zeros((4, 2), complex),
        np.zeros((4, 2), bool),
        np.zeros((4, 2), "U3"),
        np.zeros((4, 2), "M8[s]"),
        np.ma.masked_equal(SQUARE, 2.0),
        np.full((4, 2), 2**60),
        [(0, 0), (1, 0, 5), (1, 1)],
        [(0, 0, 0), (1, 0, 5), (1, 1, 0)],
        [[SQUARE, SQUARE], SQUARE],
        [7],
        shapely.Point(0, 0),
        [shapely.box(0, 0, 1, 1), shapely.LineString([(0, 0), (1, 1)])],
        shapely.GeometryCollection([shapely.box(0, 0, 1, 1)]),
        np.zeros((4, 2), np.longdouble),
        {"type": "Point", "coordinates": (0, 0)},
        {"type": "Polygon"},
        {"type": "Polygon", "coordinates": None},
        {"type": "Feature", "geometry": None},
        {},
        {"type": "Polygon", "coordinates": [[(0, 0), (1, 0), "x"]]},
        (SQUARE, ()),
        (SQUARE, (np.array([0, 4]),)),
        (SQUARE, (np.array([0, 5]), np.array([0, 1]))),
        (SQUARE, (np.array([4, 0]), np.array([0, 1]))),
        (SQUARE, (np.array([-4, 4]), np.array([0, 1]))),
        (SQUARE, (np.array([0, 2**62]), np.array([0, 1]))),
        (SQUARE, (np.array([0, 2**64 - 1], np.uint64), np.array([0, 1]))),
        (SQUARE, (np.array([0, 4]), np.array([0, 2]))),
        (SQUARE, (np.array([], int), np.array([0]))),
        (SQUARE, (np.array([0.0, 4.0]), np.array([0, 1]))),
        (SQUARE.ravel(), (np.array([0, 4]), np.array([0, 1]))),
    ],
    ids=repr,
)
def test_unreadable(bad):
    for function in FUNCTIONS:
        with pytest.raises(polycsg.GeometryError):
            function(bad)


def test_other_kinds_are_named():
    line, both = shapely.LineString([(0, 0), (1, 1)]), shapely.GeometryCollection([shapely.box(0, 0, 1, 1)])
    for shape, said in [
        (line, "a LineString is no Polygon or MultiPolygon: it has no area"),
        (both, "a GeometryCollection is no Polygon or MultiPolygon: give the polygons that it holds"),
    ]:
        for form in (shape, shape.wkb, shape.__geo_interface__):
            with pytest.raises(polycsg.GeometryError, match=said):
                polycsg.area(form)


@pytest.mark.parametrize("number", [np.nan, np.inf, -np.inf])
def test_not_finite(number):
    hole = [(0.5, 0.5), (1, number), (1, 1)]
    bad = {"type": "Polygon", "coordinates": [SQUARE.tolist(), hole]}
    for function in (polycsg.area, polycsg.make_valid, polycsg.unary_union, polycsg.triangulate):
        with pytest.raises(polycsg.GeometryError, match="feature 2, ring 1, vertex 1: "):
            function([SQUARE, SQUARE, bad])
    with pytest.raises(polycsg.GeometryError, match="operand 1, feature 0, ring 1, vertex 1: "):
        polycsg.union([SQUARE, SQUARE], bad)
    assert not polycsg.is_valid(bad)
    assert polycsg.is_valid_reason(bad).startswith("ring 1, vertex 1")


def test_lengths_that_do_not_go_together():
    with pytest.raises(ValueError, match="2 features do not go with 3"):
        polycsg.union([SQUARE] * 2, [SQUARE] * 3)
    assert len(polycsg.union([SQUARE], [SQUARE] * 3)) == 3
    assert len(polycsg.union([], [])) == 0
    with pytest.raises(ValueError, match="do not go with"):
        polycsg.union([SQUARE] * 2, [])


def test_names():
    with pytest.raises(ValueError, match="evenodd"):
        polycsg.area(SQUARE, fill="odd")
    with pytest.raises(polycsg.GeometryError, match="one geometry is wanted, not 2"):
        polycsg.prepare([SQUARE, SQUARE])


def test_points():
    for bad in (np.zeros(2), np.zeros((2, 3)), [[1, "x"]], [shapely.box(0, 0, 1, 1)], [shapely.Point()]):
        with pytest.raises(ValueError):
            polycsg.locate(SQUARE, bad)
    assert polycsg.locate(SQUARE, [shapely.Point(1, 1), shapely.Point(9, 9)]).tolist() == [1, -1]
    assert polycsg.locate(SQUARE, np.empty((0, 2))).tolist() == []
    assert polycsg.locate(SQUARE, [[np.nan, 1], [np.inf, 1]]).tolist() == [-1, -1]


def test_huge_and_tiny_numbers():
    for scale in (1e-300, 5e-324, 1e300):
        assert not polycsg.intersection(SQUARE * scale, SQUARE * scale).is_empty
    far = SQUARE + 1e15
    assert polycsg.difference(far, far + 1).area == 3


def test_errors_are_value_errors():
    assert issubclass(polycsg.GeometryError, ValueError)
