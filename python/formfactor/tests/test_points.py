"""Form factors from points: known values, forms of input, bad input."""

import math
import pickle
from types import SimpleNamespace

import hypothesis.strategies as st
import numpy as np
import pytest
from hypothesis import given, settings

import formfactor

LAMP = np.array([[-1.0, 1, 2], [1, 1, 2], [1, -1, 2], [-1, -1, 2]])
BOARD = np.array([[-2.0, -2, 1], [0, -2, 1], [0, 2, 1], [-2, 2, 1]])
WHOLE = 0.23945647046077354


def above(half, height):
    """Straight above a corner of a rectangle: the catalogues' B-4."""
    x = half / height
    root = math.sqrt(1 + x * x)
    return x / root * math.atan(x / root) * 4 / math.tau * 2


@given(half=st.floats(0.01, 100), height=st.floats(0.01, 100))
@settings(deadline=None)
def test_squares_overhead(half, height):
    square = np.array([[-half, half, height], [half, half, height], [half, -half, height], [-half, -half, height]])
    factor = formfactor.form_factor((0, 0, 0), (0, 0, 1), square)
    assert abs(factor.value - above(half, height)) <= factor.error_bound + 4e-16


def test_occlusion():
    half = formfactor.form_factor((0, 0, 0), (0, 0, 1), LAMP, [BOARD])
    assert abs(half.value - WHOLE / 2) <= half.error_bound < 1e-14
    assert formfactor.form_factor((0, 0, 0), (0, 0, -1), LAMP).value == 0
    rings = formfactor.visible_part((0, 0, 0), (0, 0, 1), LAMP, [BOARD])
    assert len(rings) == 1 and rings[0][:, 0].min() == 0


def test_complement():
    rest = formfactor.unoccluded_complement((0, 0, 0), (0, 0, 1), LAMP * [1e6, 1e6, 1])
    assert 0 < rest.value < 1e-11 and rest.error_bound < 1e-20


FORMS = {
    "a list of arrays": lambda: [LAMP, BOARD],
    "one array": lambda: np.stack([LAMP, BOARD]),
    "lists of tuples": lambda: [[tuple(p) for p in LAMP], [tuple(p) for p in BOARD]],
    "closed loops": lambda: [np.vstack([LAMP, LAMP[:1]]), BOARD],
    "tuples of loops": lambda: [(LAMP,), (BOARD,)],
    "vertices and faces": lambda: (np.vstack([LAMP, BOARD]), np.arange(8).reshape(2, 4)),
    "like trimesh": lambda: SimpleNamespace(vertices=np.vstack([LAMP, BOARD]), faces=np.arange(8).reshape(2, 4)),
    "like meshio": lambda: SimpleNamespace(
        points=np.vstack([LAMP, BOARD]),
        cells=[
            SimpleNamespace(type="line", data=np.array([[0, 1]])),
            SimpleNamespace(type="quad", data=np.arange(4)[None].astype(np.int32)),
            SimpleNamespace(type="quad", data=np.arange(4, 8)[None].astype(np.uint64)),
        ],
    ),
    "like pyvista": lambda: SimpleNamespace(
        points=np.vstack([LAMP, BOARD]).astype(np.float32),
        faces=np.array([4, 0, 1, 2, 3, 4, 4, 5, 6, 7]),
        is_all_triangles=False,
    ),
    "fortran order": lambda: [np.asfortranarray(LAMP), np.repeat(BOARD, 2, axis=0)[::2]],
    "integers": lambda: [LAMP.astype(int), BOARD.astype(np.int8)],
}


@pytest.mark.parametrize("form", FORMS)
def test_meshes_by_their_shape(form):
    room = formfactor.Enclosure(FORMS[form]())
    assert len(room) == 2
    rows = room.rows([[0, 0, 0], [0, 0, 1.5]], [0, 0, 1])
    assert rows.values[0].tolist() == pytest.approx([WHOLE / 2, 0], abs=1e-15)
    assert rows.values.shape == rows.error_bounds.shape == (2, 2)
    np.testing.assert_array_equal(room.areas, [4, 8])


def test_several_meshes():
    room = formfactor.Enclosure(FORMS["like trimesh"](), [LAMP + [0, 0, 5]])
    assert len(room) == 3
    assert len(formfactor.Enclosure()) == len(formfactor.Enclosure([])) == 0
    assert room.rows(np.empty((0, 3)), np.empty((0, 3))).values.shape == (0, 3)


def test_holes():
    ring = formfactor.Enclosure([(LAMP, LAMP / [2, 2, 1])])
    whole, middle = (formfactor.form_factor((0, 0, 0), (0, 0, 1), shape).value for shape in (LAMP, LAMP / [2, 2, 1]))
    assert ring.rows([0, 0, 0], [0, 0, 1]).values[0, 0] == pytest.approx(whole - middle, abs=1e-15)


def test_real_packages():
    trimesh = pytest.importorskip("trimesh")
    box = trimesh.creation.box()
    assert len(formfactor.Enclosure(box)) == 12
    meshio = pytest.importorskip("meshio")
    mesh = meshio.Mesh(box.vertices, [("triangle", box.faces), ("vertex", [[0]])])
    assert len(formfactor.Enclosure(mesh)) == 12
    pyvista = pytest.importorskip("pyvista")
    assert len(formfactor.Enclosure(pyvista.Box())) == 6
    assert len(formfactor.Enclosure(pyvista.Box().triangulate())) == 12


def test_sparse_rows():
    room = formfactor.Enclosure([LAMP, BOARD, LAMP + [0, 0, 9]])
    at = [[0, 0, 0], [0, 0, 1.5], [0, 0, 20]], [0, 0, 1]
    for to in (None, [2, 0]):
        full, sparse = room.rows(*at, to=to), room.rows(*at, to=to, sparse=True)
        assert sparse.values.nnz < full.values.size
        for one, other in zip(full, sparse):
            np.testing.assert_array_equal(one, other.toarray())
        np.testing.assert_allclose(full.sky(), sparse.sky(), rtol=1e-15)


def test_owners():
    room = formfactor.Enclosure([LAMP, BOARD])
    on_board = room.rows([[-1, 0, 1]], [0, 0, 1], 1)
    assert on_board.values[0, 0] > 0 and on_board.values[0, 1] == 0
    assert room.rows([[-1, 0, 1]], [0, 0, 1], [-1], to=[0]).values.shape == (1, 1)


def test_what_is_seen_adds_to_one():
    box = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    inward = np.array([[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]])
    room = formfactor.Enclosure((box, inward))
    points = np.random.default_rng(1).uniform(0.1, 0.9, (50, 3))
    normals = np.random.default_rng(2).normal(size=(50, 3))
    rows = room.rows(points, normals)
    assert (abs(rows.values.sum(axis=1) - 1) <= rows.error_bounds.sum(axis=1)).all()
    assert (rows.sky() <= rows.error_bounds.sum(axis=1)).all()
    open_room = formfactor.Enclosure((box, inward[[0, 2, 3, 4, 5]]))
    np.testing.assert_allclose(open_room.rows(points, normals).sky(), rows.values[:, 1], atol=1e-14)


@pytest.mark.parametrize(
    "method",
    [
        "exact",
        "wallace",
        "pietrek",
        "visibility_index",
        "hemicube",
        "baum",
        "single_plane",
        "monte_carlo",
        "paraboloid",
    ],
)
def test_comparators(method):
    room = formfactor.Enclosure([LAMP, BOARD])
    rows = room.approximate_rows(method, [[0.0, 0, 0]], [0, 0, 1])
    assert rows[0, 0] == pytest.approx(WHOLE / 2, abs=0.01)


def test_parameters_of_comparators():
    room = formfactor.Enclosure([LAMP])
    at = [[0.0, 0, 0]], [0, 0, 1]
    assert room.approximate_rows("disk", *at)[0, 0] == pytest.approx(4 / math.pi / (4 + 4 / math.pi), abs=0.1)
    beside = [[0.3, 0.1, 0]], [0, 0, 1]
    exact, fine, coarse = (
        room.approximate_rows(method, *beside, **given)[0, 0]
        for method, given in [("exact", {}), ("hemicube", {"resolution": 512}), ("hemicube", {"resolution": 4})]
    )
    assert abs(fine - exact) < 1e-3 < abs(coarse - exact)
    seeds = [
        room.approximate_rows("monte_carlo", *at, seed=seed, rays=100, stratified=False)[0, 0] for seed in (1, 1, 2)
    ]
    assert seeds[0] == seeds[1] != seeds[2]
    with pytest.raises(ValueError, match="no parameter rays, but resolution"):
        room.approximate_rows("hemicube", *at, rays=5)
    with pytest.raises(ValueError, match="resolution is not what"):
        room.approximate_rows("hemicube", *at, resolution="high")
    with pytest.raises(ValueError, match="no method has the name"):
        room.approximate_rows("guess", *at)


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        (None, "NoneType is no mesh"),
        ("mesh", "str is no mesh"),
        ([LAMP, LAMP[:2]], "polygon 1: loop 0 has 2 vertices"),
        ([LAMP, None], "polygon 1: points have the shape"),
        ([LAMP[:, :2]], r"polygon 0: points have the shape \(n, 3\)"),
        (
            [LAMP, np.where(np.arange(12).reshape(4, 3) == 7, np.nan, LAMP)],
            "polygon 1: loop 0, vertex 2: a coordinate is NaN",
        ),
        (
            [LAMP + [[0, 0, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]]],
            "polygon 0: loop 0, vertex . off the plane|split the polygon into triangles",
        ),
        ([LAMP * 0], "encloses no area"),
        ([LAMP.astype(complex)], "numbers that fit in doubles"),
        ([np.ma.masked_equal(LAMP, 2)], "masked"),
        ([[(0, 0, 0), (1, 0), (1, 1, 1)]], "polygon 0: "),
        (np.zeros((4, 3)), r"polygons have the shape \(k, n, 3\)"),
        ((LAMP, np.array([[0, 1, 4]])), "there are 4 vertices, none has the number 4"),
        ((LAMP, np.array([[0, 1, -1]])), "none has the number -1"),
        (SimpleNamespace(vertices=LAMP, faces=np.array([[0.0, 1, 2]])), "faces are integers"),
        (SimpleNamespace(points=LAMP, faces=np.array([3, 0, 1]), is_all_triangles=True), "cut short"),
    ],
    ids=str,
)
def test_bad_meshes(bad, message):
    with pytest.raises(formfactor.GeometryError, match=message):
        formfactor.Enclosure(bad)


def test_bad_points():
    room = formfactor.Enclosure([LAMP])
    for position, normal, message in [
        ([[0, 0, 0], [0, 0, math.nan]], [0, 0, 1], "point 1: the point has a coordinate that is NaN"),
        ([[0, 0, 0]], [0, 0, 0], "point 0: the normal is zero"),
        ([[0, 0]], [0, 0, 1], "shape"),
        ([[0, 0, 0]] * 3, [[0, 0, 1]] * 2, "not as many"),
    ]:
        with pytest.raises(formfactor.GeometryError, match=message):
            room.rows(position, normal)
    with pytest.raises(formfactor.GeometryError, match="point 0: there is no polygon 1"):
        room.rows([[0, 0, 0]], [0, 0, 1], 1)
    for ids in ([1], [-1], [0.5]):
        with pytest.raises(ValueError):
            room.rows([[0, 0, 0]], [0, 0, 1], to=ids)
    with pytest.raises(formfactor.GeometryError):
        formfactor.form_factor((0, 0, 0), (0, 0, 1), LAMP[:2])
    with pytest.raises(formfactor.GeometryError, match="occluder 0: "):
        formfactor.form_factor((0, 0, 0), (0, 0, 1), LAMP, [BOARD * 0])


def test_enclosures_are_pickled():
    room = formfactor.Enclosure([LAMP, (BOARD, BOARD / 2 - [0.4, 0, -0.5])])
    back = pickle.loads(pickle.dumps(room))
    np.testing.assert_array_equal(back.rows([0, 0, 0], [0, 0, 1]).values, room.rows([0, 0, 0], [0, 0, 1]).values)
    assert back.fingerprint() == room.fingerprint() != room.fingerprint(1e-5)
