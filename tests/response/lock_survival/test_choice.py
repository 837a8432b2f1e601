"""The motion over the nodes of a path: beside a count of all motions, found among all moves and by a tree of neighbours."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import holdfast as hf
from holdfast.response.lock_survival import dynamic_program
from holdfast.response.lock_survival.grid import CurveNodes

SPAN, EXTRA = 0.5, 0.3


def arm(limits):
    """Joints of such limits."""
    joints = [hf.DH(a=1.0, alpha=0.0, lower=low, upper=high) for low, high in limits]
    return hf.Arm.from_dh(joints, name="any")


def nodes(machine, q):
    number = np.arange(len(q))
    return CurveNodes._create(machine, q, SPAN, 0 * number, number, number)


def flat(q):
    return np.concatenate([np.cos(q), np.sin(q)], axis=-1)


def allowed(a, b, limit, extra):
    """(P, Q) which moves from a to b are: joints within their limits, and short where one has none."""
    angle = np.abs(np.angle(np.exp(1j * (a[:, None] - b))))
    far = np.linalg.norm(flat(a)[:, None] - flat(b), axis=2)
    short = np.inf if np.isfinite(limit).all() else 3 * SPAN + 2 * np.median(far.min(axis=1))
    return (angle <= limit + extra).all(axis=2) & (far <= short), far**2


@pytest.mark.parametrize("dense", [0, dynamic_program._MAX_DENSE_MOVES], ids=["tree", "all"])
@pytest.mark.parametrize("known", [True, False])
def test_no_motion_gathers_more_and_none_as_good_is_shorter(rng, monkeypatch, dense, known):
    monkeypatch.setattr(dynamic_program, "_MAX_DENSE_MOVES", dense)
    machine = arm([(-np.inf, np.inf), (-np.inf, np.inf)])
    limit = np.array([0.9, 1.2 if known else np.inf])
    found = 0
    for _ in range(6):
        q = [rng.uniform(-np.pi, np.pi, (5, 2)) for _ in range(4)]
        gains = [rng.integers(0, 3, 5).astype(np.float64) for _ in range(4)]
        fronts = dynamic_program.BestPathTable(gains), dynamic_program.BestPathTable(gains, EXTRA)
        dynamic_program.advance_tables(machine, [nodes(machine, x) for x in q], limit, fronts)
        for front in fronts:
            steps = [allowed(a, b, limit, front.allowed_excess) for a, b in itertools.pairwise(q)]
            worth = {}
            for way in itertools.product(range(5), repeat=4):
                moves = list(zip(steps, itertools.pairwise(way), strict=True))
                if all(good[m] for (good, _), m in moves):
                    worth[way] = sum(g[k] for g, k in zip(gains, way, strict=True)), -sum(far[m] for (_, far), m in moves)
            if not worth:
                assert front.last_pose is not None
                continue
            found += 1
            best = max(worth.values())
            assert front.best_total == best[0]
            assert worth[tuple(front.trace_best_motion().tolist())] == (best[0], pytest.approx(best[1]))
    assert found > 2
