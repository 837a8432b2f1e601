"""Export the monitor as C99 code that depends on nothing except ``math.h``, for a robot's own controller."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from holdfast.control.laws.c_functions import CFunction, fill_template, generate_c_functions, write_c_comment
from holdfast.control.laws.export import check_name, holdfast_version, quote_c_string
from holdfast.core.files.output import write_files
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.c_backend import c_number
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.response.diagnosis import decision, kinds
from holdfast.response.diagnosis.bounds import Bounds
from holdfast.response.diagnosis.gaps import MAX_BRIDGED_GAP_S, count_cycles
from holdfast.response.diagnosis.observer import (
    FILTER_BANDWIDTH_RAD_S,
    FRICTION_TRANSITION_RATE,
    LEVEL_BANDWIDTH_RAD_S,
    OBSERVER_GAIN_PER_S,
    momentum_terms,
)
from holdfast.response.diagnosis.sensors import Sensors
from holdfast.response.diagnosis.signals import CALM_TIME_S, EXCESS_LIMITS_S, MAX_SLOW_RATE

# In the order of the enum in the C source.
_KIND_WORDS = ("unknown", "locked", "standstill", "limp", "weak", "friction", "sluggish", "sensor", "contact")


@dataclass(frozen=True, kw_only=True)
class ExportedMonitor(Result):
    """Files of an exported monitor.

    Attributes:
        arm: Monitored arm.
        source: Path of ``NAME.c``.
        header: Path of ``NAME.h``, for C and C++.
        example: Path of ``NAME_example.c``, a program that monitors a log from its standard input.
        digest: Digest of thresholds and sensors; the header contains it and the fingerprint of the arm.
    """

    arm: Arm
    source: Path
    header: Path
    example: Path
    digest: str

    def __iter__(self) -> Iterator[Path]:
        return iter((self.source, self.header, self.example))

    def describe(self) -> list[str]:
        """Describe which files were written."""
        source, *others = self
        return [f"monitor of {self.arm.title}: wrote {source} and {', '.join(file.name for file in others)}"]

    def to_dict(self) -> dict[str, Any]:
        """Return the arm, the digest, and the files."""
        files = zip(("source", "header", "example"), map(str, self), strict=True)
        return {**self.arm.entry(), "digest": self.digest, **dict(files)}


@check_arguments
@reports_progress("exporting the monitor")
def export_c(
    arm: Arm, bounds: Bounds, folder: str | Path, *, name: str = "monitor", sensors: Sensors | None = None
) -> ExportedMonitor:
    """Export :class:`holdfast.response.diagnosis.Monitor` as C99 code that computes the same numbers and verdicts.

    The code allocates no memory and keeps its state in a struct that the caller owns, one for each arm. Every cycle takes the
    same time, except for cycles with a pose. It is not a certified safety function.

    Args:
        arm: Arm to monitor.
        bounds: Detection thresholds of the healthy arm.
        folder: Output folder, created if necessary.
        name: Prefix of the functions and base name of the files.
        sensors: Accuracy of the sensors. Default: ``Sensors()``.

    Raises:
        InputError: The thresholds are of another arm, or the name is not a valid C identifier.
        ArmError: The thresholds include torques, and the arm's inertial data are missing or impossible.
        StoreError: A file cannot be written.
    """
    bounds.require(arm, bounds.rate)
    check_name(name)
    sensor_accuracy = sensors or Sensors()
    digest = _monitor_digest(bounds, sensor_accuracy)
    replacements = {"NAME": name, "GUARD": name.upper(), "COUNT": str(arm.n)}
    replacements |= {
        "VERSION": holdfast_version(),
        "FINGERPRINT": arm.fingerprint,
        "DIGEST": digest,
        "RATE_HZ": repr(bounds.rate),
    }
    constants = {**replacements, **_c_constants(arm, bounds, sensor_accuracy)}
    heading = _heading_comment(arm, bounds, name, digest)
    text_of = partial(fill_template, "holdfast.response.diagnosis", "c")
    texts = {
        f"{name}.c": f'{heading}\n#include "{name}.h"\n\n#include '
        f"<math.h>\n\n{_model_source(arm, bounds, sensor_accuracy, name)}\n"
        + text_of("arithmetic.c", replacements)
        + "\n"
        + text_of("monitor.c", constants),
        f"{name}.h": f"{heading}\n" + text_of("monitor.h", constants),
        f"{name}_example.c": text_of("monitor_example.c", replacements),
    }
    source, header, example = write_files(folder, texts)
    return ExportedMonitor(arm=arm, source=source, header=header, example=example, digest=digest)


def _monitor_digest(bounds: Bounds, sensors: Sensors) -> str:
    """Return the digest of all numbers that the monitor contains, in a fixed order."""
    data = {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in vars(bounds).items()}
    return hashlib.sha256(json.dumps([data, vars(sensors)], sort_keys=True).encode()).hexdigest()


def _c_constants(arm: Arm, bounds: Bounds, sensors: Sensors) -> dict[str, str]:
    """Return the values of the placeholders in the source text, in the notation of C."""
    period = 1 / bounds.rate
    durations = {
        "SPLIT": decision.ISOLATION_TIME_S,
        "LAST": decision.ISOLATION_TIME_S + decision.CLASSIFICATION_TIME_S,
        "AGAIN": decision.SENSOR_REVISION_TIME_S,
    }
    durations |= {"ENDS": decision.POSE_MONITORING_TIME_S, "CALM": CALM_TIME_S, "LONGEST": MAX_BRIDGED_GAP_S}
    values = {
        "DT": period,
        "BAND": min(1.0, FILTER_BANDWIDTH_RAD_S * period),
        "LOW": min(1.0, OBSERVER_GAIN_PER_S * period),
        "KEEP": 1 - OBSERVER_GAIN_PER_S * period,
        "LEVEL": min(1.0, LEVEL_BANDWIDTH_RAD_S * period),
        "GAIN": OBSERVER_GAIN_PER_S,
        "SLIP": FRICTION_TRANSITION_RATE,
        "SLOW": MAX_SLOW_RATE,
        "POSITION": bounds.position,
        "ANGLE": bounds.angle,
        "LIMIT_Z": EXCESS_LIMITS_S["torque"],
        "LIMIT_Y": EXCESS_LIMITS_S["tracking"],
        "LIMIT_W": EXCESS_LIMITS_S["tool"],
        "NOISE": kinds.NOISE_FACTOR * sensors.joint,
        "LEAST": kinds.FRICTION_LOSS_RANGE[0],
        "MOST": kinds.FRICTION_LOSS_RANGE[1],
    }
    values |= {name: getattr(decision, name) for name in ("UNSURE", "SUSPECT", "WORSE", "PUSHED")}
    thresholds = ("SCALE", "STILL", "PART", "TIMES", "ALL", "MORE", "AWAY", "LOST", "GROWN", "DRIVEN")
    values |= {name: getattr(kinds, name) for name in thresholds}
    literals = {name: str(count_cycles(seconds, period)) for name, seconds in durations.items()}
    literals |= {name: c_number(value) for name, value in values.items()}
    torques = str(int(np.isfinite(bounds.torque).all()))
    named_kinds = ", ".join(map(quote_c_string, _KIND_WORDS))
    replacements = {
        "WITH_TORQUES": torques,
        "KIND_WORDS": named_kinds,
        "LATE_CYCLES": str(round(sensors.latency * bounds.rate)),
    }
    return {**replacements, **{f"CONST_{name}": value for name, value in literals.items()}}


def _c_array(name: str, values: FloatArray) -> str:
    return f"static const double {name}[{len(values)}] = {{{', '.join(map(c_number, values))}}};\n"


def _model_source(arm: Arm, bounds: Bounds, sensors: Sensors, name: str) -> str:
    """Return C code of names, thresholds, and the arm's equations, from the expression graph of the Python monitor."""
    q, v = kinematics.joint_symbols(arm), ca.SX.sym("v", arm.n)
    pose = kinematics.tool_pose(arm, q)
    moving, _ = kinematics.body_and_joint_frames(arm, kinematics.joint_transforms(arm, q))
    link_ends = [*(position - pose[:3, 3] for _, position in moving[2:]), ca.SX(3, 1)]  # far ends of links, from the tool
    tool_outputs = {"there": [pose[:3, :3].T, pose[:3, 3]], "jacobian": [kinematics.world_jacobian(arm, q)], "ends": link_ends}
    functions = {"tool": CFunction({"q": q}, tool_outputs)}
    if np.isfinite(bounds.torque).all():
        terms = zip(("p", "energy", "gravity"), momentum_terms(bounds.body(arm), q, v), strict=True)
        functions["momentum"] = CFunction({"q": q, "v": v}, {term: [term_expression] for term, term_expression in terms})
    source = generate_c_functions(functions)
    joints = ", ".join(quote_c_string(quantity) for quantity in arm.joint_names)
    source += f"\nconst char *const {name}_joints[{arm.n}] = {{{joints}}};\n\n"
    source += "".join(_c_array(f"{quantity}_bound", getattr(bounds, quantity)) for quantity in ("torque", "change", "tracking"))
    source += _c_array("weight", np.repeat(1 / np.array([sensors.position, sensors.angle]), 3))
    source += _c_array("viscous", bounds.viscous) if "momentum" in functions else ""
    return source + _c_array("coulomb", bounds.coulomb)


def _heading_comment(arm: Arm, bounds: Bounds, name: str, digest: str) -> str:
    false_alarm_rates = bounds.false_alarms()
    limit = (
        "unknown"
        if false_alarm_rates is None
        else f"fewer than {false_alarm_rates[1]:.3g} an hour with 95 % confidence, for motion as calibrated"
    )
    lines = [
        f"{name}: fault monitor of the arm {arm.title}, {bounds.rate:g} cycles a second.",
        f"Made by holdfast {holdfast_version()} from the arm {arm.fingerprint}",
        f"and the thresholds {digest}; C99, needs only math.h.",
        "",
        f"False alarms: {limit}.",
        "No alarm does not mean that nothing is wrong. THIS IS NO CERTIFIED SAFETY FUNCTION.",
        "Compile without -ffast-math.",
    ]
    return write_c_comment(lines)
