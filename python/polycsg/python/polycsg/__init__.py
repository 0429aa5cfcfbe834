"""Booleans of polygons that never break: every topological decision is exact, every result is valid.

Coordinates are plain doubles, in any unit. Results are *regularised*: the closure of an interior, so that inputs
which only touch have nothing in common, and no stray lines or points come out. Input vertices that survive come back
bit for bit.

Every function takes one geometry or an array of them, in any of these forms:

- a :class:`Region` or :class:`Regions` of this package;
- shapely geometries, alone, in lists and numpy arrays, and GeoSeries (polygons and multipolygons);
- a numpy array (n, 2) or a list of pairs: one ring; a numpy array (k, n, 2): k of them;
- ``(coordinates, offsets)`` of :func:`shapely.to_ragged_array`, and GeoArrow by ``__arrow_c_array__`` or
  ``__arrow_c_stream__``;
- well-known binary, as bytes;
- anything with ``__geo_interface__``, and GeoJSON as dictionaries;
- lists and arrays of these, None where one is missing.

Doubles in one piece, offsets of 32 or 64 bits, and Arrow arrays of one chunk are read where they are, without a copy.
Z and M are left out.

Single geometries give a :class:`Region`, arrays give :class:`Regions`.

>>> import polycsg
>>> square = {"type": "Polygon", "coordinates": [[(0, 0), (2, 0), (2, 2), (0, 2), (0, 0)]]}
>>> moved = {"type": "Polygon", "coordinates": [[(1, 1), (3, 1), (3, 3), (1, 3), (1, 1)]]}
>>> polycsg.intersection(square, moved)
<polycsg.Region of 1 polygon, 4 vertices>
>>> polycsg.union(square, moved).area
7.0
"""

from ._expression import Csg
from ._functions import (
    area,
    difference,
    evaluate,
    intersection,
    is_valid,
    is_valid_reason,
    locate,
    make_valid,
    prepare,
    symmetric_difference,
    triangulate,
    unary_union,
    union,
)
from ._polycsg import VERSION as __version__
from ._polycsg import GeometryError
from ._prepared import PreparedRegion
from ._regions import Region, Regions

__all__ = [
    "Csg",
    "GeometryError",
    "PreparedRegion",
    "Region",
    "Regions",
    "area",
    "difference",
    "evaluate",
    "intersection",
    "is_valid",
    "is_valid_reason",
    "locate",
    "make_valid",
    "prepare",
    "symmetric_difference",
    "triangulate",
    "unary_union",
    "union",
    "__version__",
]
