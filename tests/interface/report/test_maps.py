"""What a cell of a map says when poses have weights."""

from __future__ import annotations

import numpy as np
import pytest

from holdfast.interface.report import View, map_figure, share_figure

SIDE = View(np.eye(3)[0], np.eye(3)[2], "Side")


def written(figure):
    """The numbers in the cells, by their places."""
    axes = figure.axes[0]
    return {(round(t.xy[0], 6), round(t.xy[1], 6)): t.get_text() for t in axes.texts if t.xyann == (0, 5)}


def cells(points, bins):
    """Which cell each point is in, as the middle of the cell, counted another way than the figure does."""
    low, size = points.min(axis=0), np.ptp(points, axis=0)
    count = np.maximum(np.round(bins * size[[0, 2]] / size[[0, 2]].max()), 1)
    out = []
    for x, z in points[:, [0, 2]]:
        at = [
            min(int((v - lo) / s * n), int(n) - 1) for v, lo, s, n in zip((x, z), low[[0, 2]], size[[0, 2]], count, strict=True)
        ]
        middle = [lo + (k + 0.5) * s / n for k, lo, s, n in zip(at, low[[0, 2]], size[[0, 2]], count, strict=True)]
        out.append(tuple(round(float(m), 6) for m in middle))
    return out


@pytest.mark.parametrize("median", [False, True])
def test_whole_weights_are_so_many_poses(rng, median):
    points, values, weights = rng.random((150, 3)), rng.random(150), rng.integers(0, 5, 150)
    shown = written(
        map_figure(
            points,
            {"found": values},
            [SIDE],
            log=False,
            smaller_is_better=median,
            label="m",
            bins=3,
            weights=weights.astype(float),
        )
    )
    place = cells(points, 3)
    for cell in set(place):
        mine = [k for k, c in enumerate(place) if c == cell]
        repeated = np.repeat(values[mine], weights[mine])
        if repeated.size:
            expected = np.quantile(repeated, 0.5, method="inverted_cdf") if median else repeated.mean()
            assert float(shown[cell]) == pytest.approx(expected, abs=0.0051)
        else:
            assert cell not in shown


def test_shares_count_by_weight_and_equal_weights_change_nothing(rng):
    points, having = rng.random((90, 3)), rng.random(90) < 0.5
    plain, equal = (
        written(share_figure(points, [("a", having)], SIDE, label="s", bins=3, weights=w)) for w in (None, np.full(90, 0.3))
    )
    assert plain == equal
    heavy = written(share_figure(points, [("a", having)], SIDE, label="s", bins=3, weights=np.where(having, 1.0, 0.0)))
    place = cells(points, 3)
    assert {c for c, t in heavy.items() if t == "1.00"} == {c for c, h in zip(place, having, strict=True) if h}
