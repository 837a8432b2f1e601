"""Arm of a protocol as JavaScript, so that the page moves it by the same computation that Python replays.

Measured with Node 24 on one core of a shared machine: the paper's protocol (three links, two laws) makes 27 kB in less than a
second; a control cycle of ten sub-steps takes 1 us under the pseudoinverse and 10 us under the failure-tolerant inverse. The
seven-joint Panda, position task, makes 74 kB; 2 us and 27 us. Loading runs every law 300 times, 0.1 s (Panda 0.2 s), because
code that has not run yet takes 5 ms (Panda 20 ms) in the first cycle and 0.5 ms (1 ms) in the next ones.
"""

from __future__ import annotations

import json

import casadi as ca
import numpy as np

from holdfast.control.laws.c_functions import fill_template
from holdfast.control.laws.law import Law
from holdfast.kernels.disk_cache import cached_json
from holdfast.kernels.javascript.functions import define_functions
from holdfast.kernels.javascript_backend import write_javascript
from holdfast.kernels.program import SX, Program
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.trials.plant import check_joystick_task, make_euler_substep

_WARMUP_CYCLES = 300  # cycles of each law at loading, because engines compile code that has run for a while


def number_scenario_laws(protocol: Protocol) -> list[int]:
    """Return for each scenario the index of its law in the module, where every law with its options occurs once, shuffled.

    The protocol's seed shuffles the indices, so that messages between page and server do not reveal the law to a reader.
    """
    law_numbers: dict[str, int] = {}
    scenario_laws = [
        law_numbers.setdefault(json.dumps([scenario.law, dict(scenario.options)], sort_keys=True), len(law_numbers))
        for scenario in protocol.scenarios
    ]
    codes = np.random.default_rng([protocol.seed, 2]).permutation(len(law_numbers)).tolist()
    return [codes[number] for number in scenario_laws]


def generate_arm_javascript(protocol: Protocol) -> str:
    """Return the arm under the protocol's laws as an ES module, which has no dependencies and allocates no memory.

    .. code-block:: javascript

        export const joints, axes, laws, markers;
        export function cycle(law, q, velocity, healthy, out);
        export function position(q, out);
        export function points(q, out);

    All arguments are ``Float64Array``, apart from ``law``, its index in :func:`number_scenario_laws`. ``cycle`` writes the
    result of :meth:`holdfast.teleop.JoystickPlant.step_one`: the configuration after a whole control cycle, then the tool
    point's velocity at its beginning, m/cycle. ``position`` writes the task's rows of the tool point, m, and ``points`` the
    wire frame, three world coordinates each, m: the base (left out where the first joint is at the base), every joint, the tool
    point. Joint k, from 0, is therefore marker ``markers - 1 - joints + k``. NaN or infinity in an argument makes everything
    NaN.

    Args:
        protocol: Protocol of the experiment.

    Raises:
        TaskError: The task has rows that a joystick cannot command.
    """
    numbers = number_scenario_laws(protocol)
    check_joystick_task(protocol.rows)
    scenarios = [protocol.scenarios[numbers.index(number)] for number in range(max(numbers) + 1)]
    return _generate_javascript_module(
        [scenario.make_law(protocol.arm, protocol.rows) for scenario in scenarios], protocol.substeps
    )


@cached_json
def _generate_javascript_module(laws: list[Law], substeps: int) -> str:
    arm, task = laws[0].arm, laws[0].task
    q = kinematics.joint_symbols(arm)
    frame = _wire_frame_points(arm, q)
    position = ca.DM(task.rows[:, :3]) @ frame[:, -1]
    programs = {}
    for number, law in enumerate(laws):
        step = make_euler_substep(law, substeps)
        symbols = step.sx_in()
        programs[f"law{number}"] = Program(f"sub-step, {law.slug}", symbols, step(*symbols))
    programs |= {"place": Program("position", [q], [position]), "wire": Program("points", [q], [frame.T])}
    body = "".join(write_javascript(program, name, with_functions=False) for name, program in programs.items())
    words = {
        "JOINT_COUNT": str(arm.n),
        "AXIS_COUNT": str(task.m),
        "LAW_COUNT": str(len(laws)),
        "MARKER_COUNT": str(frame.shape[1]),
        "PROGRAMS": (define_functions(body) + body).removesuffix("\n"),
        "STEP_FUNCTIONS": ",".join(f"law{number}" for number in range(len(laws))),
        "SUBSTEPS": str(substeps),
        "WARMUP_CYCLES": str(_WARMUP_CYCLES),
    }
    return fill_template("holdfast.teleop.protocol", "javascript", "arm_module.js", words)


def _wire_frame_points(arm: Arm, q: SX) -> SX:
    """Return (3, markers) positions in the world: the base, if the first joint is elsewhere, every joint and the tool point."""
    moving, fixed = kinematics.body_and_joint_frames(arm, kinematics.joint_transforms(arm, q))
    tool = kinematics.compose_frames(moving[-1], kinematics.split_transform(arm.tool))
    at_base = not np.any(arm.joints[0].origin[:3, 3])
    markers = [*([] if at_base else moving[:1]), *fixed, tool]
    return ca.densify(ca.horzcat(*[position for _, position in markers]))
