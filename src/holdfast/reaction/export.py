"""A controller in C++17 that goes on after a joint fault: the law, the monitor and what one does about what the other says."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.arguments import checked
from holdfast.arm import kinematics
from holdfast.arm.configurations import finite_limits
from holdfast.control.c_functions import Function, commented, filled, written
from holdfast.control.export import check_name, version
from holdfast.control.law import Law
from holdfast.diagnosis import decision
from holdfast.diagnosis.bounds import Bounds
from holdfast.diagnosis.export import ExportedMonitor
from holdfast.diagnosis.export import export_c as export_monitor
from holdfast.diagnosis.gaps import cycles
from holdfast.diagnosis.sensors import Sensors
from holdfast.files.output import put
from holdfast.kernels.c_backend import number
from holdfast.notice import says
from holdfast.reaction import controller, masked
from holdfast.result import Result

LEAK = 1.0  # 1/s: servos of rates do not hold a place, so the reference forgets where it began


@dataclass(frozen=True, kw_only=True)
class ExportedController(Result):
    """The files of a controller.

    Attributes:
        law: Its law.
        header: ``NAME.hpp``, with the class ``NAME::TolerantController``.
        source: ``NAME.cpp``.
        law_header: ``NAME_law.h``.
        law_source: ``NAME_law.c``: the law without the joints that no longer follow.
        example: ``NAME_example.cpp``, a loop by the clock around an arm without dynamics.
        ros: ``NAME_ros.cpp``, the same as a chainable controller of ROS 2, not compiled against ROS 2.
        plugin: ``NAME_plugin.xml``, for that.
        monitor: Its monitor's files.
    """

    law: Law
    header: Path
    source: Path
    law_header: Path
    law_source: Path
    example: Path
    ros: Path
    plugin: Path
    monitor: ExportedMonitor

    def __iter__(self) -> Iterator[Path]:
        own = (self.header, self.source, self.law_header, self.law_source, self.example, self.ros, self.plugin)
        return iter((*own, *self.monitor))

    def describe(self) -> list[str]:
        """What was written where."""
        first, *others = self
        names = ", ".join(file.name for file in others)
        return [f"controller of {self.law.arm.title}, {self.law.phrase()}: wrote {first} and {names}"]

    def to_dict(self) -> dict[str, Any]:
        """The arm, the law, the monitor's digest and the files."""
        known = {"law": self.law.slug, "task": self.law.task.name, "digest": self.monitor.digest}
        return {**self.law.arm.entry(), **known, "files": [str(file) for file in self]}


@checked
@says("writing down the controller")
def export_controller(
    law: Law, bounds: Bounds, folder: str | Path, *, name: str = "controller", sensors: Sensors | None = None
) -> ExportedController:
    """Write a controller in C++17 that moves the tool by a twist, watches for joint faults and goes on with what is left.

    Its life cycle is that of a chainable controller of ROS 2, and it needs nothing of it; a file that does is beside it. It
    reacts as :func:`holdfast.simulate_faults` does with ``react="chain"``, but knows no target, hence no other posture and no
    route: it brakes a joint and leaves it out of the law, slows down, or stops. Joints are commanded rates. It is no certified
    safety function.

    Args:
        law: For the healthy arm.
        bounds: Of the healthy arm; the rate of its records is that of the loop.
        folder: For the files, made if it is not there.
        name: Of the namespace and the files.
        sensors: How good they are.

    Raises:
        InputError: Bounds of another arm, or a name that no C function can have.
        ArmError: The bounds have torques, and the arm's inertial data are missing or impossible.
        StoreError: They cannot be written.

    Source: derived here; braking turns a free-swinging joint into a locked one, English and Maciejewski 2001.
    """
    check_name(name)
    watching = export_monitor(law.arm, bounds, folder, name=f"{name}_monitor", sensors=sensors)
    text_of = partial(filled, "holdfast.reaction", "cpp", words=_words(law, bounds, name))
    about = _about(law, bounds, name)
    texts = {
        f"{name}.hpp": f"{about}\n{text_of('controller.hpp')}",
        f"{name}.cpp": f"{about}\n{text_of('controller.cpp')}",
        f"{name}_law.h": f"{about}\n{text_of('law.h')}",
        f"{name}_law.c": f'{about}\n#include "{name}_law.h"\n\n#include <math.h>\n\n{_masked(law)}\n{text_of("law.c")}',
        f"{name}_example.cpp": text_of("example.cpp"),
        f"{name}_ros.cpp": text_of("ros.cpp"),
        f"{name}_plugin.xml": text_of("plugin.xml"),
    }
    keys = ("header", "source", "law_header", "law_source", "example", "ros", "plugin")
    return ExportedController(law=law, monitor=watching, **dict(zip(keys, put(folder, texts), strict=True)))


def _masked(law: Law) -> str:
    q, v, mask = kinematics.joint_symbols(law.arm), ca.SX.sym("v", law.task.m), ca.SX.sym("mask", law.arm.n)
    j = law.jacobian(q) @ ca.diag(mask)
    seen = Function({"q": q, "v": v, "mask": mask}, {"j": [j.T], "scaled": [law.scaled(v)]})
    return f"{written({'seen': seen})}\n{law.inverse_in_c()}"


def _words(law: Law, bounds: Bounds, name: str) -> dict[str, str]:
    """What the files leave open."""
    arm = law.arm
    arrays: dict[str, ArrayLike] = {
        "lower": arm.lower,
        "upper": arm.upper,
        "largest_rate": [joint.velocity for joint in arm.joints],
        "largest_effort": [joint.effort for joint in arm.joints],
        "calibrated_rate": controller.calibrated(arm, bounds),
        "tracking_bound": bounds.tracking,
    }
    values = {
        "AT_ONCE": controller.AT_ONCE,
        "NAMED": controller.NAMED,
        "FINAL": controller.FINAL,
        "STILL": controller.STILL,
        "RUNS": controller.RUNS,
        "FASTER": controller.FASTER,
        "BEHIND": controller.BEHIND,
        "FAR": controller.FAR_OFF,
        "SLOW": controller.SLOW,
        "HALF": controller.HALF,
        "RAMP": controller.RAMP,
        "QUIET": controller.QUIET,
        "SETTLED": controller.SETTLED,
        "LATER": controller.LATER,
        "SPARE": controller.SPARE,
        "SLACK": controller.SLACK,
        "NEAR": masked.NEAR,
        "LEAK": LEAK,
    }
    home = arm.states.get("home", np.mean(finite_limits(arm), axis=0))
    return {
        "NAME": name,
        "GUARD": name.upper(),
        "COUNT": str(arm.n),
        "HOME": _listed(home),
        "TASK_ROWS": str(law.task.m),
        "TASK_FRAME": law.task.frame,
        "TASK_TEXT": "{" + ", ".join(f"{{{_listed(row)}}}" for row in law.task.rows) + "}",
        "CONST_ARRAYS": "".join(f"constexpr double {key}[{arm.n}] = {{{_listed(x)}}};\n" for key, x in arrays.items()),
        "CONST_SAMPLES": str(controller.SAMPLES),
        "CONST_KNOWN": str(cycles(decision.ISOLATE + decision.CLASSIFY, 1 / bounds.rate)),
        **{f"CONST_{key}": number(value) for key, value in values.items()},
    }


def _listed(values: ArrayLike) -> str:
    """Numbers as C++ writes them."""
    return ", ".join(map(number, np.asarray(values)))


def _about(law: Law, bounds: Bounds, name: str) -> str:
    lines = [
        f"{name}: moves the arm {law.arm.title} by {law.phrase()},",
        f"and goes on without a joint that fails; {bounds.rate:g} cycles a second.",
        f"Made by holdfast {version()} of the arm {law.arm.fingerprint}.",
        "",
        "No alarm does not mean that nothing is wrong. THIS IS NO CERTIFIED SAFETY FUNCTION.",
        "Compile without -ffast-math.",
    ]
    return commented(lines)
