"""Export a C++17 controller that continues after a joint fault: the control law, the monitor, and the response."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws.c_functions import CFunction, fill_template, generate_c_functions, write_c_comment
from holdfast.control.laws.export import check_name, holdfast_version
from holdfast.control.laws.law import Law
from holdfast.core.files.output import write_files
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.validation import check_arguments
from holdfast.kernels.c_backend import c_number
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import sampling_limits
from holdfast.response.diagnosis import decision
from holdfast.response.diagnosis.bounds import Bounds
from holdfast.response.diagnosis.export import ExportedMonitor
from holdfast.response.diagnosis.export import export_c as export_monitor
from holdfast.response.diagnosis.gaps import count_cycles
from holdfast.response.diagnosis.sensors import Sensors
from holdfast.response.supervisor import masked_law, thresholds
from holdfast.response.supervisor.condition import calibrated_speeds

REFERENCE_LEAK_PER_S = 1.0  # 1/s: rate servos do not hold a position, so the reference forgets its start value


@dataclass(frozen=True, kw_only=True)
class ExportedController(Result):
    """Files of an exported controller.

    Attributes:
        law: Exported control law.
        header: Path of ``NAME.hpp``, with the class ``NAME::TolerantController``.
        source: Path of ``NAME.cpp``.
        law_header: Path of ``NAME_law.h``.
        law_source: Path of ``NAME_law.c``, the law without the joints that no longer follow.
        example: Path of ``NAME_example.cpp``, a real-time loop with an arm without dynamics.
        monitor: Files of the monitor.
    """

    law: Law
    header: Path
    source: Path
    law_header: Path
    law_source: Path
    example: Path
    monitor: ExportedMonitor

    def __iter__(self) -> Iterator[Path]:
        own = (self.header, self.source, self.law_header, self.law_source, self.example)
        return iter((*own, *self.monitor))

    def describe(self) -> list[str]:
        """Return the written files in sentences."""
        header, *files = self
        names = ", ".join(file.name for file in files)
        return [f"controller of {self.law.arm.title}, {self.law.phrase()}: wrote {header} and {names}"]

    def to_dict(self) -> dict[str, Any]:
        """Return the arm, the law, the monitor's digest and the files."""
        known = {"law": self.law.slug, "task": self.law.task.name, "digest": self.monitor.digest}
        return {**self.law.arm.entry(), **known, "files": [str(file) for file in self]}


@check_arguments
@reports_progress("exporting the controller")
def export_controller(
    law: Law, bounds: Bounds, folder: str | Path, *, name: str = "controller", sensors: Sensors | None = None
) -> ExportedController:
    """Write a C++17 controller that moves the tool by a twist, monitors the joints, and continues with the remaining joints.

    Its life cycle is that of a chainable controller of ROS 2, which it does not need. It responds as
    :func:`holdfast.simulate_faults` does with ``react="chain"``, but has no target and therefore neither intermediate
    configurations nor routes: it brakes a joint and excludes it from the law, slows down, or stops. Joints are commanded rates.
    It is not a certified safety function.

    Args:
        law: Control law of the healthy arm.
        bounds: Detection thresholds of the healthy arm; their rate is that of the loop.
        folder: Output folder, created if necessary.
        name: Name of the namespace, and base name of the files.
        sensors: Accuracy of the sensors. Default: ``Sensors()``.

    Raises:
        InputError: The thresholds are of another arm, or the name is not a valid C identifier.
        ArmError: The thresholds include torques, and the arm's inertial data are missing or impossible.
        StoreError: A file cannot be written.

    Source: derived here; braking turns a free-swinging joint into a locked one, English and Maciejewski 2001.
    """
    check_name(name)
    watching = export_monitor(law.arm, bounds, folder, name=f"{name}_monitor", sensors=sensors)
    text_of = partial(fill_template, "holdfast.response.supervisor", "cpp", words=_template_values(law, bounds, name))
    comment = _header_comment(law, bounds, name)
    texts = {
        f"{name}.hpp": f"{comment}\n{text_of('controller.hpp')}",
        f"{name}.cpp": f"{comment}\n{text_of('controller.cpp')}",
        f"{name}_law.h": f"{comment}\n{text_of('law.h')}",
        f"{name}_law.c": f'{comment}\n#include "{name}_law.h"\n\n#include '
        f"<math.h>\n\n{_masked_law_source(law)}\n{text_of('law.c')}",
        f"{name}_example.cpp": text_of("example.cpp"),
    }
    keys = ("header", "source", "law_header", "law_source", "example")
    return ExportedController(law=law, monitor=watching, **dict(zip(keys, write_files(folder, texts), strict=True)))


def _masked_law_source(law: Law) -> str:
    q, v, mask = kinematics.joint_symbols(law.arm), ca.SX.sym("v", law.task.m), ca.SX.sym("mask", law.arm.n)
    j = law.jacobian(q) @ ca.diag(mask)
    function = CFunction({"q": q, "v": v, "mask": mask}, {"j": [j.T], "scaled": [law.scale_velocity(v)]})
    return f"{generate_c_functions({'seen': function})}\n{law.inverse_in_c()}"


def _template_values(law: Law, bounds: Bounds, name: str) -> dict[str, str]:
    """Return the values of the template placeholders."""
    arm = law.arm
    arrays: dict[str, ArrayLike] = {
        "lower": arm.lower,
        "upper": arm.upper,
        "largest_rate": [joint.velocity for joint in arm.joints],
        "largest_effort": [joint.effort for joint in arm.joints],
        "calibrated_rate": calibrated_speeds(arm, bounds),
        "tracking_bound": bounds.tracking,
    }
    values = {
        "AT_ONCE": thresholds.EARLY_BRAKE_DELAY_S,
        "NAMED": thresholds.NAMING_DEADLINE_S,
        "FINAL": thresholds.VERDICT_DEADLINE_S,
        "STILL": thresholds.STILL_SPEED,
        "RUNS": thresholds.MOVING_SPEED,
        "FASTER": thresholds.RUNAWAY_SPEED_ERROR,
        "BEHIND": thresholds.LAGGING_TRACKING_RATIO,
        "FAR": thresholds.RUNAWAY_TRACKING_RATIO,
        "SLOW": thresholds.SLOW_PACE,
        "HALF": thresholds.REDUCED_PACE,
        "RAMP": thresholds.PACE_RATE_PER_S,
        "QUIET": thresholds.CONTACT_END_S,
        "SETTLED": thresholds.SETTLING_TIME_S,
        "LATER": thresholds.LATE_SAMPLES_WAIT_S,
        "SPARE": thresholds.GRAVITY_SAFETY_FACTOR,
        "SLACK": thresholds.SENSOR_TOLERANCE,
        "NEAR": masked_law.LIMIT_TOLERANCE,
        "LEAK": REFERENCE_LEAK_PER_S,
    }
    home = arm.states.get("home", np.mean(sampling_limits(arm), axis=0))
    return {
        "NAME": name,
        "GUARD": name.upper(),
        "COUNT": str(arm.n),
        "HOME": _cpp_list(home),
        "TASK_ROWS": str(law.task.m),
        "TASK_FRAME": law.task.frame,
        "TASK_TEXT": "{" + ", ".join(f"{{{_cpp_list(row)}}}" for row in law.task.rows) + "}",
        "CONST_ARRAYS": "".join(f"constexpr double {entry}[{arm.n}] = {{{_cpp_list(x)}}};\n" for entry, x in arrays.items()),
        "CONST_SAMPLES": str(thresholds.MIN_POSE_SAMPLES),
        "CONST_KNOWN": str(count_cycles(decision.ISOLATION_TIME_S + decision.CLASSIFICATION_TIME_S, 1 / bounds.rate)),
        **{f"CONST_{entry}": c_number(value) for entry, value in values.items()},
    }


def _cpp_list(values: ArrayLike) -> str:
    """Write numbers as a C++ initialiser list."""
    return ", ".join(map(c_number, np.asarray(values)))


def _header_comment(law: Law, bounds: Bounds, name: str) -> str:
    lines = [
        f"{name}: moves the arm {law.arm.title} by {law.phrase()},",
        f"and continues without a joint that fails; {bounds.rate:g} cycles a second.",
        f"Made by holdfast {holdfast_version()} from the arm {law.arm.fingerprint}.",
        "",
        "No alarm does not mean that nothing is wrong. THIS IS NO CERTIFIED SAFETY FUNCTION.",
        "Compile without -ffast-math.",
    ]
    return write_c_comment(lines)
