"""Swept space of a fall: a torus piece, a rounded cylinder, random points, boxes, and bad inputs."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from falling_arms import FREE, LENGTH, lift, pendulum
from holdfast.control.falls import sweep
from holdfast.model.cell import HalfSpace
from holdfast.model.collision import Capsules, LinkCapsule
from holdfast.model.collision.sphere_cover import make_sphere_cover

RADIUS = 0.06


def ball(arm: hf.Arm, point=(LENGTH, 0, 0), cell=None, radius=RADIUS) -> hf.Clearance:
    return hf.Clearance(arm, Capsules((LinkCapsule(arm.n - 1, point, point, radius=radius),)), cell, itself=False)


def test_a_sphere_on_an_arc_sweeps_a_torus_piece_with_two_caps():
    arm = pendulum(lower=-np.pi / 2, upper=1.0)
    fall = hf.power_loss(arm, [0.3], friction=FREE, clearance=ball(arm))
    assert fall.q_final == pytest.approx(-np.pi / 2)
    exact = np.pi * RADIUS**2 * LENGTH * (0.3 + np.pi / 2) + 4 / 3 * np.pi * RADIUS**3
    for voxel, width in ((0.01, 0.6), (0.005, 0.3)):
        swept = fall.sweep(voxel=voxel)
        assert swept.lower_volume < exact < swept.upper_volume
        assert swept.upper_volume - swept.lower_volume < width * exact
    assert (swept.lower_volume + swept.upper_volume) / 2 == pytest.approx(exact, rel=0.05)
    high = [LENGTH + RADIUS, RADIUS, LENGTH * np.sin(0.3) + RADIUS]
    np.testing.assert_allclose(swept.box, [[-RADIUS, -RADIUS, -LENGTH - RADIUS], high], atol=1e-4)
    np.testing.assert_array_equal(swept.boxes, swept.box[None])
    assert swept.links == ("hinge",)
    distance = np.abs(np.hypot(np.hypot(swept.surface[:, 0], swept.surface[:, 2]) - LENGTH, swept.surface[:, 1]) - RADIUS)
    on_arc = np.abs(np.arctan2(swept.surface[:, 2], swept.surface[:, 0]) + 0.6) < 0.8
    assert (distance[on_arc] < 2 * 0.005 * np.sqrt(3)).all()


def test_a_fall_onto_a_floor_sweeps_the_way_to_the_contact():
    arm, floor = lift(), hf.Cell([HalfSpace("floor", pose=[0, 0, -0.3])])
    fall = hf.power_loss(arm, [[0.0], [0.5]], friction=FREE, clearance=ball(arm, (0, 0, 0), floor))
    for row, height in enumerate((0.3, 0.8)):
        exact = np.pi * RADIUS**2 * (height - RADIUS) + 4 / 3 * np.pi * RADIUS**3
        swept = fall.sweep(row)
        assert swept.lower_volume < exact < swept.upper_volume
        assert swept.box[0, 2] == pytest.approx(-0.3, abs=1e-3)


def test_a_rebound_between_two_instants_is_swept():
    heights = np.concatenate([np.linspace(1, 0.005, 100), np.linspace(0.005, 1, 100)])[:, None]  # it rebounds at 0
    swept = sweep.sweep_spheres(lift(), ball(lift(), (0, 0, 0), radius=0.02).capsules, heights, 2e-3)
    assert swept.upper_volume > np.pi * 0.02**2 * 1.0 + 4 / 3 * np.pi * 0.02**3
    assert swept.surface[:, 2].min() < -0.018  # the ball reaches to -0.02, and to -0.015 at the instants


@pytest.mark.parametrize("heights", [[0.0, 0.0], [0.0, 0.0049], [0.0, 0.03, 0.05]])
def test_voxels_are_counted_as_by_the_distances_of_their_corners(heights):
    voxel, radius = 0.01, 0.028
    swept = sweep.sweep_spheres(lift(), ball(lift(), (0, 0, 0), radius=radius).capsules, np.array(heights)[:, None], voxel)
    centers = swept.surface[0] + voxel * np.stack(np.meshgrid(*[np.arange(-25, 25)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    offsets = np.abs(centers[None] - np.array([[0, 0, height] for height in heights])[:, None])
    inside = (np.linalg.norm(offsets + voxel / 2, axis=2) <= radius).any(axis=0).sum()
    touched = (np.linalg.norm(np.maximum(offsets - voxel / 2, 0), axis=2) < radius).any(axis=0).sum()
    lower, upper = round(swept.lower_volume / voxel**3), round(swept.upper_volume / voxel**3)
    assert lower == inside
    assert upper == touched if heights[1] == 0 else upper >= touched


@pytest.mark.parametrize("types", ["RRR", "RPR"])
def test_random_points_agree_with_the_voxels(rng, types):
    arm = oracles.with_bodies(oracles.random_arm(rng, types=types, limits=2.0), rng)
    parts = [LinkCapsule(k, *map(tuple, rng.uniform(-0.2, 0.2, (2, 3))), radius=rng.uniform(0.03, 0.1)) for k in range(3)]
    parts.append(LinkCapsule(-1, (0, 0, 0), (0, 0, 0.5), radius=0.5))  # the base does not move
    clearance = hf.Clearance(arm, Capsules(tuple(parts)), itself=False)
    fall = hf.power_loss(
        arm, oracles.inside(arm, rng, 1)[0], friction=hf.Friction(viscous=0.3), clearance=clearance, duration=0.3
    )
    swept = fall.sweep(voxel=0.01)
    cover, frames = make_sphere_cover(clearance.capsules), oracles.frames(arm, fall.q_at(np.linspace(0, 0.3, 601)))
    points = rng.uniform(*swept.box, (4000, 3))
    is_inside = np.zeros(len(points), dtype=bool)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for link, center, radius in zip(cover.link, cover.center, cover.radius, strict=True):
        if link >= 0:
            centers = (frames[link + 1] @ [*center, 1])[:, :3]
            is_inside |= (np.linalg.norm(points[:, None] - centers, axis=2) < radius).any(axis=1)
            low, high = np.minimum(low, centers.min(axis=0) - radius), np.maximum(high, centers.max(axis=0) + radius)
    np.testing.assert_allclose(swept.box, [low, high], atol=1e-3)
    volume = is_inside.mean() * np.prod(high - low)
    error = 4 * np.sqrt(is_inside.mean() * (1 - is_inside.mean()) / len(points)) * np.prod(high - low)
    assert swept.lower_volume - error < volume < swept.upper_volume + error
    assert swept.upper_volume - swept.lower_volume < volume


def test_an_arm_that_holds_sweeps_its_own_volume():
    arm = hf.arms.load("panda")
    fall = hf.power_loss(arm, np.deg2rad([0, -45, 0, -135, 0, 90, 45]), friction=hf.Friction(coulomb=300))
    swept = fall.sweep(voxel=0.02)
    assert fall.outcome == "holds"
    assert swept.lower_volume < swept.upper_volume < 0.2


def test_wrong_requests_are_refused():
    arm = pendulum()
    falls = hf.power_loss(arm, [[0.0], [np.nan]], friction=FREE, clearance=ball(arm))
    for options, message in (
        ({}, "row is None; give the number of one fall, from 0 to 1"),
        ({"row": 1}, "the state in row 1 holds NaN"),
        ({"row": 0, "voxel": 0.0}, "voxel is 0 m"),
        ({"row": 0, "voxel": 1e-5}, "too small for this sweep; give at least"),
    ):
        with pytest.raises(hf.InputError, match=message):
            falls.sweep(**options)
    base = hf.Clearance(arm, Capsules((LinkCapsule(-1, (0, 0, 0), (0, 0, 0), radius=0.1),)), itself=False)
    with pytest.raises(hf.InputError, match="contains no moving link"):
        hf.power_loss(arm, [0.0], friction=FREE, clearance=base, duration=0.1).sweep()
