"""Form factors (also view factors, configuration factors): the share of the power leaving a diffuse surface that
reaches another one directly, past whatever stands in between. From points they are exact and come with a bound on
their error that always holds; between polygons they come with an estimate of it, or with a bound where one is asked
for. No shadow is sampled.

A *point* is a position with a normal. A *polygon* is flat, with its front to the side from which its first loop runs
counter-clockwise; it receives on its front and hides with both sides. Units are yours.

>>> import formfactor
>>> lamp = [(-1, 1, 2), (1, 1, 2), (1, -1, 2), (-1, -1, 2)]
>>> board = [(-0.25, -0.25, 1), (0.25, -0.25, 1), (0.25, 0.25, 1), (-0.25, 0.25, 1)]
>>> factor = formfactor.form_factor((0, 0, 0), (0, 0, 1), lamp, [board])
>>> round(factor.value, 12), factor.error_bound < 1e-14
(0.165978835648, True)
"""

from ._enclosure import (
    AreaFormFactor,
    AreaRow,
    Enclosure,
    FormFactor,
    PointRows,
    Tolerance,
    form_factor,
    unoccluded_complement,
    visible_part,
)
from ._formfactor import VERSION as __version__
from ._formfactor import GeometryError
from ._matrix import Closure, FactorMatrix
from ._shards import ExchangeRows

__all__ = [
    "AreaFormFactor",
    "AreaRow",
    "Closure",
    "Enclosure",
    "ExchangeRows",
    "FactorMatrix",
    "FormFactor",
    "GeometryError",
    "PointRows",
    "Tolerance",
    "form_factor",
    "unoccluded_complement",
    "visible_part",
    "__version__",
]
