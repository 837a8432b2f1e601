"""Long computations as functions of an arm and a view, run in the worker process; their results are plain data for JSON."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.extras import guard_imports
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.interface.studio.machine import CompiledArm, to_plain
from holdfast.interface.studio.monitor_demo import MOTION_SAMPLES, simulate_monitor_demo
from holdfast.interface.studio.motions import PlayedMotion
from holdfast.interface.studio.state import State
from holdfast.kinematics.regions.region import Region, rpy_from_rotation
from holdfast.model.arm.friction import Friction
from holdfast.model.arm.poses import pose_from_quaternion
from holdfast.studies.assessment.assessment import Assessment
from holdfast.studies.assessment.run import assess, load

Progress = Callable[[int, int], None]
FALL_S = 3.0  # simulated duration of a fall, s
STOW_SAMPLES = 20_000  # configurations that are searched for one that holds
STOW_NODES = 500  # of the roadmap of the path to it
STOW_FALL_S = 1.0  # simulated duration of the falls along the path, s
SHOWN_TIME_CONSTANTS = 15.0  # duration of a shown motion, in time constants 1/Ke of the law
MAX_POINTS = 2500  # largest number of drawn points
REGION_POSES = 1200  # number of poses in a region around the end effector
_MAX_TURN_RAD = np.radians(30)  # of the orientations in such a region
_GREY_LEVEL = 150  # colour of a pose without a configuration, 0 to 255
OPTIMUM_RESTARTS = 64  # restarts of the search for a best configuration


def find_best_and_worst(machine: CompiledArm, state: State, progress: Progress) -> dict[str, Any]:
    """Find the best and the worst configuration of the present pose by the objective of the state.

    Returns:
        Configurations ``q`` (2, n), best and worst, rad and m, and the ``values`` (3,) of the objective at the best, the worst,
        and the present configuration.

    Raises:
        HoldfastError: The arm has no such objective, or no configuration of the pose was found.
    """
    from holdfast.kinematics.solvers.optima import optimise

    is_index = INDEX_REGISTRY.covers(state.objective)
    measure = machine.get_index(state.objective) if is_index else machine.get_susceptibility(state.objective)
    q, pose, clearance = np.array(state.q), machine.tool_pose(np.array(state.q)), machine.get_clearance(state.moved)
    value, sign = float(measure(q)), 1.0 if measure.better == "larger" else -1.0
    extremes = []
    for number, objective in enumerate((measure, measure.reversed())):
        progress(number, 2)
        optimum = optimise(machine.arm, pose, objective, task=machine.task, starts=OPTIMUM_RESTARTS, clearance=clearance)
        if not bool(optimum.success):
            raise InputError("no configuration of this pose was found; move the end effector and try again")
        # The searches are local, so the present configuration may be better than their result.
        present_is_more = (1 - 2 * number) * sign * (value - float(optimum.value)) > 0
        extremes.append((state.q, value) if present_is_more else (optimum.q.tolist(), float(optimum.value)))
    return {"q": [list(q) for q, _ in extremes], "values": to_plain([*(value for _, value in extremes), value])}


def simulate_laws(machine: CompiledArm, state: State, progress: Progress) -> list[dict[str, Any]]:
    """Simulate the motion to the target under each of the two laws, with failed joints locked from the start.

    The label of each motion describes its end.

    Raises:
        InputError: A law is unknown, or there is no target.
    """
    from holdfast.control.simulation.closed_loop import simulate
    from holdfast.control.simulation.errors import error_history
    from holdfast.interface.presentation.simulation.errors import format_errors

    if state.target is None:
        raise InputError("there is no target; choose one first")
    motions = []
    for law_number, law_label in enumerate(state.laws):
        progress(2 * law_number, 4)
        law = machine.get_law(law_label)
        target = pose_from_quaternion(state.target[:3], state.target[3:])
        runs = simulate(law, np.array(state.q), target, locked=list(state.failed_joints))
        progress(2 * law_number + 1, 4)
        # The final approach takes most of the time and shows hardly any motion.
        path = runs.path(samples=MOTION_SAMPLES, until=min(float(runs.time), SHOWN_TIME_CONSTANTS / law.gain) or None)
        end = error_history(runs).end
        exceeded_joints = [name for name, is_exceeded in zip(state.names, runs.limits_passed, strict=True) if is_exceeded]
        limits_note = f", beyond the limits of {' and '.join(exceeded_joints)}" if exceeded_joints else ""
        errors = format_errors(law, end.position, end.angle)
        label = f"{law_label}: {runs.ending_sentence()}{limits_note} (error {errors})"
        motions.append(PlayedMotion(label, path.time, "s", path.q).to_plain())
    return motions


def simulate_fall(machine: CompiledArm, state: State, progress: Progress) -> list[dict[str, Any]]:
    """Simulate the fall after a power loss of the free joints, or of all joints that are not locked.

    Raises:
        InputError: All joints are locked, or the configuration is outside the limits.
        ArmError: The arm's bodies are not known.
    """
    from holdfast.control.falls.power_cut import power_loss

    progress(0, 1)
    if not state.powerless:
        raise InputError("all joints are locked, so the arm cannot fall; make one healthy or free")
    friction = Friction(coulomb=state.friction)
    fall = power_loss(machine.arm, np.array(state.q), free=state.powerless, friction=friction, duration=FALL_S)
    time = np.linspace(0.0, FALL_S, 4 * MOTION_SAMPLES + 1)
    return [PlayedMotion(f"power loss: {' '.join(fall.describe())}", time, "s", fall.q_at(time)).to_plain()]


def plan_stow_motion(machine: CompiledArm, state: State, progress: Progress) -> list[dict[str, Any]]:
    """Plan a path to a configuration in which the arm stays without power, or take the straight line if none is found.

    Raises:
        InputError: The arm states no speed limits, it is there already, or neither path is free of collisions.
        ArmError: The arm's bodies are not known.
    """
    from holdfast.interface.presentation.falls.stow import present
    from holdfast.response.stowing.path import plan_stow_path
    from holdfast.response.stowing.pose import stow

    progress(0, 2)
    friction, clearance = Friction(coulomb=state.friction), machine.get_clearance(state.moved)
    target = stow(machine.arm, np.array(state.q), friction=friction, clearance=clearance, samples=STOW_SAMPLES)
    progress(1, 2)
    path = plan_stow_path(target, nodes=STOW_NODES, duration=STOW_FALL_S)
    curve, sentence = path.curve or path.straight, present(path).answer
    if curve is None:
        raise InputError(f"{sentence} The straight line is in collision.")
    label = sentence if path.is_found else f"{sentence} The straight line is shown."
    return [PlayedMotion(label, curve.time, "s", curve.falls.q).to_plain()]


def find_region_cloud(machine: CompiledArm, state: State, progress: Progress) -> dict[str, Any]:
    """Return the ``Cloud`` of the state's results folder, or of poses around the end effector.

    These poses are displaced along each axis by at most a quarter of the arm's length, and rotated by at most 30 degrees.

    Raises:
        StoreError: The folder is not a results folder.
        HoldfastError: The results are of another arm, or the arm has no such index.
    """
    if state.region is not None:
        assessment = load(state.region)
        if assessment.arm.fingerprint != machine.arm.fingerprint:
            raise InputError(
                f"'{state.region}' is an assessment of '{assessment.arm.name}', not of '{machine.arm.name}'; open that arm"
            )
        return make_cloud(assessment, state.region)
    index, tool_pose = machine.get_index(state.index), machine.tool_pose(np.array(state.q))
    extent, turns = np.full(3, 0.5 * machine.size), np.full(3, 2 * _MAX_TURN_RAD)
    region = Region.box(tool_pose[:3, 3], extent, rpy_from_rotation(tool_pose[:3, :3]), turns, order="abdi")
    assessment = assess(machine.arm, region, index, poses=REGION_POSES, restarts=20, progress=progress, keep=True)
    label = f"{REGION_POSES} poses within {100 * 0.25 * machine.size:.0f} cm and 30 deg of the end effector"
    return make_cloud(assessment, label)


def make_cloud(assessment: Assessment, label: str) -> dict[str, Any]:
    """Make a ``Cloud`` of the stored poses of an assessment, at most 2500 of them; dark is bad, bright is good."""
    with guard_imports("the colours of a region"):
        from holdfast.interface.report.scenes import Scale

    columns = assessment.columns
    q, values = np.asarray(columns["q"][:], dtype=np.float64), np.asarray(columns["index"][:], dtype=np.float64)
    selected = np.unique(np.linspace(0, len(q) - 1, min(MAX_POINTS, len(q))).astype(int))
    q, values = q[selected], values[selected]
    has_configuration: NDArray[np.bool_] = np.asarray(np.isfinite(q).all(axis=1))
    if "position" in columns:
        points = np.asarray(columns["position"][:], dtype=np.float64)[selected]
    else:  # only the points of configurations are known
        q, values, has_configuration = q[has_configuration], values[has_configuration], has_configuration[has_configuration]
        points = assessment.arm.forward_kinematics(q)[:, :3, 3] if len(q) else np.zeros((0, 3))
    scale = Scale.from_values(values[has_configuration], smaller_is_better=assessment.index.better == "smaller")
    colors = np.full((len(q), 3), _GREY_LEVEL, dtype=np.uint8)
    if has_configuration.any():
        colors[has_configuration] = (255 * scale.colors(values[has_configuration])[:, :3]).astype(np.uint8)
    return {
        "label": f"{label}: {assessment.index.name} from {scale.low:.3g} (dark) to {scale.high:.3g} (bright)",
        "points": points.tolist(),
        "colors": colors.tolist(),
        "q": [row.tolist() if found else None for row, found in zip(q, has_configuration, strict=True)],
        "values": to_plain(values),
    }


JOB_FUNCTIONS: Mapping[str, Callable[[CompiledArm, State, Progress], Any]] = MappingProxyType(
    {
        "best-worst": find_best_and_worst,
        "laws": simulate_laws,
        "fall": simulate_fall,
        "stow": plan_stow_motion,
        "region": find_region_cloud,
        "watch": simulate_monitor_demo,
    }
)
