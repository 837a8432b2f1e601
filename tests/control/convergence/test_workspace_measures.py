"""Measures over configurations, arcs of angles and spaced points, beside plain loops."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from holdfast.control.convergence.measures import Measures, is_in_arcs, mean_by_row, select_spaced
from holdfast.interface.report.places import bin_positions


def test_measures_beside_a_loop(rng):
    owner = np.sort(rng.integers(0, 9, 60))
    owner[owner == 4] = 5  # a start without configurations
    shares = rng.choice([0.0, 0.25, 1.0, np.nan], (60, 3))
    found = Measures.from_fractions(shares, owner, 9)
    for i in range(9):
        for j in range(3):
            mine = [x for x in shares[owner == i, j] if not np.isnan(x)]
            values = (found.full[i, j], found.average[i, j], found.spread[i, j])
            if not mine:
                assert np.isnan(values).all()
                continue
            expected = (100 * sum(x == 1 for x in mine) / len(mine), 100 * sum(mine) / len(mine), 100 * (max(mine) - min(mine)))
            assert values == pytest.approx(expected)


@given(
    low=st.floats(-10, 10), size=st.floats(0, 6.28), share=st.floats(0, 1), turns=st.integers(-3, 3), beyond=st.floats(1e-6, 1)
)
def test_arcs_hold_modulo_whole_turns(low, size, share, turns, beyond):
    inside = low + share * size + 2 * np.pi * turns
    assert is_in_arcs(np.array([inside]), [(low, low + size)], True)[0]
    outside = low + size + beyond * (2 * np.pi - size)
    if outside - low - size > 1e-8 and outside < low + 2 * np.pi - 1e-8:
        assert not is_in_arcs(np.array([outside + 2 * np.pi * turns]), [(low, low + size)], True)[0]


def test_arcs_of_sliding_joints_do_not_come_round():
    assert list(is_in_arcs(np.array([0.1, 0.1 + 2 * np.pi, -0.3]), [(0.0, 0.2), (-0.4, -0.25)], False)) == [True, False, True]
    assert not is_in_arcs(np.array([1.0]), [], True).any()


def test_spaced_points_are_flagged_and_spread(rng):
    flags = rng.random((50, 20)) < 0.4
    flags[:, 3] = False
    flags[:, 4] = False
    flags[7:9, 4] = True
    count = np.full(20, 6)
    count[5] = 0
    row, cell = select_spaced(flags, count)
    assert flags[cell, row].all()
    chosen = np.bincount(row, minlength=20)
    assert (chosen == np.minimum(count, flags.sum(axis=0))).all()
    for k in np.flatnonzero(chosen == 6):  # one of every sixth part of the flagged cells
        order = np.flatnonzero(flags[:, k])
        place = np.searchsorted(order, np.sort(cell[row == k])) / len(order)
        assert (np.floor(6 * place) == np.arange(6)).all()


def test_averages_leave_nan_out():
    found = mean_by_row(np.array([1.0, np.nan, 0.0, np.nan]), np.array([0, 0, 0, 2]), 3)
    assert found[0] == 0.5
    assert np.isnan(found[1:]).all()


def test_cells_of_a_map_hold_the_mean(rng):
    points, values = rng.uniform(-1, 1, (200, 2)), rng.random((200, 2))
    values[::7, 0] = np.nan
    plane, means = bin_positions(points, values, 5)
    low, size = points.min(axis=0), (points.max(axis=0) - points.min(axis=0)).max() / 5
    for (column, row), mean in zip(plane.cells, means, strict=True):
        at = np.minimum(((points - low) / size).astype(int), [4, 4])
        mine = (at == [column, row]).all(axis=1)
        assert mean == pytest.approx(np.nanmean(values[mine], axis=0))
