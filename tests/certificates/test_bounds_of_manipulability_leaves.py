"""Bounds of the leaves of ceilings and floors against sampled extremes, on Jacobians whose derivatives are chosen freely.

The bounds of the screws of arms are compared with arms elsewhere. Here the entries of a Jacobian are cubic functions of two
joints, so that each term of the bounds of a leaf can be the greatest one, and a bound without it is wrong.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from holdfast.certificates.verifier_parts import bounds
from holdfast.certificates.verifier_parts.balls import BallArray

flint = pytest.importorskip("flint", reason="python-flint is not installed")
CASES, ROUNDING = 200, 1e-9
ROWS = [0, 3]  # the entries of a screw that count here; the two behind each carry its second derivatives
SIDE = np.linspace(-1, 1, 9)
GRID = np.stack(np.meshgrid(SIDE, SIDE), -1).reshape(-1, 2)  # values of the two joints, in half widths


@pytest.fixture(autouse=True)
def quiet():
    """Compute as the verifier does: NaN proves nothing."""
    with np.errstate(all="ignore"):
        yield


class Cubics:
    """Jacobians (N, n, 2), transposed, whose entries are cubic in the first two joints, within half widths (N, 2)."""

    def __init__(self, half: Any, value: Any, slopes: Any, second: Any, third: Any, ways: Any) -> None:
        """Take the derivatives: (N, n, 2), (N, 2, n, 2), (N, 2, 2, n, 2), (N, n, 2), and the way (N, 2) of the third one."""
        self.half, self.value, self.slopes, self.second, self.third, self.ways = half, value, slopes, second, third, ways
        count, n = value.shape[:2]
        screw, bracket, operator = np.zeros((count, n, 6)), np.zeros((count, n, n, 6)), np.zeros((count, n, 6, 6))
        screw[..., ROWS], bracket[:, :2, :, ROWS] = value, np.moveaxis(slopes, -1, 0).transpose(1, 2, 3, 0)
        for joint in range(2):
            entries = [row + 1 + joint for row in ROWS]
            operator[:, joint, ROWS, entries] = 1
            bracket[:, :2, :, entries] = second[:, joint]
        curved = np.einsum("nijlb,ni,nj->nlb", abs(second), half, half) / 2
        self.screws = SimpleNamespace(
            order=list(range(n)),
            half=np.pad(half, ((0, 0), (0, n - 2))),
            side=np.ones(n),
            same_side=np.ones((n, n)),
            moves=np.ones((n, n)),
            screws=BallArray(screw),
            brackets=BallArray(bracket),
            operators=BallArray(operator),
            second_remainder=np.repeat(curved + abs(third), 3, axis=2),
            third_remainder=np.repeat(abs(third), 3, axis=2),
        )

    def on_grid(self) -> tuple[Any, Any]:
        """Return the joints (N, points, 2) and the Jacobians there (N, points, n, 2)."""
        t = GRID * self.half[:, None]
        cubic = np.einsum("pi,ni->np", GRID, self.ways) ** 3
        jacobian = self.value[:, None] + np.einsum("npi,nilb->nplb", t, self.slopes)
        jacobian = jacobian + np.einsum("npi,npj,nijlb->nplb", t, t, self.second) / 2
        return t, jacobian + cubic[:, :, None, None] * self.third[:, None]


def draw_cubics(rng, n, rows=0):
    """Draw Jacobians in which some derivatives are zero, others large, and the first joints drive the first rows."""

    def draw(*shape):
        entries = rng.normal(size=(CASES, *shape))
        return entries * rng.choice([0, 0.1, 1], (CASES, *[1] * len(shape))) * rng.choice([0, 1], entries.shape)

    second, ways = draw(2, 2, n, 2), rng.uniform(-1, 1, (CASES, 2))
    half = rng.uniform(0.05, 0.5, (CASES, 2)) * rng.choice([0, 1], (CASES, 2), p=[0.3, 0.7])
    second, ways = (second + second.swapaxes(1, 2)) / 2, ways / abs(ways).sum(axis=1, keepdims=True) * (half > 0)
    value = draw(n, 2) + np.eye(n, 2) * (np.arange(2) < rows) * rng.uniform(0.7, 1.5, (CASES, 1, 1))
    return Cubics(half, value, draw(2, n, 2), second, 0.3 * draw(n, 2), ways)


def one_joint(half, value, slopes, second, third):
    """Return a Jacobian of one row, in which one joint moves; the arguments have one number for each column."""
    columns = [np.array(x, dtype=float)[None, :, None] * [1, 0] for x in (value, slopes, second, third)]
    slopes, second = (np.zeros((1, *[2] * order, len(value), 2)) for order in (1, 2))
    slopes[:, 0], second[:, 0, 0] = columns[1], columns[2]
    return Cubics(np.array([[half, 0.0]]), columns[0], slopes, second, columns[3], np.array([[1.0, 0.0]]))


def bisect(leaves, proves, count, *, ceiling):
    """Return the least thresholds that leaves prove of a ceiling, or the greatest ones of a floor, (N,)."""
    low, high = np.zeros(count), np.ones(count)
    for _ in range(32):
        leaves.threshold = (low + high) / 2
        lower = proves() == ceiling
        low, high = np.where(lower, low, leaves.threshold), np.where(lower, leaves.threshold, high)
    return high if ceiling else low


# ---- ceilings ------------------------------------------------------------------------------------------------------


def ceiling_and_truth(monkeypatch, cubics, wrench, turn):
    """The proved ceiling for the last joint and the greatest value on the grid, of a wrench (N, 2) with slopes (N, 2, 2)."""
    x, (t, jacobian) = cubics.screws, cubics.on_grid()
    count, n = x.screws.center.shape[:2]
    y, slopes = np.zeros((count, 6)), np.zeros((count, 6, n))
    y[:, ROWS], slopes[:, ROWS, :2] = wrench, turn
    leaves = object.__new__(bounds.CeilingVerifier)
    leaves.arm, leaves.enclose_centers, leaves.choose_wrench = None, lambda cells: [], lambda *_: (y, slopes)
    monkeypatch.setattr(bounds, "ScrewEnclosure", lambda *_: x)
    moments = np.einsum("nplb,npb->npl", jacobian, wrench[:, None] + np.einsum("nbi,npi->npb", turn, t)) ** 2
    truth = np.sqrt(np.nan_to_num(moments[..., :-1].sum(axis=2) / moments.sum(axis=2), nan=1.0)).max(axis=1)
    return bisect(leaves, lambda: leaves.verify_leaves(n - 1, []), count, ceiling=True), truth


def test_ceilings_of_random_jacobians(monkeypatch, rng):
    cubics = draw_cubics(rng, 3)
    wrench, turn = rng.normal(size=(CASES, 2)), rng.normal(size=(CASES, 2, 2)) * rng.choice([0, 1], (CASES, 1, 1))
    proved, truth = ceiling_and_truth(monkeypatch, cubics, wrench, turn)
    assert (proved >= truth - ROUNDING).all()
    assert (proved < 0.99).any()


@pytest.mark.parametrize(
    ("entries", "turn"),
    [
        # The moment of the locked joint is 1 - 0.3 at the edge; that of another joint is 1.
        (([1, 1], [0, -0.6], [0, 0], [0, 0]), 0.0),
        (([1, 1], [0, 0], [0, -2.4], [0, 0]), 0.0),
        (([1, 1], [0, 0], [0, 0], [0, -0.3]), 0.0),
        # The moment of the other joint is 1.3 at the edge.
        (([1, 1], [0.6, 0], [0, 0], [0, 0]), 0.0),
        (([1, 1], [0, 0], [2.4, 0], [0, 0]), 0.0),
        (([1, 1], [0, 0], [0, 0], [0.3, 0]), 0.0),
        # The wrench grows by 0.6 of itself for a radian: third order is 0.3 * 0.4, and second order that of the slopes.
        (([1, 1], [-0.6, -0.6], [0.72, -0.48], [0, 0]), 0.6),
        (([1, 1], [-0.6, -0.6], [1.2, 0.72], [0, 0]), 0.6),
    ],
)
def test_ceilings_in_which_one_term_counts(monkeypatch, entries, turn):
    cubics = one_joint(0.5, *entries)
    proved, truth = ceiling_and_truth(monkeypatch, cubics, np.array([[1.0, 0.0]]), np.array([[[turn, 0], [0, 0]]]))
    assert truth - ROUNDING <= proved <= truth + 0.2


# ---- floors --------------------------------------------------------------------------------------------------------


def floor_and_truth(cubics, motion, inverse, rows):
    """The proved floor for the last joint and the least value on the grid, of motions (N, n), inverses (N, n, rows)."""
    x, (t, jacobian) = cubics.screws, cubics.on_grid()
    leaves = object.__new__(bounds.FloorVerifier)
    leaves.screw_rows = ROWS[:rows]
    last = motion.shape[1] - 1
    proved = bisect(leaves, lambda: leaves.verify_null_motion(x, motion, inverse, [last]), len(motion), ceiling=False)
    jacobian, nu = jacobian[..., :rows], motion / np.linalg.norm(motion, axis=1)[:, None]
    follow = -np.einsum("nlb,nimb,nm->nli", inverse, cubics.slopes[..., :rows], nu)
    moved = nu[:, None] + np.einsum("nli,npi->npl", follow, t)
    matrix = np.einsum("nplb,nlc->npbc", jacobian, inverse)
    singular = abs(np.linalg.det(matrix)) < 1e-12
    matrix = np.where(singular[..., None, None], np.eye(rows), matrix)
    missed = np.einsum("nplb,npl->npb", jacobian, moved)
    moved = moved - np.einsum("nlb,npb->npl", inverse, np.linalg.solve(matrix, missed[..., None])[..., 0])
    kept = np.where(singular, 0.0, abs(moved[..., -1]) / np.linalg.norm(moved, axis=2))
    return proved, kept.min(axis=1)


@pytest.mark.parametrize("rows", [1, 2])
def test_floors_of_random_jacobians(rng, rows):
    cubics = draw_cubics(rng, 3, rows)
    inverse = np.linalg.pinv(cubics.value[..., :rows].swapaxes(1, 2)) + 0.1 * rng.normal(size=(CASES, 3, rows))
    motion = rng.normal(size=(CASES, 3))
    motion -= np.einsum("nlb,nmb,nm->nl", inverse, cubics.value[..., :rows], motion) * rng.choice([0, 1], (CASES, 1))
    proved, truth = floor_and_truth(cubics, motion, inverse, rows)
    assert (proved <= truth + ROUNDING).all()
    assert (proved > 0.1).any()


@pytest.mark.parametrize(
    ("entries", "motion", "inverse"),
    [
        # The motion (0, 1) misses by 0.3, which joint 1 makes up for.
        (([1, 0.3], [0, 0], [0, 0], [0, 0]), (0, 1), (1, 0)),
        (([1, 0], [0, 0], [0, 2.4], [0, 0]), (0, 1), (1, 0)),
        (([1, 0], [0, 0], [0, 0], [0, 0.3]), (0, 1), (1, 0)),
        (([-1, 0], [0, 0], [0, 0], [0, 0.3]), (0, -1), (-1, 0)),
        # Joint 2 makes up for it as well.
        (([1, 0], [0, 0], [0, 0], [0, 0.3]), (0, 1), (1, 0.5)),
        (([1, 0], [0, 0], [0, 0], [0, 0.3]), (0, 1), (1, -0.5)),
        # Joint 1 follows: by 4 to first order, by more to third.
        (([1, 0], [0, 8], [0, 0], [0, 0]), (0, 1), (1, 0)),
        (([1, 0], [0, 8], [-1.6, 0], [0, 0]), (0, 1), (1, 0)),
        (([1, 0], [-0.4, 8], [0, 0], [0, 0]), (0, 1), (1, 0)),
        # Of a long motion the locked joint does a small part, and less where it follows, or makes up for what is missed.
        (([1, 0, 0], [0, 0.06, 0], [0, 0, 0], [0, 0, 0]), (0, 10, 1), (1, 0, 2)),
        (([1, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0.03, 0]), (0, 10, 1), (1, 0, 2)),
        # It follows by less than it should: 0.3 of this, and later by the rest.
        (([1, 0], [0, 8], [0, 0], [0, 0]), (0, 1), (0.3, 0)),
        # Joint 1 follows and moves in the middle already.
        (([1, -3], [0, 2], [0, 0], [0, 0]), (3, 1), (1, 0)),
        # The motion misses by 3, and the matrices make up for a part of that: in the middle, or at the edge.
        (([1, 3], [0, 0], [0, 0], [0, 0]), (0, 1), (0.5, 0)),
        (([1, 3], [-1, 0], [0, 0], [0, 0]), (0, 1), (1, 0)),
        (([1, 3], [0, 0], [-4, 0], [0, 0]), (0, 1), (1, 0)),
        (([1, 3], [0, 0], [0, 0], [-0.5, 0]), (0, 1), (1, 0)),
    ],
)
def test_floors_in_which_one_term_counts(entries, motion, inverse):
    cubics = one_joint(0.5, *entries)
    proved, truth = floor_and_truth(cubics, np.array([motion], dtype=float), np.array(inverse, dtype=float)[None, :, None], 1)
    assert truth - 0.4 <= proved <= truth + ROUNDING
