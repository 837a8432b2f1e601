"""Steps of a fall without dry friction and stops, by the classic Runge-Kutta method of order 4."""

from __future__ import annotations

import casadi as ca

from holdfast.control.falls.passive_arm import TIME_ROUNDING_S, PassiveArm
from holdfast.control.simulation.system import (
    STATE_PHASE_END,
    STATE_RUNNING,
    ColumnLayout,
    choose_parts,
    elementwise_max,
    make_state_loop,
)
from holdfast.core.caching import cached_property
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.model.arm.model import Arm


class SmoothStepper(PassiveArm):
    """Steps of the falls of an arm on which only gravity, inertia, and viscous friction act.

    A state contains the configuration ``q`` and the ``rates`` (n,), the ``time``, s, the ``deepest`` coordinate of the tool
    along gravity so far, m, the ``residual``, which is 0, and the ``code``.
    """

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.layout = ColumnLayout(q=arm.n, rates=arm.n, time=1, deepest=1, residual=1, code=1)

    @cached_property
    @cached_kernel
    def loop(self) -> Loop:
        """Loop that repeats the steps."""
        return make_state_loop("smooth falls", self._build_step, self.layout, self.parameters.symbols, self.steps_per_call)

    def _build_step(self, parts: dict[str, SX]) -> dict[str, SX]:
        time = parts["time"]
        h, damping = self.next_step(time), self.damping(time)
        q, rates = [parts["q"]], [parts["rates"]]
        accelerations = [self.accelerations(q[0], rates[0], damping)]
        for part in (h / 2, h / 2, h):
            q.append(q[0] + part * rates[-1])
            rates.append(rates[0] + part * accelerations[-1])
            accelerations.append(self.accelerations(q[-1], rates[-1], damping))
        end = q[0] + h / 6 * (rates[0] + 2 * rates[1] + 2 * rates[2] + rates[3])
        end_rates = rates[0] + h / 6 * (accelerations[0] + 2 * accelerations[1] + 2 * accelerations[2] + accelerations[3])
        is_last = time + h >= self.symbols["until"] - TIME_ROUNDING_S
        moved = {
            **parts,
            "q": end,
            "rates": end_rates,
            "time": ca.if_else(is_last, self.symbols["until"], time + h),
            "deepest": elementwise_max(parts["deepest"], self.depth(end)),
            "code": ca.if_else(is_last, STATE_PHASE_END, STATE_RUNNING),
        }
        return choose_parts(parts["code"] == STATE_RUNNING, moved, parts)
