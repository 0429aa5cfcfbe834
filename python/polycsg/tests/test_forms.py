"""Every form that geometries come in is read, and written again."""

import pickle

import geopandas
import numpy as np
import pandas
import pyarrow
import pytest
import shapely

import polycsg

SQUARE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
HOLED = shapely.Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(1, 1), (2, 1), (2, 2), (1, 2)]])
MULTI = shapely.MultiPolygon([HOLED, shapely.box(20, 0, 22, 2)])
SERIES = geopandas.GeoSeries([HOLED, None, MULTI, shapely.Polygon()], index=[7, 3, 5, 1], crs=31983)
AREAS = [80.0, np.nan, 84.0, 0.0]


def same(areas, wanted):
    np.testing.assert_array_equal(areas, wanted)


class TestRings:
    @pytest.mark.parametrize(
        "ring",
        [
            SQUARE,
            SQUARE.astype(np.float32),
            SQUARE.astype(np.int32),
            SQUARE.astype(">f8"),
            SQUARE.astype(np.float16),
            SQUARE.astype(np.uint64),
            SQUARE.astype(np.int64),
            np.asfortranarray(SQUARE),
            np.repeat(SQUARE, 2, axis=0)[::2],
            SQUARE[::-1],
            np.vstack([SQUARE, SQUARE[:1]]),
            SQUARE.tolist(),
            [tuple(point) for point in SQUARE],
            list(SQUARE),
        ],
        ids=lambda ring: type(ring).__name__,
    )
    def test_one(self, ring):
        region = polycsg.make_valid(ring)
        assert isinstance(region, polycsg.Region)
        assert region.area == 4.0
        assert region == polycsg.make_valid(SQUARE)

    def test_read_only(self):
        ring = SQUARE.copy()
        ring.flags.writeable = False
        assert polycsg.area(ring) == 4.0

    def test_many(self):
        same(polycsg.area(np.stack([SQUARE, SQUARE + 1])), [4, 4])
        same(polycsg.area([SQUARE, SQUARE[:3], None]), [4, 2, np.nan])

    def test_what_was_given_stays_as_it_is(self):
        ring = SQUARE.copy()
        polycsg.union(ring, ring + 1)
        assert ring.flags.writeable
        np.testing.assert_array_equal(ring, SQUARE)

    def test_none_at_all(self):
        assert len(polycsg.make_valid([])) == 0
        assert polycsg.unary_union([]).is_empty
        assert polycsg.make_valid(np.empty((0, 2))).is_empty


class TestShapely:
    def test_one(self):
        assert polycsg.area(MULTI) == 84.0
        assert polycsg.make_valid(HOLED).to_shapely().equals(HOLED)
        assert polycsg.make_valid(MULTI).to_shapely().equals(MULTI)
        assert polycsg.make_valid(shapely.Polygon()).to_shapely().is_empty

    def test_objects_with_gaps(self):
        regions = polycsg.make_valid(SERIES.to_numpy())
        same(regions.area, AREAS)
        same(regions.missing, [False, True, False, False])
        found = regions.to_shapely()
        assert found[1] is None and found[2].equals(MULTI)
        assert regions[1] is None and regions[-2].area == 84.0
        assert [region is None for region in regions] == [False, True, False, False]

    def test_ragged_there_and_back(self):
        for shapes in ([HOLED, shapely.box(1, 1, 2, 2)], [MULTI, HOLED]):
            kind, coordinates, offsets = shapely.to_ragged_array(shapes)
            for given in ((coordinates, offsets), (kind, coordinates, offsets)):
                regions = polycsg.make_valid(given)
                back = shapely.from_ragged_array(shapely.GeometryType.MULTIPOLYGON, *regions.to_ragged())
                assert all(one.equals(other) for one, other in zip(back, shapes))

    def test_offsets_of_other_widths(self):
        _, coordinates, offsets = shapely.to_ragged_array([MULTI, HOLED])
        for dtype in (np.int32, np.int64, np.uint32, np.uint8):
            same(polycsg.area((coordinates, tuple(array.astype(dtype) for array in offsets))), [84, 80])

    def test_heights_are_left_out(self):
        high = shapely.force_3d(HOLED, 7)
        assert polycsg.area(high) == polycsg.area([high])[0] == 80
        assert polycsg.area(shapely.to_ragged_array([high]))[0] == 80
        assert polycsg.area(shapely.to_wkb(high, output_dimension=3)) == 80
        assert polycsg.area(high.__geo_interface__) == 80


class TestGeoPandas:
    def test_three_lines(self):
        lots = geopandas.GeoDataFrame({"owner": list("abcd")}, index=SERIES.index, geometry=SERIES)
        lots.geometry = polycsg.difference(lots, shapely.box(0, 0, 9, 1)).to_geopandas()
        assert list(lots.index) == [7, 3, 5, 1] and lots.crs.to_epsg() == 31983
        same(lots.area, [71, np.nan, 75, 0])

    def test_indexes_must_agree(self):
        other = SERIES.reset_index(drop=True)
        with pytest.raises(polycsg.GeometryError, match="indexes differ"):
            polycsg.union(SERIES, other)
        same(polycsg.union(SERIES.reset_index(drop=True), other).area, AREAS)

    def test_systems_must_agree(self):
        with pytest.raises(polycsg.GeometryError, match="systems differ"):
            polycsg.union(SERIES, SERIES.set_crs(4326, allow_override=True))

    def test_prepared(self):
        clipped = polycsg.prepare(shapely.box(0, 0, 9, 1)).clip(SERIES).to_geopandas()
        assert clipped.crs == SERIES.crs and list(clipped.index) == list(SERIES.index)

    def test_a_series_of_bytes(self):
        same(polycsg.area(SERIES.to_wkb()), AREAS)


class TestArrow:
    @pytest.mark.parametrize("interleaved", [True, False])
    @pytest.mark.parametrize("encoding", ["geoarrow", "WKB"])
    @pytest.mark.parametrize("shapes", [SERIES, SERIES.iloc[[0, 1, 0]]], ids=["multipolygons", "polygons"])
    def test_in(self, shapes, encoding, interleaved):
        wanted = polycsg.make_valid(shapes).area
        array = shapes.to_arrow(geometry_encoding=encoding, interleaved=interleaved)
        same(polycsg.area(array), wanted)
        same(polycsg.area(pyarrow.array(array)[1:]), wanted[1:])
        table = geopandas.GeoDataFrame({"n": range(len(shapes))}, geometry=shapes.values)
        table = pyarrow.table(table.to_arrow(geometry_encoding=encoding, interleaved=interleaved))
        same(polycsg.area(table), wanted)
        same(polycsg.area(pyarrow.concat_tables([table, table])), [*wanted, *wanted])

    def test_out(self):
        regions = polycsg.make_valid(SERIES)
        assert pyarrow.array(regions).null_count == 1
        back = geopandas.GeoSeries.from_arrow(regions)
        same(back.area, AREAS)
        assert back.crs == SERIES.crs
        assert polycsg.make_valid(polycsg.make_valid(SERIES.to_arrow())).to_geopandas().crs == SERIES.crs

    def test_other_kinds(self):
        points = geopandas.GeoSeries([shapely.Point(0, 0)]).to_arrow(geometry_encoding="geoarrow")
        with pytest.raises(polycsg.GeometryError, match=r"geoarrow\.point"):
            polycsg.area(points)
        with pytest.raises(polycsg.GeometryError):
            polycsg.area(pyarrow.array([1, 2, 3]))
        with pytest.raises(polycsg.GeometryError, match="no column"):
            polycsg.area(pyarrow.table({"a": [1]}))


class TestBytes:
    @pytest.mark.parametrize("order", [0, 1])
    @pytest.mark.parametrize("flavor", ["iso", "extended"])
    @pytest.mark.parametrize("srid", [False, True])
    def test_there(self, order, flavor, srid):
        if flavor == "iso" and srid:
            pytest.skip("not in that dialect")
        for shape in (MULTI, HOLED, shapely.force_3d(MULTI)):
            given = shapely.to_wkb(shapely.set_srid(shape, 4326), byte_order=order, flavor=flavor, include_srid=srid)
            assert polycsg.area(given) == shape.area

    def test_and_back(self):
        regions = polycsg.make_valid(SERIES)
        found = regions.to_wkb()
        assert found[1] is None and shapely.from_wkb(found[2]).equals(MULTI)
        assert polycsg.make_valid(found) == polycsg.make_valid(SERIES.to_numpy())
        assert shapely.from_wkb(polycsg.make_valid(MULTI).to_wkb()).equals(MULTI)

    def test_cut_short_or_mad(self):
        whole = shapely.to_wkb(MULTI)
        for end in range(len(whole)):
            with pytest.raises(polycsg.GeometryError, match="feature 0"):
                polycsg.area(whole[:end])
        for bad in (whole + b"x", shapely.to_wkb(shapely.Point(0, 0)), b"\1\3\0\0\0\xff\xff\xff\xff"):
            with pytest.raises(polycsg.GeometryError, match="feature 0"):
                polycsg.area(bad)


class TestInterface:
    def test_mappings(self):
        feature = {"type": "Feature", "properties": {}, "geometry": MULTI.__geo_interface__}
        assert polycsg.area(feature) == 84
        same(polycsg.area({"type": "FeatureCollection", "features": [feature, feature]}), [84, 84])
        assert polycsg.area({"type": "MultiPolygon", "coordinates": []}) == 0
        assert polycsg.area({"type": "Polygon", "coordinates": []}) == 0

    def test_objects(self):
        class Lot:
            __geo_interface__ = HOLED.__geo_interface__

        assert polycsg.area(Lot()) == 80
        same(polycsg.area([Lot(), None, SQUARE, MULTI, shapely.to_wkb(MULTI)]), [80, np.nan, 4, 84, 84])

    def test_ours(self):
        region = polycsg.make_valid(MULTI)
        assert shapely.geometry.shape(region).equals(MULTI)


def test_some_of_many():
    regions = polycsg.make_valid(SERIES)
    for chosen in (slice(None, None, -1), [2, 0], np.array([True, False, True, False]), np.array([], int)):
        some = regions[chosen]
        same(some.area, np.array(AREAS)[chosen])
        assert some.to_geopandas().dropna().geom_equals(regions.to_geopandas().iloc[chosen].dropna()).all()
        assert list(some.to_geopandas().index) == list(SERIES.index[chosen])
    with pytest.raises(IndexError):
        regions[4]
    with pytest.raises(IndexError):
        regions[[0, 9]]


def test_missing_values_of_pandas():
    values = np.array([HOLED, pandas.NA, None, float("nan"), pandas.NaT, MULTI], dtype=object)
    same(polycsg.area(values), [80, np.nan, np.nan, np.nan, np.nan, 84])
    same(polycsg.area(pandas.Series(values, index=list("abcdef"))), [80, np.nan, np.nan, np.nan, np.nan, 84])
    same(polycsg.area([None, None]), [np.nan, np.nan])
    assert polycsg.unary_union(values).area == 84 and not polycsg.is_valid([None])[0]


def test_results_are_pickled():
    regions = polycsg.make_valid(SERIES)
    back = pickle.loads(pickle.dumps(regions))
    assert back == regions and back.to_geopandas().crs == SERIES.crs
    assert pickle.loads(pickle.dumps(regions[2])) == regions[2]


def test_results_are_read_only_and_hash():
    region = polycsg.make_valid(HOLED)
    with pytest.raises(ValueError):
        polycsg.make_valid([HOLED]).coordinates[0] = 0
    assert hash(region) == hash(polycsg.make_valid(HOLED)) and region and not polycsg.make_valid(SQUARE[:2])
