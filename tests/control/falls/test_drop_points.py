"""Drops of any point of the arm: NumPy kinematics of all spheres of the cover along the motion, closed forms, bad inputs."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import holdfast as hf
import oracles
from falling_arms import FREE, LENGTH, MASS, G
from holdfast.model.collision.sphere_cover import make_sphere_cover

BEHIND = 0.3  # m: length of the bar behind the hinge
BAR = hf.Capsules((hf.collision.LinkCapsule(0, (-BEHIND, 0, 0), (LENGTH, 0, 0), radius=0.02),))


def seesaw() -> hf.Arm:
    """A bar on a hinge about -y, level at q = 0, whose weight is at the front and whose tool is at the rear end."""
    return hf.Arm(
        name="seesaw",
        joints=(hf.Joint("hinge", "revolute", np.eye(4), axis=np.array([0.0, -1, 0]), lower=-np.pi / 2, upper=1.0),),
        links=(hf.Link(MASS, np.array([LENGTH, 0, 0]), np.zeros((3, 3))),),
        tool=oracles.pose(None, [-BEHIND, 0, 0]),
    )


def sphere_depths(arm, capsules, q):
    """Coordinates (N, S + 1) along gravity of the centers of all moving spheres and of the tool, in configurations (N, n)."""
    frames, cover = oracles.frames(arm, q), make_sphere_cover(capsules)
    centers = [(frames[k + 1] @ [*point, 1])[:, :3] for k, point in zip(cover.link, cover.center, strict=True) if k >= 0]
    return np.stack([*centers, frames[-1][:, :3, 3]], axis=1) @ arm.gravity / np.linalg.norm(arm.gravity)


@pytest.mark.parametrize("types", ["RRR", "RPRR"])
@pytest.mark.parametrize("stops", [True, False])
def test_the_drop_is_the_largest_of_all_spheres(rng, types, stops):
    arm = oracles.with_bodies(oracles.random_arm(rng, types=types, limits=3.0), rng)
    ends = rng.uniform(-0.3, 0.3, (2 * arm.n, 2, 3))
    parts = [hf.collision.LinkCapsule(k // 2 - 1, *map(tuple, pair), radius=0.05) for k, pair in enumerate(ends)]
    clearance = hf.Clearance(arm, hf.Capsules(parts), itself=False)
    q, time = oracles.inside(arm, rng, 3), np.linspace(0, 0.4, 201)
    fall = hf.power_loss(arm, q, friction=FREE, stops=stops, clearance=clearance, duration=0.4, of="any point")
    for row, motion in enumerate(fall.q_at(time)):
        depths = sphere_depths(arm, clearance.capsules, motion)
        drops = (depths - depths[0]).max(axis=1)
        np.testing.assert_allclose(fall.drop_at(time)[row], drops, atol=1e-12)
        assert fall.drop[row] == pytest.approx(drops.max(), abs=2e-4)
    tool = hf.power_loss(arm, q, friction=FREE, stops=stops, clearance=clearance, duration=0.4)
    assert (fall.drop >= tool.drop).all()
    assert (fall.drop > tool.drop + 1e-3).any()
    np.testing.assert_array_equal(fall.q_final, tool.q_final)


def test_the_tool_of_a_seesaw_rises_while_the_other_end_falls():
    arm, options = seesaw(), {"friction": FREE, "duration": 2.0, "clearance": hf.Clearance(seesaw(), BAR, itself=False)}
    tool, any_point = (hf.power_loss(arm, [0.0], of=of, **options) for of in ("tool", "any point"))
    assert tool.drop == 0
    assert any_point.drop == pytest.approx(LENGTH, abs=1e-12)
    assert (tool.of, any_point.of) == ("tool", "any point")
    assert any_point.drop_at(0.1) == pytest.approx(G * 0.1**2 / 2, rel=1e-3)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(any_point)).drop_at(0.3), any_point.drop_at(0.3))


def test_other_functions_and_mujoco_compute_the_same_drop(rng):
    arm, q = seesaw(), np.linspace(-1, 0.5, 6)[:, None]
    options = {"friction": hf.Friction(coulomb=0.5), "duration": 1.0, "of": "any point", "clearance": True}
    falls = hf.power_loss(arm, q, **options)
    curve = hf.power_loss_along(arm, q, np.arange(6.0), rates=np.zeros((6, 1)), refine=False, **options)
    chance = hf.power_loss_probability(arm, 0.1, q=q, **options)
    np.testing.assert_array_equal(curve.drop, falls.drop)
    np.testing.assert_array_equal(chance.value, falls.drop)
    assert falls.physical(5, clearance=False).drop == pytest.approx(falls.drop[5], abs=1e-3)
    brakes = hf.compare_brakes(arm, [0.0], torque=[40.0], after=[0.1], **options)
    assert brakes.of == "any point"
    assert brakes.drop_at_brake[0] == pytest.approx(hf.power_loss(arm, [0.0], **options | {"duration": 0.1}).drop)


def test_a_built_in_arm_has_a_default_model_and_bad_rows_stay_alone():
    arm = hf.arms.load("yam")
    q = np.array([[0.0, 1.047, 1.047, 0, 0, 0], [np.nan] * 6])
    fall = hf.power_loss(arm, q, duration=0.2, of="any point")
    assert fall.drop[0] >= hf.power_loss(arm, q[0], duration=0.2).drop
    assert np.isnan(fall.drop[1])
    with pytest.raises(hf.InputError, match="of is 'elbow'; use 'tool' or 'any point'"):
        hf.power_loss(arm, q, of="elbow")
