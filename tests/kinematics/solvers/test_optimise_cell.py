"""Optimised configurations that keep clear of a cell: against exhaustive search in the plane, and coal in space."""

from __future__ import annotations

import numpy as np
import pytest

import cells
import holdfast as hf
import oracles
from holdfast.core.status import Status
from holdfast.kinematics.solvers import optimise
from holdfast.kinematics.solvers.optimum import get_cached_ascent
from holdfast.model.cell import Box, Sphere

WIDTH, MARGIN = 0.03, 0.02
DISCS = [((0.9, 0.9), 0.25), ((-0.4, 1.1), 0.2), ((0.2, -1.2), 0.3)]


@pytest.fixture(scope="module")
def index():
    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0) for _ in range(3)], name="planar")
    return hf.indices.manipulability(arm, "planar")


@pytest.fixture(scope="module")
def clearance(index):
    """Discs in the plane of the arm, whose links pass through each other but not through them."""
    discs = [Sphere(f"disc{k}", r, pose=cells.placed(*at, 0), margin=0.01 * k) for k, (at, r) in enumerate(DISCS)]
    return hf.Clearance(index.arm, hf.Capsules.along_links(index.arm, WIDTH), hf.Cell(discs), itself=False)


def room(q):
    """(N,) by plane geometry, of the links themselves: at most 3 mm more than by the spheres that cover them."""
    gaps = [cells.from_disc([1, 1, 1], WIDTH, q, at, r) - 0.01 * k for k, (at, r) in enumerate(DISCS)]
    return np.min(gaps, axis=0)


def test_exhaustive_search_among_discs(index, clearance, rng):
    arm = index.arm
    radius, angle = rng.uniform(0.3, 2.6, 40), rng.uniform(-np.pi, np.pi, 40)
    poses = np.tile(np.eye(4), (40, 1, 1))
    poses[:, :2, 3] = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    best = optimise(arm, poses, index, clearance=clearance, margin=MARGIN)
    free = optimise(arm, poses, index)
    assert 5 < best.blocked.sum() < 35
    short = []
    for k, pose in enumerate(poses):
        q = oracles.three_link_fibre(arm, pose[:2, 3])
        values = oracles.index("manipulability", oracles.task_jacobian(arm, q, "planar"), [(0,), (1,), (2,)]).min(axis=1)
        clear = room(q) >= MARGIN + 0.004
        if best.status[k] == Status.INFEASIBLE:
            assert clear.mean() < 0.03  # at most slivers
            continue
        assert room(best.q[k][None])[0] >= MARGIN
        assert clearance.margin_left(best.q[k]) >= MARGIN
        assert best.value[k] <= free.value[k] + 1e-6
        if clear.any():
            short.append(values[clear].max() - best.value[k])
    assert (best.status == Status.INFEASIBLE).any()
    assert (np.array(short) <= 5e-3).mean() >= 0.95
    np.testing.assert_array_equal(best.q[~best.blocked], free.q[~best.blocked])
    bars = [best.obstacles[k] for k in range(40)]
    for k in np.flatnonzero(best.blocked):
        found = free.q[k][None] if best.success[k] else oracles.three_link_fibre(arm, poses[k, :2, 3])
        gaps = [cells.from_disc([1, 1, 1], WIDTH, found, at, r) - 0.01 * j for j, (at, r) in enumerate(DISCS)]
        nearest = np.bincount(np.argmin(gaps, axis=0), minlength=len(DISCS)) / len(found)
        # Without a clear one it is what bars most of those found, which are not spread as those of the fibre are.
        assert nearest[int(bars[k][-1])] >= (1 if best.success[k] else 0.25)
    assert not any(bars[k] for k in np.flatnonzero(~best.blocked))


def test_a_step_is_compiled_once_for_all_cells(index, clearance):
    one = get_cached_ascent(index, None, clearance, MARGIN)._collision_free_step
    other = hf.Clearance(
        index.arm, clearance.capsules, hf.Cell([Box("box", [1, 1, 1], pose=cells.placed(3, 0, 0))]), itself=False
    )
    two = get_cached_ascent(index, None, other, MARGIN)._collision_free_step
    assert one.source_digest == two.source_digest
    assert one.source_digest is not None


def test_the_best_of_a_panda_over_a_bench_touches_nothing(rng):
    arm, cell = hf.arms.load("panda"), cells.bench()
    index = hf.indices.relative_manipulability(arm)
    q = oracles.inside(arm, rng, 2000)
    clearance = hf.Clearance(arm, cell=cell, itself=False)
    near = clearance.margin_left(q)
    q = q[(near > 0) & (near < 0.06)][:40]
    best = optimise(arm, oracles.forward(arm, q), index, clearance=False, cell=cell, starts=24)
    assert best.clearance.cell is cell
    assert best.blocked.any()
    good = best.success
    assert good.mean() > 0.9
    assert not cells.touches(arm, clearance.capsules, cell, best.q[good]).any()
    assert (clearance.margin_left(best.q[good]) >= 0).all()
    assert any("&" in name for name in best.obstacles)


def test_what_is_found_without_a_clear_one_says_what_is_in_the_way(index, clearance):
    pose = cells.placed(0.9, 0.9, 0)  # within a disc
    with pytest.raises(
        hf.HoldfastError,
        match=r"comes closer to the cell than it may in each .* most often by joint3 & disc0: .* move the object",
    ):
        optimise(index.arm, pose, index, clearance=clearance).require_any()


def test_a_cell_is_given_in_one_place(index, clearance):
    with pytest.raises(hf.InputError, match="give the cell in one place"):
        optimise(index.arm, np.eye(4), index, clearance=clearance, cell=hf.Cell([Sphere("ball", 0.1)]))
