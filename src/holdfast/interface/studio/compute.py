"""Long computations as functions of an arm and a view, run in the worker process; their results are plain data for JSON."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.interface.studio.cloud import find_region_cloud
from holdfast.interface.studio.machine import CompiledArm
from holdfast.interface.studio.monitor_demo import simulate_monitor_demo
from holdfast.interface.studio.motions import simulate_fall_motion, simulate_law_motions
from holdfast.interface.studio.state import State

Progress = Callable[[int, int], None]
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
    return {"q": [list(q) for q, _ in extremes], "values": [*(value for _, value in extremes), value]}


def simulate_laws(machine: CompiledArm, state: State, progress: Progress) -> list[dict[str, Any]]:
    """Simulate the motion to the target under both laws; see :func:`holdfast.interface.studio.motions.simulate_law_motions`."""
    return [motion.to_plain() for motion in simulate_law_motions(machine, state, progress)]


def simulate_fall(machine: CompiledArm, state: State, progress: Progress) -> list[dict[str, Any]]:
    """Simulate the fall after a power loss; see :func:`holdfast.interface.studio.motions.simulate_fall_motion`."""
    progress(0, 1)
    return [simulate_fall_motion(machine.arm, state).to_plain()]


JOB_FUNCTIONS: Mapping[str, Callable[[CompiledArm, State, Progress], Any]] = MappingProxyType(
    {
        "best-worst": find_best_and_worst,
        "laws": simulate_laws,
        "fall": simulate_fall,
        "region": find_region_cloud,
        "watch": simulate_monitor_demo,
    }
)
