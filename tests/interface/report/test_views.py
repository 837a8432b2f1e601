"""From where things are drawn: side, top and the plane of an arm."""

from __future__ import annotations

import numpy as np
import pytest

from holdfast.interface.report.views import choose_side_and_top_views


@pytest.fixture
def points(rng):
    return rng.uniform(-1, 1, (40, 3))


def test_places_are_coordinates_along_both_directions(points):
    side, top = choose_side_and_top_views(points)
    np.testing.assert_array_equal(side.project(points), points[:, [0, 2]])
    np.testing.assert_array_equal(top.project(points), points[:, [0, 1]])
    assert (side.names, top.names) == (("x, m", "z, m"), ("x, m", "y, m"))


def test_the_side_is_the_wider_one(points):
    side, _ = choose_side_and_top_views(points * [0.2, 1, 1])
    np.testing.assert_array_equal(side.project(points), points[:, [1, 2]])


@pytest.mark.parametrize(("scale", "titles"), [((1, 1, 0), ["Top view"]), ((1, 0, 1), ["Side view"]), ((0, 0, 1), [])])
def test_what_would_be_a_line_is_left_out(points, scale, titles):
    assert [view.title for view in choose_side_and_top_views(points * scale)] == titles
