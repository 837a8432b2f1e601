"""How far a path can be followed from where the arm is, against closed forms on grids of a planar arm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import label

import holdfast as hf

LENGTHS = np.array([1.0, 1.0, 1.0])
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


def followed(roots, second, begin, end, low, high, clear=lambda _: True, steps=4000):
    """Of joints 1 and 3 alone, the place (R,) to which each root (R, 2) is followed by Newton's method."""
    found = np.zeros(len(roots))
    for r, (a, c) in enumerate(roots):
        for k in range(steps + 1):
            target, before = begin + (end - begin) * k / steps, (a, c)
            for _ in range(20):
                q = np.array([a, second, c])
                off = target - tip(q)
                turns = np.exp(1j * np.cumsum(q)) * LENGTHS
                slopes = 1j * np.array([turns.sum(), turns[2]])
                matrix = np.array([slopes.real, slopes.imag])
                if abs(np.linalg.det(matrix)) < 1e-9:
                    break
                step = np.linalg.solve(matrix, [off.real, off.imag])
                a, c = a + step[0], c + step[1]
                if np.abs(step).max() < 1e-12:
                    break
            q = np.array([a, second, c])
            good = abs(target - tip(q)) < 1e-9 and max(abs(a - before[0]), abs(c - before[1])) < 0.1
            if not (good and (q >= low).all() and (q <= high).all() and clear(q)):
                break
            found[r] = k / steps
    return found


def roots_of(second, target, low, high):
    """(R, 2) of joints 1 and 3 with joint 2 locked, in closed form."""
    upper = LENGTHS[0] + LENGTHS[1] * np.exp(1j * second)
    bend = np.arccos(np.clip((abs(target) ** 2 - abs(upper) ** 2 - LENGTHS[2] ** 2) / (2 * abs(upper) * LENGTHS[2]), -1, 1))
    found = []
    for sign in (bend, -bend):
        first = wrapped(np.angle(target) - np.angle(upper) - np.angle(abs(upper) + LENGTHS[2] * np.exp(1j * sign)))
        third = wrapped(sign + np.angle(upper) - second)
        q = np.array([first, second, third])
        if (q >= low).all() and (q <= high).all():
            found.append([first, third])
    return np.array(found)


def path_of(begin, end):
    return hf.paths.line([begin.real, begin.imag, 0], [end.real, end.imag, 0])


def test_the_end_of_a_path_of_a_locked_arm_is_found_to_two_thousandths(rng):
    low, high, seen = np.array([-2.0, -2.2, -1.6]), np.array([2.1, 2.0, 2.4]), 0
    arm = limited(low, high)
    while seen < 12:
        at = rng.uniform(low, high)
        begin = tip(rng.uniform(low, high) * [1, 0, 1] + at * [0, 1, 0])
        end = begin + rng.uniform(0.5, 2.5) * np.exp(1j * rng.uniform(0, 2 * np.pi))
        expected = followed(roots_of(at[1], begin, low, high), at[1], begin, end, low, high).max()
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
        if seen >= 6 and kept_apart >= 2:
            break
        second = rng.uniform(-1, 1)
        grid[..., 1] = second
        centres = rng.uniform(-2.4, 2.4, 3) + 1j * rng.uniform(-2.4, 2.4, 3)
        centres = centres[np.abs(centres) > 0.4]
        room = between_balls(centres, grid.reshape(-1, 3)).reshape(count, count)
        at = np.array([*rng.uniform(-2.5, 2.5, 1), second, *rng.uniform(-2.5, 2.5, 1)])
        begin = tip(np.array([*rng.uniform(-2.5, 2.5, 1), second, *rng.uniform(-2.5, 2.5, 1)]))
        end = begin + rng.uniform(0.8, 2.5) * np.exp(1j * rng.uniform(0, 2 * np.pi))
        roots = roots_of(second, begin, low, high)
        if len(roots) < 2 or between_balls(centres, at[None])[0] < 0.05:
            continue
        whole = np.insert(roots, 1, second, axis=1)
        if (between_balls(centres, whole) < 0.05).any():
            continue
        (here, *there) = [tuple(np.abs(axis - q[k]).argmin() for k in (0, 2)) for q in (at, *whole)]
        wide, narrow = (label(room > least, np.ones((3, 3)))[0] for least in (-0.02, 0.06))
        joined = [wide[here] == wide[place] != 0 for place in there]
        if joined != [narrow[here] == narrow[place] != 0 for place in there] or not any(joined):
            continue

        def clear(q, centres=centres):
            return between_balls(centres, q[None])[0] >= 0

        ends = followed(roots, second, begin, end, low, high, clear, steps=2000)
        expected = ends[joined].max()
        if not 0.02 < expected < 0.98 or (len(set(joined)) == 1 and seen >= 4):
            continue
        seen += 1
        kept_apart += ends.max() > expected + 0.02
        balls = [hf.cell.Sphere(f"ball{k}", BALL, pose=[c.real, c.imag, 0]) for k, c in enumerate(centres)]
        shape = hf.Clearance(arm, hf.Capsules.along(arm, THICK), hf.Cell(balls), itself=False)
        found = hf.recover(arm, ["joint2"], at, goal=None, path=path_of(begin, end), clearance=shape, samples=0, tries=2)
        # The bound of the clearance lacks up to some mm.
        assert found.rest.furthest == pytest.approx(expected, abs=4e-3)
    assert kept_apart >= 2
