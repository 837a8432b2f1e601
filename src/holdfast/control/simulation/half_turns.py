"""Detection of runs that are trapped half a turn from their target, where the shortest rotation and the command jump."""

from __future__ import annotations

import casadi as ca
import numpy as np

from holdfast.control.simulation.cycles import CycleStepper
from holdfast.control.simulation.runge_kutta import RungeKuttaStepper
from holdfast.control.simulation.system import FailedArmSystem
from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Tell
from holdfast.kinematics.solvers.inverse_kinematics import pose_error_for_task
from holdfast.model.arm import kinematics

MAX_STEPS = 100_000  # steps of a phase
_HALF_TURN_TOLERANCE_RAD = 1e-3  # rad: this close to half a turn the shortest rotation has no stable direction
_CHECK_INTERVAL_STEPS = 500  # steps between two checks of runs that may be trapped
_MAX_CHECKS = 4  # consecutive checks after which a run counts as trapped


class HalfTurnTraps:
    """Steps of one system that stop runs trapped half a turn from their targets.

    If the motion on either side of half a turn leads towards it, the steps across it shrink to almost zero. A run counts as
    trapped if it is half a turn away at a few consecutive checks and would not finish at its pace between them. In 4,000 runs
    of a Panda, 270 were trapped; 4 of them would have escaped later.
    """

    def __init__(self, system: FailedArmSystem, stepper: RungeKuttaStepper | CycleStepper) -> None:
        self._system, self._stepper, self.made_of = system, stepper, system

    @cached_property
    @cached_kernel
    def _angle_kernel(self) -> Kernel:
        """Kernel that computes the angle of the shortest rotation that the task prescribes, rad."""
        system, law = self._system, self._system.law
        tool_chain = kinematics.kinematic_chain(law.arm, system.q)
        error = pose_error_for_task(law.task, tool_chain.position, tool_chain.rotation, system.target, system.rotation)
        return Kernel("turn", [system.q, system.target, system.rotation], [ca.norm_2(error[3:])])

    def find_half_turns(self, q: FloatArray, position: FloatArray, rotation: FloatArray) -> BoolArray:
        """Return a mask of the q (N, n) at which the end effector is half a turn from its target."""
        return np.asarray(self._angle_kernel.rows(q, position, rotation)[:, 0] > np.pi - _HALF_TURN_TOLERANCE_RAD)

    def advance(self, states: FloatArray, parameters: FloatArray, report_ended: Tell) -> tuple[FloatArray, BoolArray]:
        """Advance states (N, s) to the end of their phase, and return them with flags (N,) for the runs that reached it."""
        stepper, done, active, states = self._stepper, np.zeros(len(states), dtype=bool), np.arange(len(states)), states.copy()
        parts, check_counts = stepper.layout.view_parts(states), np.zeros(len(states), dtype=np.int64)
        check_steps = _CHECK_INTERVAL_STEPS * stepper.calls_per_step
        calls = -(-check_steps // stepper.loop.times)
        for checks_left in reversed(range(MAX_STEPS // check_steps)):
            earlier_times = parts["time"][active, 0]
            result = stepper.loop.run(states[active], parameters[active], 0.0, calls, report=report_ended)
            states[active], done[active] = result.state, result.done
            is_running, active = ~result.done, active[~result.done]
            if not active.size:
                break
            inputs, time = stepper.parameters.split_inputs(parameters[active]), parts["time"][active, 0]
            end_time = np.minimum(inputs["until"][:, 0], inputs["limit"][:, 0])
            is_too_slow = time + checks_left * (time - earlier_times[is_running]) < end_time
            is_half_turn = self.find_half_turns(parts["q"][active], inputs["target"], inputs["rotation"])
            # Consecutive checks that find the run half a turn away at too slow a pace.
            check_counts[active] = np.where(is_half_turn, np.where(is_too_slow, check_counts[active], 0) + 1, 0)
            is_trapped = check_counts[active] > _MAX_CHECKS
            report_ended(int(np.count_nonzero(is_trapped)))
            active = active[~is_trapped]
        return states, done
