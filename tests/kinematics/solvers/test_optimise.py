"""Optimised configurations, against SLSQP from several starts and against exhaustive search; never worse than the start."""

from __future__ import annotations

from dataclasses import fields, replace

import casadi as ca
import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.status import Status
from holdfast.kinematics.indices import CustomIndex, Manipulability, RelativeManipulability, by_name
from holdfast.kinematics.solvers import optimise
from holdfast.kinematics.solvers.optimum import Optimum, get_cached_ascent

TOLERANCE = 1e-6


def region(rng, count):
    """Poses of section 3 of probabilistic-tolerance.md, ``R = Rz(roll) Ry(pitch) Rx(yaw)``."""
    angles = np.radians([0.0, 174.0, 0.0]) + np.radians(rng.uniform(-45, 45, (count, 3)))
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, :3, 3] = np.array([0.968, 0.0, 0.041]) + rng.uniform(-0.25, 0.25, (count, 3))
    poses[:, :3, :3] = Rotation.from_euler("ZYX", angles).as_matrix()
    return poses


def poses_of(arm, rng, count):
    return oracles.forward(arm, oracles.inside(arm, rng, count))


def pose_error(arm, q, poses, task):
    """Position error (m) and angle (rad) of each row, by numpy transforms."""
    reached = oracles.forward(arm, q)
    position = np.linalg.norm(reached[:, :3, 3] - poses[:, :3, 3], axis=1)
    if task in ("planar", "position"):
        return position, np.zeros(len(q))
    if task == "pointing":
        chord = np.linalg.norm(reached[:, :3, 2] - poses[:, :3, 2], axis=1)
    else:
        chord = np.linalg.norm(reached[:, :3, :3] - poses[:, :3, :3], axis=(1, 2)) / np.sqrt(2)
    return position, 2 * np.arcsin(np.clip(chord / 2, 0, 1))


def worst(name, arm, q, task="pose"):
    j = oracles.task_jacobian(arm, q, task)
    return oracles.worst(
        "smaller" if name == "condition-number" else "larger", oracles.index(name, j, [(k,) for k in range(arm.n)])
    )


def tie(arm, q):
    """How much larger the second smallest rho is than the smallest, (N,): 0 at most of the best configurations."""
    values = np.sort(oracles.index("relative-manipulability", oracles.jacobian(arm, q), [(k,) for k in range(arm.n)]))
    return values[:, 1] / values[:, 0] - 1


def assert_sound(arm, best, poses, value, task="pose", sign=1.0):
    """Pose and limits kept, values those of the configurations, never below the start; ``value`` is a numpy function."""
    ok = best.success
    assert ok.any()
    position, angle = pose_error(arm, best.q[ok], poses[ok], task)
    assert position.max() <= TOLERANCE * 1.001
    assert angle.max() <= TOLERANCE * 1.001
    np.testing.assert_allclose(best.position_error[ok], position, atol=1e-12)
    np.testing.assert_allclose(best.rotation_error[ok], angle, atol=1e-9)
    for q in (best.q[ok], best.start_q[ok]):
        assert (q >= arm.lower).all()
        assert (q <= arm.upper).all()
    position, angle = pose_error(arm, best.start_q[ok], poses[ok], task)
    assert max(position.max(), angle.max()) <= TOLERANCE * 1.001
    np.testing.assert_allclose(best.value[ok], value(best.q[ok]), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(best.start_value[ok], value(best.start_q[ok]), rtol=1e-7, atol=1e-10)
    assert (sign * best.value[ok] >= sign * best.start_value[ok]).all()
    assert (best.starts[ok] >= 1).all()
    assert (best.agreeing[ok] > 0).all()
    assert (best.agreeing[ok] <= 1).all()


def assert_same(a, b, rows=slice(None)):
    for field in fields(Optimum):
        np.testing.assert_array_equal(getattr(a, field.name), getattr(b, field.name)[rows], err_msg=field.name)


# ---- the 9-joint arm of the paper --------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def rho(pa10):
    return RelativeManipulability(pa10)


@pytest.fixture(scope="module")
def targets(generator):
    return region(generator("optimised region"), 700)


@pytest.fixture(scope="module")
def optimised(pa10, rho, targets):
    return optimise(pa10, targets[:200], rho, seed=3)


class Reference:
    """(11) for one pose as a nonlinear program in (q, t), Jacobian and slopes of rho^2 by numpy, solved by SLSQP."""

    def __init__(self, arm, pose):
        self.arm, self.pose, self.key = arm, pose, None

    def at(self, x):
        q = x[:-1]
        if self.key != q.tobytes():
            self.key = q.tobytes()
            made = oracles.frames(self.arm, q[None])
            tool = made[-1][0]
            axes = np.array([t[0, :3, :3] @ joint.axis for t, joint in zip(made[1:-1], self.arm.joints, strict=True)])
            levers = tool[:3, 3] - np.array([t[0, :3, 3] for t in made[1:-1]])
            v = np.cross(axes, levers)
            j = np.concatenate([v.T, axes.T])
            # d J[:, a] / d q_b: column a turns with joint b if b is nearer the base, and the tool moves with b if not.
            b, a = np.indices((self.arm.n, self.arm.n))
            before = (b < a)[..., None]
            linear = np.where(before, np.cross(axes[:, None], v[None]), np.cross(axes[None], v[:, None]))
            angular = np.where(before, np.cross(axes[:, None], axes[None]), 0.0)
            change = np.concatenate([linear, angular], axis=2)  # [b, a, :]
            gram = np.linalg.inv(j @ j.T)
            columns = gram @ j
            projector = np.eye(self.arm.n) - j.T @ columns
            self.squares = np.diag(projector)
            self.slopes = -2 * np.einsum("ik,bik->kb", columns, np.swapaxes(change, 1, 2) @ projector)
            wanted, r = self.pose[:3, :3], tool[:3, :3]
            self.error = np.r_[tool[:3, 3] - self.pose[:3, 3], 0.5 * np.cross(wanted.T, r.T).sum(axis=0)]
            turn = 0.5 * (np.trace(wanted.T @ r) * np.eye(3) - r @ wanted.T)
            self.error_slope = np.concatenate([j[:3], turn @ j[3:]])
        return self

    def best(self, starts):
        n, found = self.arm.n, -np.inf
        constraints = [
            {
                "type": "ineq",
                "fun": lambda x: self.at(x).squares - x[-1],
                "jac": lambda x: np.c_[self.at(x).slopes, -np.ones(n)],
            },
            {"type": "eq", "fun": lambda x: self.at(x).error, "jac": lambda x: np.c_[self.at(x).error_slope, np.zeros(6)]},
        ]
        bounds = [*zip(self.arm.lower, self.arm.upper, strict=True), (None, None)]
        for q in starts:
            x = np.r_[q, 0.0]
            result = minimize(
                lambda x: -x[-1],
                x,
                jac=lambda x: np.r_[np.zeros(n), -1.0],
                method="SLSQP",
                bounds=bounds,
                constraints=constraints,
                options={"maxiter": 80, "ftol": 1e-10},
            )
            q = np.clip(result.x[:-1], self.arm.lower, self.arm.upper)
            if max(*pose_error(self.arm, q[None], self.pose[None], "pose"))[0] < 1e-6:
                found = max(found, worst("relative-manipulability", self.arm, q[None])[0])
        return found


def test_the_reference_differentiates_right(pa10, rng):
    q, pose = oracles.inside(pa10, rng, 1)[0], region(rng, 1)[0]
    reference = Reference(pa10, pose)
    for name, derivative in (("squares", "slopes"), ("error", "error_slope")):
        slope = oracles.slope(lambda x, name=name: np.array([getattr(reference.at(np.r_[y, 0]), name) for y in x]), q)
        np.testing.assert_allclose(getattr(reference.at(np.r_[q, 0]), derivative), slope.T, atol=1e-8)


def test_as_good_as_slsqp_from_several_starts(pa10, targets, optimised, rng):
    rows = np.flatnonzero(optimised.success)[:8]
    reference = []
    for k in rows:
        starts = [optimised.start_q[k], *oracles.inside(pa10, rng, 4)]
        reference.append(Reference(pa10, targets[k]).best(starts))
    reference = np.array(reference)
    assert np.isfinite(reference).all()
    worse = reference - optimised.value[rows]
    assert (worse <= 1e-3).mean() >= 0.9
    # And the other way round: the reference is a reference.
    assert np.median(np.abs(worse)) < 1e-3


def test_the_region_of_the_paper(pa10, targets, optimised):
    assert_sound(pa10, optimised, targets[:200], lambda q: worst("relative-manipulability", pa10, q))
    ok = optimised.success
    assert set(optimised.status) == {Status.OK, Status.NOT_FOUND}
    # Section 6: means 0.197 -> 0.360 and 5 % of the values below 0.269; standard errors of 185 values are 0.0065 and 0.004.
    assert abs(optimised.start_value[ok].mean() - 0.197) < 0.03
    assert abs(optimised.value[ok].mean() - 0.360) < 0.02
    assert optimised.value[ok].max() < np.sqrt(3 / 9)
    # What the step promises: several failures are equally bad where the best point is.
    values = np.sort(
        oracles.index("relative-manipulability", oracles.jacobian(pa10, optimised.q[ok]), [(k,) for k in range(9)])
    )
    assert np.median(values[:, 1] / values[:, 0]) < 1.001
    missed = ~ok
    for name in ("q", "value", "start_value", "agreeing"):
        assert np.isnan(getattr(optimised, name)[missed]).all(), name
    assert np.isfinite(optimised.start_q[missed]).all()
    np.testing.assert_array_equal(optimised.starts[missed], 0)


def test_manipulability_improves(pa10, targets, optimised):
    best = optimise(pa10, targets[:30], Manipulability(pa10))
    assert_sound(pa10, best, targets[:30], lambda q: worst("manipulability", pa10, q))
    ok = best.success
    assert (best.value[ok] > best.start_value[ok] + 1e-4).mean() > 0.95
    # Section 6: means 0.166 -> 0.286. And the optimum of the other index is not better in this one.
    assert abs(best.value[ok].mean() - 0.286) < 0.06
    other = worst("manipulability", pa10, optimised.q[:30][ok])
    assert (best.value[ok] >= other - 1e-3).mean() > 0.9
    assert best.value[ok].mean() > other.mean() + 0.01


def test_same_seed_same_result_whatever_the_threads(pa10, rho, targets, threads):
    results = []
    for count in (1, 2, 3):
        threads(count)
        results.append(optimise(pa10, targets, rho, seed=11, starts=3, restarts=4))
    assert_same(results[0], results[1])
    assert_same(results[0], results[2])
    assert_same(results[0], optimise(pa10, targets, rho, seed=11, starts=3, restarts=4))
    other = optimise(pa10, targets, rho, seed=12, starts=3, restarts=4)
    both = other.success & results[0].success  # two misses may end in the same corner of the limits
    # A pose at the edge of the region may have one corner of the limits as its only configuration.
    assert (other.start_q != results[0].start_q).any(axis=1)[both].mean() > 0.98
    # Later blocks do not change earlier ones.
    assert_same(optimise(pa10, targets[:512], rho, seed=11, starts=3, restarts=4), results[0], slice(512))
    fewer = optimise(pa10, targets[:600], rho, seed=11, starts=3, restarts=4)
    assert_same(Optimum(**{f.name: getattr(fewer, f.name)[:512] for f in fields(Optimum)}), results[0], slice(512))


@pytest.mark.parametrize("count", [1, 5, 13])
def test_poses_behind_do_not_matter(count, pa10, rho, targets, optimised):
    assert_same(optimise(pa10, targets[:count], rho, seed=3), optimised, slice(count))


def test_more_starts_are_better(pa10, rho, targets, optimised):
    few = optimise(pa10, targets[:200], rho, seed=3, starts=1)
    ok = few.success
    np.testing.assert_array_equal(few.start_q, optimised.start_q)
    np.testing.assert_array_equal(few.starts[ok], 1)
    np.testing.assert_array_equal(few.agreeing[ok], 1)
    assert_sound(pa10, few, targets[:200], lambda q: worst("relative-manipulability", pa10, q))
    assert np.median(tie(pa10, few.q[ok])) < 1e-4
    # Section 6: means of 0.338 from one start and 0.360 from twenty.
    assert optimised.value[ok].mean() - few.value[ok].mean() > 0.005
    assert few.value[ok].mean() - few.start_value[ok].mean() > 0.1


def test_bad_rows(pa10, rho, targets, optimised):
    poses = targets[:4].copy()
    poses[1, :3, 3] = [9.0, 0, 0]
    poses[2, 0, 3] = np.nan
    poses[3, 1, 1] = np.inf
    best = optimise(pa10, poses, rho, seed=3, restarts=5)
    np.testing.assert_array_equal(best.status[1:], [Status.NOT_FOUND, Status.BAD_INPUT, Status.BAD_INPUT])
    for name in ("q", "value", "start_value", "agreeing", "position_error", "rotation_error"):
        assert np.isnan(getattr(best, name)[1:]).all(), name
    assert np.isfinite(best.start_q[1]).all()  # the nearest miss
    assert np.isnan(best.start_q[2:]).all()
    np.testing.assert_array_equal(best.starts[1:], 0)
    np.testing.assert_array_equal(best.success[1:], False)
    with pytest.raises(HoldfastError, match=r"optimisation: \d of 4 rows failed; first: row"):
        best.require_ok()
    reachable = pa10.forward_kinematics(oracles.NOMINAL)
    mixed = optimise(pa10, np.stack([reachable, poses[1], poses[2]]), rho, seed=3)
    np.testing.assert_array_equal(mixed.status, [Status.OK, Status.NOT_FOUND, Status.BAD_INPUT])
    assert mixed.value[0] > 0.3
    none = optimise(pa10, poses[1:], rho, restarts=2)
    assert not none.success.any()


def test_shapes(pa10, rho):
    pose = oracles.forward(pa10, oracles.NOMINAL[None])
    one, batch = optimise(pa10, pose[0], rho), optimise(pa10, pose, rho)
    assert_same(one, batch, 0)
    assert one.q.shape == one.start_q.shape == (9,)
    assert batch.q.shape == batch.start_q.shape == (1, 9)
    for field in fields(Optimum):
        if field.name not in ("q", "start_q"):
            assert np.shape(getattr(one, field.name)) == (), field.name
            assert np.shape(getattr(batch, field.name)) == (1,), field.name
    assert one.success
    assert one.require_ok() is one
    # The nominal configuration has 0.127; section 6.
    assert one.value > 0.3
    empty = optimise(pa10, np.zeros((0, 4, 4)), rho)
    assert empty.q.shape == empty.start_q.shape == (0, 9)
    assert empty.value.shape == empty.status.shape == empty.starts.shape == (0,)
    assert (empty.status.dtype, empty.starts.dtype) == (batch.status.dtype, batch.starts.dtype)
    assert empty.require_ok() is empty
    np.testing.assert_array_equal(hf.optimise(pa10, pose[0], rho).q, one.q)


def test_errors(pa10, pa10_7, rho, targets):
    for name in ("starts", "restarts"):
        with pytest.raises(InputError, match=f"{name} is 0; it must be 1 or more"):
            optimise(pa10, targets[0], rho, **{name: 0})
    for tolerance in (0.0, -1.0, np.nan):
        with pytest.raises(InputError, match=r"tolerance is .*; it must be above 0"):
            optimise(pa10, targets[0], rho, tolerance=tolerance)
    with pytest.raises(InputError, match=f"belongs to '{pa10.name}', not to '{pa10_7.name}'; make it with the same arm"):
        optimise(pa10_7, targets[0], rho)
    with pytest.raises(InputError, match=r"must be \(4, 4\) or \(N, 4, 4\)"):
        optimise(pa10, np.eye(3), rho)
    with pytest.raises(InputError, match="pose 0 has no rotation"):
        optimise(pa10, 2 * np.eye(4), rho)


# ---- a planar arm: its best configuration by exhaustive search ---------------------------------------------------------


def planar3(limit=None):
    low = None if limit is None else -limit
    return hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0, lower=low, upper=limit) for _ in range(3)], name="planar")


def planar_poses(rng, count, low=0.3, high=2.8):
    distance, angle = rng.uniform(low, high, count), rng.uniform(-1.5, 1.5, count)
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, 0, 3], poses[:, 1, 3] = distance * np.cos(angle), distance * np.sin(angle)
    return poses


def test_continuous_joints_reach_the_bound(rng):
    arm = planar3()
    assert np.isinf(arm.lower).all()
    index = RelativeManipulability(arm, "planar")
    assert index.bound == pytest.approx(np.sqrt(1 / 3))
    # Between 1 and 3 m from the base, links 1 and 3 can be parallel: all three columns then count the same.
    poses = planar_poses(rng, 60, 1.05, 2.9)
    best = optimise(arm, poses, index).require_ok()
    assert_sound(arm, best, poses, lambda q: worst("relative-manipulability", arm, q, "planar"), "planar")
    np.testing.assert_allclose(best.value, np.sqrt(1 / 3), rtol=1e-6)
    assert (best.value <= index.bound * (1 + 1e-12)).all()
    np.testing.assert_allclose(np.cos(best.q[:, 1] + best.q[:, 2]), 1, atol=1e-4)

    # As inverse kinematics does: joints without limits come back to -pi..pi.
    assert np.abs(best.q).max() <= np.pi


@pytest.mark.parametrize("limit", [np.pi, 1.6, 1.2])
def test_exhaustive_search_on_the_self_motion(limit, rng):
    arm = planar3(limit)
    poses = planar_poses(rng, 60)
    best = optimise(arm, poses, RelativeManipulability(arm, "planar"))
    every = [oracles.three_link_fibre(arm, p[:3, 3]) for p in poses]
    # Found wherever there is a sizeable piece of self-motion, and nowhere without any.
    reachable = np.array([len(q) > 0 for q in every])
    assert not best.success[~reachable].any()
    assert best.success[np.array([len(q) > 20 for q in every])].all()
    assert reachable.sum() > 20
    both = np.flatnonzero(best.success & reachable)
    exact = np.array([worst("relative-manipulability", arm, every[k], "planar").max() for k in both])
    assert_sound(arm, best, poses, lambda q: worst("relative-manipulability", arm, q, "planar"), "planar")
    assert (exact - best.value[both] <= 1e-3).mean() >= 0.95
    assert (best.value[both] - exact).max() < 1e-2  # the search is a grid


@pytest.mark.parametrize("better", ["larger", "smaller"])
def test_an_index_of_your_own(better, rng):
    arm = planar3(1.8)

    def area(j):
        return (j[0, 0] * j[1, 1] - j[0, 1] * j[1, 0]) ** 2

    def spread(j):
        return (j[0, 0] ** 2 + j[0, 1] ** 2 + j[1, 0] ** 2 + j[1, 1] ** 2) / ca.fmax(ca.sqrt(area(j)), 1e-9)

    def in_numpy(q):
        j = oracles.task_jacobian(arm, q, "planar")
        kept = [np.delete(j, k, axis=2) for k in range(3)]
        area = np.stack([np.linalg.det(x) ** 2 for x in kept], axis=1)
        if better == "larger":
            return area.min(axis=1)
        return (np.stack([(x**2).sum(axis=(1, 2)) for x in kept], axis=1) / np.maximum(np.sqrt(area), 1e-9)).max(axis=1)

    sign = 1.0 if better == "larger" else -1.0
    index = CustomIndex(area if better == "larger" else spread, arm, "planar", better=better, name="own")
    poses = planar_poses(rng, 40, 0.8, 2.6)
    best = optimise(arm, poses, index)
    assert_sound(arm, best, poses, in_numpy, "planar", sign)
    gained = sign * (best.value - best.start_value)[best.success]
    assert (gained > 0).mean() > 0.9
    exact = np.array([(sign * in_numpy(oracles.three_link_fibre(arm, p[:3, 3]))).max() for p in poses[best.success]])
    short = exact - sign * best.value[best.success]
    assert (short <= 1e-3 * np.abs(exact)).mean() >= 0.9
    assert (short >= -1e-2 * np.abs(exact)).all()


# ---- other arms --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "task"), [("panda", "pose"), ("panda", "pointing"), ("ur5-rail", "pose")])
def test_other_arms(name, task, rng):
    arm = arms.load(name)
    q = oracles.inside(arm, rng, 30)
    poses = oracles.forward(arm, q)
    best = optimise(arm, poses, RelativeManipulability(arm, task)).require_ok()
    assert_sound(arm, best, poses, lambda q: worst("relative-manipulability", arm, q, task), task)
    assert (best.value > best.start_value).mean() > 0.8
    assert best.value.mean() > 1.5 * best.start_value.mean()
    # A pose made from a configuration is worth at least as much as that configuration.
    known = worst("relative-manipulability", arm, q, task)
    assert (best.value >= known - 1e-3).mean() >= 0.9


def test_pairs_of_failures(mixed5, rng):
    index = RelativeManipulability(mixed5, "position", "pairs")
    poses = poses_of(mixed5, rng, 20)
    best = optimise(mixed5, poses, index).require_ok()

    def value(q):
        return oracles.index("relative-manipulability", oracles.jacobian(mixed5, q)[:, :3], index.failures).min(axis=1)

    assert_sound(mixed5, best, poses, value, "position")
    assert best.value.mean() > 1.5 * best.start_value.mean()


def test_an_arm_that_no_configuration_makes_tolerant(pa10_7, rng):
    """The elbow of the original PA10 takes no part in the self-motion: rho is 0 whatever the joints do."""
    poses = poses_of(pa10_7, rng, 5)
    best = optimise(pa10_7, poses, RelativeManipulability(pa10_7)).require_ok()
    np.testing.assert_allclose(best.value, 0, atol=1e-12)
    np.testing.assert_allclose(best.start_value, 0, atol=1e-12)
    assert (best.value >= best.start_value).all()
    position, angle = pose_error(pa10_7, best.q, poses, "pose")
    assert max(position.max(), angle.max()) <= TOLERANCE * 1.001
    assert ((best.q >= pa10_7.lower) & (best.q <= pa10_7.upper)).all()


# ---- values that are infinite, or none ---------------------------------------------------------------------------


def _climbed(index, poses, first, starts=8):
    """The ascent from given first configurations, the other starts drawn alike."""
    ascent = get_cached_ascent(index)
    reach = ascent.engine.solve(poses, np.random.SeedSequence(1), 100, TOLERANCE)
    given = replace(reach, q=np.where(np.isnan(first), reach.q, first))
    return ascent.solve(poses, given, np.random.SeedSequence(2), starts, TOLERANCE)


@pytest.mark.interpreted
def test_the_share_of_agreeing_starts_after_a_start_of_infinite_value(flat4):
    """A folded configuration is singular: its infinite condition number was the scale of values, so that all starts agreed."""
    index = by_name("condition-number", flat4, "planar")
    folded = np.array([[0.3, np.pi, np.pi, np.pi], [-1.0, np.pi, 0.0, np.pi]])
    poses = flat4.forward_kinematics(folded)
    assert np.isinf(index(folded)).all()
    found = _climbed(index, poses, folded)
    assert np.isinf(found.start_value).all()
    ascent = get_cached_ascent(index)
    reach = replace(ascent.engine.solve(poses, np.random.SeedSequence(1), 100, TOLERANCE), q=folded)
    owner, q = ascent._sample_starts(poses, reach, np.random.SeedSequence(2), 8, TOLERANCE)
    owner, q, _ = ascent._refine_starts(owner, q, poses, TOLERANCE, collision_free=False)
    close = index(q) <= found.value[owner] * (1 + 1e-3)
    np.testing.assert_array_equal(found.agreeing, [close[owner == k].mean() for k in range(2)])
    assert (found.agreeing < 1).any()


@pytest.mark.interpreted
def test_a_formula_without_a_value_has_a_status_of_its_own(flat4, rng):
    """Its logarithm has none where the first entry of the Jacobian is below 0, and is infinite nowhere."""
    index = CustomIndex(lambda j: ca.log(j[0, 0]), flat4, "planar", failures=[[3]], name="log")
    q = rng.uniform(-2, 2, (40, 4))
    x = -(np.sin(np.cumsum(q, axis=1)) * [1, 0.8, 0.6, 0.4]).sum(axis=1)  # of the first column of the Jacobian, by hand
    q[0, 2] = np.nan
    found = index.evaluate(q)
    want = np.where(x > 0, Status.OK, Status.UNDEFINED)
    want[0] = Status.BAD_INPUT
    np.testing.assert_array_equal(found.status, want)
    np.testing.assert_allclose(found.value[want == Status.OK], np.log(x[want == Status.OK]))
    assert "formula" in Status(int(index.evaluate(q[np.flatnonzero(want == Status.UNDEFINED)[0]]).status)).sentence


@pytest.mark.interpreted
def test_a_first_configuration_without_a_value_is_left_for_one_that_has_one(flat4):
    """A pose is reached with the last two links above the third joint, where the formula has no value, and below it."""
    index = CustomIndex(lambda j: ca.log(j[0, 1]) - ca.sumsqr(j), flat4, "planar", failures=[[0]], name="one side")
    q = np.array([[0.2, -0.9, -0.8, -0.7], [-0.4, 0.9, 0.8, 0.7]])
    first = index(q)
    assert np.isnan(first).any()
    found = _climbed(index, flat4.forward_kinematics(q), q, 32)
    np.testing.assert_array_equal(np.isnan(found.start_value), np.isnan(first))
    assert (found.status == Status.OK).all()
    assert np.isfinite(found.value).all()
    hopeless = CustomIndex(lambda j: ca.log(-1 - ca.sumsqr(j)), flat4, "planar", failures=[[0]], name="nowhere")
    found = _climbed(hopeless, flat4.forward_kinematics(q), q)
    assert (found.status == Status.UNDEFINED).all()
    assert not found.success.any()
    assert np.isnan(found.value).all()


@pytest.mark.interpreted
def test_an_infinite_best_value(flat4):
    """Infinity less infinity is no number: it came with a warning, which fails a test here."""
    index = CustomIndex(lambda j: ca.if_else(j[0, 0] > 0, ca.inf, j[0, 0]), flat4, "planar", failures=[[3]], name="without end")
    q = np.array([[0.2, -0.9, -0.8, -0.7], [0.4, 0.9, 0.8, 0.7]])
    found = _climbed(index, flat4.forward_kinematics(q), q)
    assert np.isposinf(found.value).any()
    assert ((found.agreeing >= 0) & (found.agreeing <= 1)).all()
