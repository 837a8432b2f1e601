"""Eigenvalues of one control cycle of every simulator with servos, and the torques of a healthy robot."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

import holdfast as hf
from holdfast.control.physics.robot import ServoRobot
from holdfast.core.errors import ArmError
from holdfast.response.diagnosis import simulated_logs
from holdfast.response.faults import FaultEvent
from holdfast.response.supervisor import loop

pytest.importorskip("mujoco")
MARGIN = 0.985  # largest magnitude of an eigenvalue of one control cycle; 0.9825 for the light wrist of the yam
SILENT = {"coulomb": 0.0, "joint": 0.0, "torque": 0.0}  # a cycle without noise and dry friction is smooth


def has_inertia(name):
    arm = hf.arms.load(name)
    try:
        arm.inertia_diagonal(np.zeros(arm.n))
    except ArmError:
        return False
    return True


ARMS = [name for name in hf.arms.names() if has_inertia(name)]


def rehearsed_cycle(arm, q, body):
    """One cycle of ``rehearse``: state (2n,) to state; the stiffness and the damping (n,)."""

    recordings = [simulated_logs._Recording(q[None], np.random.default_rng(0), body, (), ())]

    def cycle(state):
        robots = simulated_logs._make_robots(arm, recordings)
        (data,) = robots.data
        data.qpos[:], data.qvel[:] = np.split(state, 2)
        simulated_logs._simulate_robots(robots, recordings)
        return np.concatenate([data.qpos, data.qvel])

    drives = simulated_logs._make_robots(arm, recordings).drives
    return cycle, drives.stiffness[0], drives.damping[0]


def reacting_robot(arm, q, body, faults=()):
    given = {"faults": faults, "episode": 0, "horizon": 1.0, "seed": 0, "pose": False}
    return loop._MonitoredRobot(arm, q, body, hf.Servos(rate=1000.0), **given)


def reacting_cycle(arm, q, body):
    """One cycle of ``simulate_faults``, likewise."""
    robot = reacting_robot(arm, q, body)

    def cycle(state):
        robot.data.qpos[:], robot.data.qvel[:] = np.split(state, 2)
        robot.reference = q.copy()
        told, _ = robot.measure_joints_and_pose(0)
        robot.advance_cycle(told, np.zeros(arm.n), np.ones(arm.n))
        return np.concatenate([robot.data.qpos, robot.data.qvel])

    return cycle, robot.robots.drives.stiffness[0], robot.robots.drives.damping[0]


def physical_cycle(arm, q, body):
    """One cycle of ``simulate_physics``, likewise; it has the masses of the arm's model."""
    robot = ServoRobot(arm, q, hf.Servos())

    def cycle(state):
        robot.data.qpos[:], robot.data.qvel[:] = state[: arm.n] - q, state[arm.n :]
        robot.simulate_cycle(q, 0.0)
        return np.concatenate([robot.q, robot.rates])

    return cycle, robot.stiffness, robot.damping


CYCLES = {"rehearse": rehearsed_cycle, "simulate_faults": reacting_cycle, "simulate_physics": physical_cycle}


def linearised(cycle, q, step=1e-6):
    """The Jacobian (2n, 2n) of a cycle at rest, by central differences."""
    rest = np.concatenate([q, np.zeros_like(q)])
    return np.stack([(cycle(rest + e) - cycle(rest - e)) / (2 * step) for e in step * np.eye(rest.size)], axis=1)


def configurations(arm, rng, count):
    low, high = np.where(np.isfinite(arm.lower), arm.lower, -3.0), np.where(np.isfinite(arm.upper), arm.upper, 3.0)
    return rng.uniform(low, high, (count, arm.n))


@pytest.mark.parametrize("simulator", CYCLES)
@pytest.mark.parametrize("name", ARMS)
def test_every_cycle_is_stable_by_a_margin(name, simulator, rng):
    """Also for robots whose masses are up to 20 % from the model that the gains are tuned to."""
    arm = hf.arms.load(name)
    for seed, q in enumerate(configurations(arm, rng, 4)):
        cycle, *_ = CYCLES[simulator](arm, q, hf.Body(seed, **SILENT))
        assert np.abs(np.linalg.eigvals(linearised(cycle, q))).max() < MARGIN


@pytest.mark.parametrize("simulator", ["rehearse", "simulate_faults"])
def test_one_cycle_is_the_drive_in_continuous_time(simulator, rng):
    """The slowest mode against the matrix exponential of M q'' + (D + B) q' + K q = 0, M by the arm's own dynamics."""
    arm = hf.arms.load("panda")
    body = hf.Body(mismatch=0.0, **SILENT)
    for q in configurations(arm, rng, 3):
        cycle, stiffness, damping = CYCLES[simulator](arm, q, body)
        still = arm.inverse_dynamics(q, np.zeros(7), np.zeros(7))
        inertia = np.stack([arm.inverse_dynamics(q, np.zeros(7), e) - still for e in np.eye(7)], axis=1)
        inertia += np.diag([joint.armature or body.rotor for joint in arm.joints])
        rates = -np.linalg.solve(inertia, np.hstack([np.diag(stiffness), np.diag(damping + body.viscous)]))
        exact = expm(1e-3 * np.vstack([np.hstack([np.zeros((7, 7)), np.eye(7)]), rates]))
        slowest = np.abs(np.linalg.eigvals(exact)).max()
        assert np.abs(np.linalg.eigvals(linearised(cycle, q))).max() == pytest.approx(slowest, abs=1e-3)


def test_a_recorded_torque_is_what_moved_the_arm():
    """From rest, mean torque = gravity torque + inertia x acceleration; the rate that a drive damps is that of this cycle."""
    arm = hf.arms.load("panda")
    body = hf.Body(mismatch=0.0, viscous=0.0, **SILENT)
    q = np.array([0.3, -0.4, 0.5, -1.8, 0.2, 1.7, 0.4])
    robot = reacting_robot(arm, q, body)
    told, _ = robot.measure_joints_and_pose(0)
    torque = robot.advance_cycle(told, 0.1 * np.array([0.4, -0.2, 0.2, 0.4, -0.6, 0.4, 0.2]), np.ones(7))
    acceleration = robot.data.qvel * 1000.0
    rotors = np.array([joint.armature or body.rotor for joint in arm.joints])
    assert torque == pytest.approx(arm.inverse_dynamics(q, np.zeros(7), acceleration) + rotors * acceleration, abs=1e-6)


@pytest.mark.parametrize("name", ["panda", "iiwa14"])
def test_a_healthy_robot_needs_a_few_newton_metres(name):
    """Gravity, inertia and friction; the noise of the joint sensors adds less than 2 % of each motor's effort."""
    arm = hf.arms.load(name)
    log = hf.diagnosis.simulate_log(arm, 3.0)
    effort = np.array([joint.effort for joint in arm.joints])
    beyond_gravity = log.tau - arm.gravity_torque(log.q)
    assert np.sqrt((beyond_gravity**2).mean(axis=0)).max() < 3.0
    assert (np.abs(beyond_gravity) < np.maximum(0.2 * effort, 4.0)).all()
    assert (np.diff(log.tau, axis=0).std(axis=0) / np.sqrt(2) < 0.02 * effort).all()
    assert np.abs(log.q - log.q_ref).max() < 3e-3


def test_a_weak_motor_is_asked_for_no_more_than_its_effort():
    """Its recorded torque times the share that it gives is what moved the joint, also where the drive is at its limit."""
    arm = hf.arms.load("panda")
    body = hf.Body(mismatch=0.0, viscous=0.0, **SILENT)
    q, rates = np.array([0.3, -0.4, 0.5, -1.8, 0.2, 1.7, 0.4]), np.array([0.0, 2.0, 0, 0, 0, 0, 0])
    robot = reacting_robot(arm, q, body, faults=[FaultEvent("weak", "panda_joint2", 0.0, parameters={"gain": 0.25})])
    told, _ = robot.measure_joints_and_pose(0)
    torque = robot.advance_cycle(told, rates, np.ones(7))
    effort = arm.joints[1].effort
    assert 0.8 * effort < torque[1] <= effort  # the rate that it reaches in the cycle takes something off
    acceleration = robot.data.qvel * 1000.0
    rotors = np.array([joint.armature or body.rotor for joint in arm.joints])
    moved = arm.inverse_dynamics(q, np.zeros(7), acceleration) + rotors * acceleration
    assert moved[1] == pytest.approx(0.25 * torque[1], rel=0.05)
