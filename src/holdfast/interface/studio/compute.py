"""Long computations as functions of an arm and plain data, run in the worker process."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.interface.studio.cloud import RegionCloud, assess_around_tool, read_cloud
from holdfast.interface.studio.machine import CompiledArm
from holdfast.interface.studio.monitor_demo import simulate_monitor_demo
from holdfast.interface.studio.motions import PlayedMotion, simulate_fall_motion, simulate_law_motions
from holdfast.interface.studio.state import State

Progress = Callable[[int, int], None]
OPTIMUM_RESTARTS = 64  # restarts of the search for a best configuration


@dataclass(frozen=True)
class ExtremeConfigurations:
    """Best and worst configuration of a pose.

    Attributes:
        q: Best and worst configuration (n,), rad and m.
        values: Objective at the best, the worst, and the present configuration.
    """

    q: tuple[FloatArray, FloatArray]
    values: tuple[float, float, float]


def find_best_and_worst(machine: CompiledArm, state: State, progress: Progress) -> ExtremeConfigurations:
    """Find the best and the worst configuration of the present pose by the objective of the state.

    Raises:
        InputError: The arm has no such objective, or no configuration of the pose was found.
    """
    from holdfast.kinematics.solvers.optima import optimise

    objectives = machine.get_objectives(state.objective)
    if isinstance(objectives, str):
        raise InputError(objectives)
    q, collision_model = np.array(state.q), machine.get_clearance(state.moved)
    optima = []
    for number, objective in enumerate(objectives):
        progress(number, 2)
        optima.append(
            optimise(
                machine.arm,
                machine.tool_pose(q),
                objective,
                task=machine.task,
                starts=OPTIMUM_RESTARTS,
                clearance=collision_model,
            )
        )
    if not all(bool(optimum.success) for optimum in optima):
        raise InputError("no configuration of this pose was found; move the end effector and try again")
    # The searches are local, so the present configuration may be better than their result.
    current_value, sign = float(objectives[0](q)), 1.0 if objectives[0].better == "larger" else -1.0
    best, worst = ((optimum.q, float(optimum.value)) for optimum in optima)
    best = (q, current_value) if sign * current_value > sign * best[1] else best
    worst = (q, current_value) if sign * current_value < sign * worst[1] else worst
    return ExtremeConfigurations((best[0], worst[0]), (best[1], worst[1], current_value))


def simulate_both_laws(machine: CompiledArm, state: State, progress: Progress) -> list[PlayedMotion]:
    """Simulate the motion to the target under both laws; see :func:`holdfast.interface.studio.motions.simulate_law_motions`."""
    return simulate_law_motions(machine, state, progress)


def simulate_fall(machine: CompiledArm, state: State, progress: Progress) -> list[PlayedMotion]:
    """Simulate the fall after a power loss; see :func:`holdfast.interface.studio.motions.simulate_fall_motion`."""
    progress(0, 1)
    return [simulate_fall_motion(machine.arm, state)]


def load_or_assess_region(machine: CompiledArm, state: State, progress: Progress) -> RegionCloud:
    """Load the region of the state's results folder, or assess one around the end effector.

    Raises:
        InputError: The arm has no such index.
    """
    if state.region is not None:
        return read_cloud(machine.arm, state.region)
    index = machine.get_index(state.index)
    if isinstance(index, str):
        raise InputError(index)
    return assess_around_tool(index, machine.tool_pose(np.array(state.q)), machine.size, progress)


JOB_FUNCTIONS: dict[str, Callable[[CompiledArm, State, Progress], object]] = {
    "best-worst": find_best_and_worst,
    "laws": simulate_both_laws,
    "fall": simulate_fall,
    "region": load_or_assess_region,
    "watch": simulate_monitor_demo,
}
