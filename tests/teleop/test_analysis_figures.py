"""No label of a figure touches another, or is cut at the edge."""

from itertools import pairwise

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from holdfast.interface.presentation.teleop.figures import measures_figure
from holdfast.interface.presentation.teleop.motions import Motion, motions_figure


def titles(figure):
    """Boxes of all titles, pixels, row by row."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    rows = {}
    for axes in figure.axes:
        if axes.get_visible() and axes.get_title("left"):
            rows.setdefault(round(axes.get_position().y0, 3), []).append(axes._left_title.get_window_extent())
    return [sorted(row, key=lambda b: b.x0) for row in rows.values()]


def check(figure):
    boxes = titles(figure)
    plots = [a.get_window_extent() for a in figure.axes if a.get_visible()]
    for row in boxes:
        assert row[0].x0 >= 0
        assert row[-1].x1 <= figure.bbox.x1
        assert max(b.y1 for b in row) <= figure.bbox.y1
        assert all(left.x1 + 2 < right.x0 for left, right in pairwise(row))
        for box in row:  # and none lies on the panel above it, or on what is written below that
            above = [p for p in plots if p.y0 > box.y0 and p.x0 < box.x1 and box.x0 < p.x1]
            assert all(box.y1 + 12 < p.y0 for p in above)


@pytest.mark.parametrize("rated", [True, False])
def test_titles_of_measures(rng, rated):
    values = [[rng.lognormal(size=40) for _ in range(4)] for _ in range(13 if rated else 12)]
    check(measures_figure(values, [rng.lognormal(size=4) for _ in range(12)], [1, 2, 3, 4]))


@pytest.mark.parametrize("count", [1, 3, 8, 11])
def test_titles_of_motions(rng, count):
    names = ["2: healthy, failure-tolerant", "computer, 3: failed, pseudoinverse", "computer, 4: failed, failure-tolerant"]
    motions = [
        Motion(path=np.cumsum(rng.normal(size=(20, 2)), axis=0), title=names[k % 3], target=rng.normal(size=2), radius=0.1)
        for k in range(count)
    ]
    check(motions_figure(motions))
