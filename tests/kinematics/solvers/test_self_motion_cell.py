"""Self-motions in a cell: cut where plane geometry cuts them, never touching by coal, ends named."""

from __future__ import annotations

import numpy as np
import pytest

import cells
import holdfast as hf
import oracles
from holdfast.core.status import Status
from holdfast.model.cell import Sphere

WIDTH = 0.03
COVER = 0.1 * WIDTH  # what the spheres of a chain reach beyond a link, at most


@pytest.fixture(scope="module")
def arm():
    return hf.arms.load("planar-3r")


def among(arm, *discs, **options):
    """A clearance of the arm from discs in its plane; its own links pass each other."""
    solids = [Sphere(f"disc{k}", r, pose=cells.placed(*at, 0), **options) for k, (at, r) in enumerate(discs)]
    return hf.Clearance(arm, hf.Capsules.along_links(arm, WIDTH), hf.Cell(solids), itself=False)


def room(q, *discs):
    return np.min([cells.from_disc([1, 1, 1], WIDTH, q, at, r) for at, r in discs], axis=0)


@pytest.mark.parametrize(
    ("point", "discs"),
    [((1.2, 0.4), [((0.4, 0.9), 0.2)]), ((0.9, 0.7), [((-0.5, 0.6), 0.15), ((0.9, -0.5), 0.2)])],
)
def test_curves_are_cut_where_plane_geometry_cuts_them(arm, point, discs):
    clearance = among(arm, *discs)
    found = hf.self_motion(arm, point, "planar", clearance=clearance, margin=0.01)
    whole = hf.self_motion(arm, point, "planar")
    assert len(found.components) > len(whole.components) > 0
    for c in found.components:
        way = cells.finely(c.q)
        assert room(way, *discs).min() >= 0.01 - 1e-4  # between points the chord leaves the curve a little
        assert room(c.q, *discs).min() >= 0.01
        assert c.closed is False
        for q, pair, joint in zip(c.q[[0, -1]], c.barred_by, c.bounded_by, strict=True):
            if joint is not None:
                assert pair == ""
                assert min(np.abs(q[joint] - arm.lower[joint]), np.abs(q[joint] - arm.upper[joint])) < 1e-9
                continue
            assert pair.partition(" & ")[0] in arm.joint_names
            gaps = [cells.from_disc([1, 1, 1], WIDTH, q[None], at, r)[0] for at, r in discs]
            assert pair.endswith(f"disc{int(np.argmin(gaps))}")
            assert 0.01 <= min(gaps) <= 0.01 + COVER + 1e-3
    # Nothing that is clear is missing: every configuration of the pose, in closed form, lies near a part.
    every = oracles.three_link_fibre(arm, np.array(point), 2000)
    sure = every[room(every, *discs) >= 0.01 + COVER + 2e-3]
    away = (sure[:, None] - found.q[None] + np.pi) % (2 * np.pi) - np.pi
    assert np.linalg.norm(away, axis=2).min(axis=1).max() < 0.06
    assert sum(c.length for c in found.components) < sum(c.length for c in whole.components)


def test_what_is_far_from_everything_is_what_it_was(arm):
    clearance = among(arm, ((8.0, 0.0), 0.2))
    found, plain = (hf.self_motion(arm, [1.0, 0.5], "planar", clearance=each) for each in (clearance, None))
    np.testing.assert_array_equal(found.q, plain.q)
    assert [c.closed for c in found.components] == [c.closed for c in plain.components]
    assert all(c.barred_by == ("", "") for c in found.components)
    assert found.clearance is clearance


def test_a_target_within_an_object_is_infeasible(arm):
    found = hf.self_motion(arm, [1.0, 0.5], "planar", clearance=among(arm, ((1.0, 0.5), 0.2)))
    assert (found.status, len(found.q), found.components) == (Status.INFEASIBLE, 0, ())
    assert "collides with the cell" in found.describe()[0]


def test_where_joints_may_lock_is_what_the_curves_pass(arm, rng):
    discs = [((0.4, 0.9), 0.2)]
    found = hf.self_motion(arm, [1.2, 0.4], "planar", clearance=among(arm, *discs))
    every = oracles.three_link_fibre(arm, np.array([1.2, 0.4]), 4000)
    gap = room(every, *discs)
    for k, arcs in enumerate(found.arcs()):

        def within(values, arcs=arcs, extra=0.0):
            return np.any([(a - extra <= values) & (values <= b + extra) for a, b in arcs], axis=0)

        assert within(every[gap >= COVER + 2e-3, k], extra=0.01).all()
        assert not within(np.array([a - 0.02 for a, _ in arcs])).all()


def test_samples_of_larger_manifolds_drop_what_is_not_clear(arm):
    discs = [((0.5, 0.8), 0.2)]
    found, whole = (
        hf.self_motion(arm, np.eye(4), ["vx"], spacing=0.4, starts=16, clearance=each) for each in (among(arm, *discs), None)
    )
    assert 50 < len(found.q) < len(whole.q)
    np.testing.assert_array_equal(found.q, whole.q[found.clearance.margin_left(whole.q) >= 0])
    assert room(found.q, *discs).min() >= 0
    with pytest.raises(hf.InputError, match="samples"):
        found.arcs()


def test_a_panda_over_a_bench_never_touches_it():
    arm, bench = hf.arms.load("panda"), cells.bench()
    pose = arm.forward_kinematics(np.array(hf.arms.about("panda").home))
    whole = max(hf.self_motion(arm, pose, starts=32).components, key=lambda c: c.length)
    elbow = arm.frames(whole.q[len(whole.q) // 5])[4, :3, 3]
    cell = hf.Cell([*bench, Sphere("lamp", 0.05, pose=cells.placed(*elbow))], margin=0.005)
    found = hf.self_motion(arm, pose, clearance=False, cell=cell, starts=32)
    assert found.components
    assert any(any(c.barred_by) for c in found.components)
    for c in found.components:
        assert not cells.touches(arm, found.clearance.capsules, cell, cells.finely(c.q, 8e-3)).any()
        for text in c.barred_by:
            assert not text or text in found.clearance.pair_names
