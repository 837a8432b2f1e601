"""How far a path can be followed from where the arm is, against closed forms on grids of a planar arm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import label

import holdfast as hf

LENGTHS = np.array([1.0, 1.0, 1.0])
PLACES = np.linspace(0, 1, 20_001)
THICK, BALL = 0.05, 0.2  # m


def limited(low, high):
    arm = hf.Arm.from_dh([hf.DH(a=length, alpha=0.0) for length in LENGTHS], name="three")
    joints = [replace(joint, lower=a, upper=b) for joint, a, b in zip(arm.joints, low, high, strict=True)]
    return replace(arm, joints=tuple(joints))


def tip(q):
    return (LENGTHS * np.exp(1j * np.cumsum(q, axis=-1))).sum(axis=-1)


def wrapped(x):
    return (x + np.pi) % (2 * np.pi) - np.pi


def elbows(target, first):
    """(2, N, 3) both configurations with the first joint given (N,), NaN where there is none."""
    left = target - LENGTHS[0] * np.exp(1j * first)
    with np.errstate(invalid="ignore"):
        bend = np.arccos((np.abs(left) ** 2 - LENGTHS[1] ** 2 - LENGTHS[2] ** 2) / (2 * LENGTHS[1] * LENGTHS[2]))
    found = []
    for third in (bend, -bend):
        inner = np.angle(LENGTHS[1] + LENGTHS[2] * np.exp(1j * third))
        found.append(np.stack([first, wrapped(np.angle(left) - inner - first), third], axis=1))
    return np.array(found)


def furthest_of_three(low, high, begin, end, steps=2000, count=3000):
    """Of three free joints: the last place of a flood over the first joint and both elbows, from place to place."""
    first, reached = np.linspace(low[0], high[0], count), None
    for k in range(steps + 1):
        q = elbows(begin + (end - begin) * k / steps, first)
        with np.errstate(invalid="ignore"):
            free = ((q >= low) & (q <= high)).all(axis=2)
        # Elbow up, elbow down, and where the elbow is stretched they are one.
        names, _ = label(free, [[0, 0, 0], [1, 1, 1], [0, 0, 0]])
        edge = free.all(axis=0) & (np.abs(q[0, :, 2]) < 0.08)
        for a, b in set(zip(names[0, edge], names[1, edge], strict=True)):
            names[names == b] = a
        seeds = free if reached is None else free & reached
        reached = np.isin(names, np.unique(names[seeds])) & free
        if not reached.any():
            return (k - 1) / steps if k else 0.0
    return 1.0


def branches(second, target, low, high):
    """(2, N, 3) both configurations of targets (N,) with joint 2 locked, NaN where there is none within the limits."""
    upper = LENGTHS[0] + LENGTHS[1] * np.exp(1j * second)
    with np.errstate(invalid="ignore"):
        bend = np.arccos((np.abs(target) ** 2 - abs(upper) ** 2 - LENGTHS[2] ** 2) / (2 * abs(upper) * LENGTHS[2]))
    found = []
    for turn in (bend, -bend):
        first = wrapped(np.angle(target) - np.angle(upper) - np.angle(abs(upper) + LENGTHS[2] * np.exp(1j * turn)))
        found.append(np.stack([first, np.full(len(turn), second), wrapped(turn + np.angle(upper) - second)], axis=1))
    q = np.array(found)
    with np.errstate(invalid="ignore"):
        q[~((q >= low) & (q <= high)).all(axis=2)] = np.nan
    return q


def ends_of_branches(q, free=None):
    """(2,) the place up to which each branch (2, N, 3) is there without a jump, and free; -1 where it does not begin."""
    good = np.isfinite(q).all(axis=2)
    if free is not None:
        good[good] = free(q[good])
    with np.errstate(invalid="ignore"):
        good[:, 1:] &= np.abs(np.diff(q, axis=1)).max(axis=2) < 0.2
    lost = np.where(good.all(axis=1), q.shape[1], good.argmin(axis=1))
    return (lost - 1) / (q.shape[1] - 1)


def path_of(begin, end):
    return hf.paths.line([begin.real, begin.imag, 0], [end.real, end.imag, 0])


def test_the_end_of_a_path_of_a_locked_arm_is_found_to_two_thousandths(rng):
    low, high, seen = np.array([-2.0, -2.2, -1.6]), np.array([2.1, 2.0, 2.4]), 0
    arm = limited(low, high)
    while seen < 12:
        at = rng.uniform(low, high)
        begin = tip(rng.uniform(low, high) * [1, 0, 1] + at * [0, 1, 0])
        end = begin + rng.uniform(0.5, 2.5) * np.exp(1j * rng.uniform(0, 2 * np.pi))
        expected = ends_of_branches(branches(at[1], begin + (end - begin) * PLACES, low, high)).max()
        if not 0.02 < expected < 0.98:
            continue
        seen += 1
        found = hf.recover(arm, ["joint2"], at, goal=None, path=path_of(begin, end), clearance=False, samples=0, starts=64)
        assert found.rest.furthest == pytest.approx(expected, abs=2e-3)
        assert abs(tip(found.rest.begin) - begin) < 1e-5
        numbers = ", ".join(f"{x:.4g}" for x in found.rest.begin)
        assert f"from the configuration ({numbers}) of its first pose" in found.rest.describe()


def test_self_motion_is_used_to_get_further(rng):
    """All three joints move within narrow ranges: following alone ends early, a flood over all of them does not."""
    low, high, seen = np.array([-0.9, -1.2, -1.4]), np.array([1.1, 1.3, 1.2]), 0
    arm = limited(low - 0.1, high + 0.1)
    ranges = {f"joint{k + 1}": (low[k], high[k]) for k in range(3)}
    while seen < 6:
        at = rng.uniform(low, high)
        begin = tip(at)
        end = begin + rng.uniform(0.8, 2.5) * np.exp(1j * rng.uniform(0, 2 * np.pi))
        expected = furthest_of_three(low, high, begin, end, 200, 800)
        if not 0.05 < expected < 0.95:
            continue
        expected, seen = furthest_of_three(low, high, begin, end), seen + 1
        bad = hf.Degraded(arm, ranges=ranges)
        found = hf.recover(arm, bad, at, goal=None, path=path_of(begin, end), clearance=False, samples=0, starts=64)
        assert found.rest.furthest == pytest.approx(expected, abs=2e-3)


def between_balls(centres, q):
    """(N,) what is left between the links and the balls, by projection."""
    points = np.concatenate([np.zeros((len(q), 1)), np.cumsum(LENGTHS * np.exp(1j * np.cumsum(q, axis=1)), axis=1)], axis=1)
    least = np.full(len(q), np.inf)
    for centre in centres:
        for k in range(3):
            a, d = points[:, k], points[:, k + 1] - points[:, k]
            s = np.clip(((centre - a) * d.conj()).real / np.abs(d) ** 2, 0, 1)
            least = np.minimum(least, np.abs(a + s * d - centre))
    return least - BALL - THICK


def test_only_branches_that_a_motion_leads_to_count(rng):
    """Balls between the two elbows of a locked arm: which one can be got to is known from a flood over a grid."""
    low, high, count = np.full(3, -2.8), np.full(3, 2.8), 240
    arm, seen, kept_apart = limited(low, high), 0, 0
    axis = np.linspace(-2.8, 2.8, count)
    grid = np.zeros((count, count, 3))
    grid[..., 0], grid[..., 2] = np.meshgrid(axis, axis, indexing="ij")
    for _ in range(400):
        if seen >= 4 and kept_apart >= 1:
            break
        second = rng.uniform(-1, 1)
        grid[..., 1] = second
        centres = rng.uniform(-2.4, 2.4, 3) + 1j * rng.uniform(-2.4, 2.4, 3)
        centres = centres[np.abs(centres) > 0.4]
        room = between_balls(centres, grid.reshape(-1, 3)).reshape(count, count)
        at = np.array([*rng.uniform(-2.5, 2.5, 1), second, *rng.uniform(-2.5, 2.5, 1)])
        begin = tip(np.array([*rng.uniform(-2.5, 2.5, 1), second, *rng.uniform(-2.5, 2.5, 1)]))
        end = begin + rng.uniform(0.8, 2.5) * np.exp(1j * rng.uniform(0, 2 * np.pi))
        q = branches(second, begin + (end - begin) * PLACES[::10], low, high)
        if not np.isfinite(q[:, 0]).all() or between_balls(centres, at[None])[0] < 0.05:
            continue
        if (between_balls(centres, q[:, 0]) < 0.05).any():
            continue
        (here, *there) = [tuple(np.abs(axis - x[k]).argmin() for k in (0, 2)) for x in (at, *q[:, 0])]
        wide, narrow = (label(room > least, np.ones((3, 3)))[0] for least in (-0.02, 0.06))
        joined = [wide[here] == wide[place] != 0 for place in there]
        if joined != [narrow[here] == narrow[place] != 0 for place in there] or not any(joined):
            continue

        ends = ends_of_branches(q, lambda x, centres=centres: between_balls(centres, x) >= 0)
        expected = ends[joined].max()
        if not 0.02 < expected < 0.98 or (len(set(joined)) == 1 and seen >= 3):
            continue
        seen += 1
        kept_apart += ends.max() > expected + 0.02
        balls = [hf.cell.Sphere(f"ball{k}", BALL, pose=[c.real, c.imag, 0]) for k, c in enumerate(centres)]
        shape = hf.Clearance(arm, hf.Capsules.along_links(arm, THICK), hf.Cell(balls), itself=False)
        found = hf.recover(arm, ["joint2"], at, goal=None, path=path_of(begin, end), clearance=shape, samples=0, tries=2)
        # The bound of the clearance lacks up to some mm.
        assert found.rest.furthest == pytest.approx(expected, abs=4e-3)
    assert kept_apart >= 1
