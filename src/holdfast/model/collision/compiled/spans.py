"""Spans of motions in joint space that are proved free of contact by compiled code."""

from __future__ import annotations

from ctypes import Structure, byref, c_float, c_int64, c_void_p

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.compiled.library import list_fields, load_library
from holdfast.model.collision.compiled.scene import CompiledScene, SceneTables

_ROUNDING_M = 1e-4  # errors of distances in single precision, for an arm and a cell of this size:
_ROUNDING_SIZE_M = 50.0
_CONTACT_TYPE = np.dtype(
    [("row", np.int64), ("begin", np.float32), ("end", np.float32), ("pair", np.int64), ("rate", np.float64)]
)


class _SpanAddresses(Structure):
    """Structure ``Spans`` of route_search.cpp."""

    _fields_ = (
        *list_fields(c_void_p, "before after"),
        *list_fields(c_int64, "stride time_row"),
        *list_fields(c_float, "allowance finest"),
    )


class SpanChecker:
    """Proofs that an arm touches nothing between two states; margins are not contacts.

    Args:
        clearance: Collision model; see :meth:`EdgeChecker.supports`.
        lipschitz_bounds: (P, n) bounds of the change of each pair's distance; see :meth:`Clearance.lipschitz_bounds`.
    """

    def __init__(self, clearance: Clearance, lipschitz_bounds: FloatArray) -> None:
        tables = SceneTables.from_clearance(clearance, 0.0, lipschitz_bounds, clearance.margins)
        self._library, self._scene = load_library(), CompiledScene(tables, np.float32)
        places = [lipschitz_bounds, np.abs(tables.objects[:, 9:12]), np.abs(clearance.arm.base[:3, 3])]
        self._allowance = _ROUNDING_M * max(1.0, sum(place.max(initial=0.0) for place in places) / _ROUNDING_SIZE_M)
        # Numbers of the pairs as the compiled code counts them: all links with all objects, then pairs of capsules.
        self._pairs = np.full(clearance.arm.n * len(tables.objects) + len(tables.pairs), -1, dtype=np.int64)
        if clearance.obstacles is not None:
            positions = clearance.obstacles.pairs @ [len(tables.objects), 1]
            self._pairs[positions] = len(clearance.pairs) + np.arange(len(positions))
        links = [part.link for part in clearance.capsules]
        capsules = np.array(sorted(range(len(links)), key=links.__getitem__), dtype=np.int64)
        numbers = {pair: number for number, pair in enumerate(clearance.pairs)}
        own_pairs = [numbers[first, second] for first, second in capsules[tables.pairs].tolist()]
        self._pairs[clearance.arm.n * len(tables.objects) :] = own_pairs

    def check_spans(
        self, before: FloatArray, after: FloatArray, count: int, time_row: int, finest: float = np.inf
    ) -> tuple[IndexArray, IndexArray, FloatArray, BoolArray]:
        """Return possible contacts, and which spans (R,) lead to one for certain.

        A possible contact is the column (C,), the pair (C,), and its piece (3, C): the fractions of the span between which the
        pair may touch, and a bound of the change of its distance there, m per whole span. No other contacts are possible,
        except after a certain one. In between, joints follow the cubic polynomials through positions and rates at both ends.

        Args:
            before: (m, W) columns of states: joint values, rates, and others.
            after: The same later.
            count: Number R of columns that are checked.
            time_row: Row of the columns that contains the time, s.
            finest: Duration of a piece of a span that is not split further, s.
        """
        before, after = np.ascontiguousarray(before), np.ascontiguousarray(after)
        addresses = _SpanAddresses(before.ctypes.data, after.ctypes.data, before.shape[1], time_row, self._allowance, finest)
        touching, found, capacity = np.empty(count, dtype=np.bool_), max(count, 1), 0
        while found > capacity:
            capacity = found
            contacts = np.empty(capacity, dtype=_CONTACT_TYPE)
            found = self._library.check_spans(
                self._scene.address, byref(addresses), count, contacts.ctypes.data, capacity, touching.ctypes.data
            )
        contacts = contacts[:found]
        pieces = np.array([contacts[name] for name in ("begin", "end", "rate")], dtype=np.float64)
        return contacts["row"], self._pairs[contacts["pair"]], pieces, touching
