"""The monitor as C99 that needs nothing but ``math.h``, for a robot's own controller."""

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
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.control.c_functions import Function, commented, filled, written
from holdfast.control.export import check_name, quoted, version
from holdfast.diagnosis import decision, kinds
from holdfast.diagnosis.bounds import Bounds
from holdfast.diagnosis.gaps import STALE, cycles
from holdfast.diagnosis.observer import BAND, GAIN, LEVEL, SLIP, momentum_terms
from holdfast.diagnosis.sensors import Sensors
from holdfast.diagnosis.signals import CALM, LIMITS, SLOW
from holdfast.files.output import put
from holdfast.kernels.c_backend import number
from holdfast.kernels.javascript_backend import javascript
from holdfast.notice import says
from holdfast.result import Result

Array = NDArray[np.float64]

# As the enum in C has them.
_KINDS = ("unknown", "locked", "standstill", "limp", "weak", "friction", "sluggish", "sensor", "contact")


@dataclass(frozen=True, kw_only=True)
class ExportedMonitor(Result):
    """The files of a monitor.

    Attributes:
        arm: The arm.
        source: ``NAME.c``.
        header: ``NAME.h``, for C and C++.
        example: ``NAME_example.c``, which watches a record from its standard input.
        digest: Of bounds and sensors; the header has it, and the arm's fingerprint.
    """

    arm: Arm
    source: Path
    header: Path
    example: Path
    digest: str

    def __iter__(self) -> Iterator[Path]:
        return iter((self.source, self.header, self.example))

    def describe(self) -> list[str]:
        """What was written where."""
        source, *others = self
        return [f"monitor of {self.arm.title}: wrote {source} and {', '.join(file.name for file in others)}"]

    def to_dict(self) -> dict[str, Any]:
        """The arm, the digest and the files."""
        files = zip(("source", "header", "example"), map(str, self), strict=True)
        return {**self.arm.entry(), "digest": self.digest, **dict(files)}


@checked
@says("writing down the monitor")
def export_c(
    arm: Arm, bounds: Bounds, folder: str | Path, *, name: str = "monitor", sensors: Sensors | None = None
) -> ExportedMonitor:
    """Write the monitor of :class:`holdfast.diagnosis.Monitor` as C99: the same numbers and the same verdicts.

    It allocates nothing, keeps everything in a struct that the caller owns, one for each arm, and takes the same time in every
    cycle but for those with a pose. It is no certified safety function.

    Args:
        arm: The arm.
        bounds: Of the healthy arm.
        folder: For the files, made if it is not there.
        name: Of the functions and the files.
        sensors: How good they are.

    Raises:
        InputError: Bounds of another arm, or a name that no C function can have.
        ArmError: The bounds have torques, and the arm's inertial data are missing or impossible.
        StoreError: They cannot be written.
    """
    bounds.require(arm, bounds.rate)
    check_name(name)
    known = sensors or Sensors()
    digest = _digest(bounds, known)
    words = {"NAME": name, "GUARD": name.upper(), "COUNT": str(arm.n)}
    words |= {"VERSION": version(), "FINGERPRINT": arm.fingerprint, "DIGEST": digest, "RATE_HZ": repr(bounds.rate)}
    constants = {**words, **_constants(arm, bounds, known)}
    about = _about(arm, bounds, name, digest)
    text_of = partial(filled, "holdfast.diagnosis", "c")
    texts = {
        f"{name}.c": f'{about}\n#include "{name}.h"\n\n#include <math.h>\n\n{_graph(arm, bounds, known, name)}\n'
        + text_of("arithmetic.c", words)
        + "\n"
        + text_of("monitor.c", constants),
        f"{name}.h": f"{about}\n" + text_of("monitor.h", constants),
        f"{name}_example.c": text_of("monitor_example.c", words),
    }
    source, header, example = put(folder, texts)
    return ExportedMonitor(arm=arm, source=source, header=header, example=example, digest=digest)


def _digest(bounds: Bounds, sensors: Sensors) -> str:
    """Of all numbers that the monitor has, in their order."""
    data = {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in vars(bounds).items()}
    return hashlib.sha256(json.dumps([data, vars(sensors)], sort_keys=True).encode()).hexdigest()


def _constants(arm: Arm, bounds: Bounds, sensors: Sensors) -> dict[str, str]:
    """What the text leaves open, as C writes it."""
    dt = 1 / bounds.rate
    times = {"SPLIT": decision.ISOLATE, "LAST": decision.ISOLATE + decision.CLASSIFY, "AGAIN": decision.AGAIN}
    times |= {"ENDS": decision.WATCHED, "CALM": CALM, "LONGEST": STALE}
    values = {
        "DT": dt,
        "BAND": min(1.0, BAND * dt),
        "LOW": min(1.0, GAIN * dt),
        "KEEP": 1 - GAIN * dt,
        "LEVEL": min(1.0, LEVEL * dt),
        "GAIN": GAIN,
        "SLIP": SLIP,
        "SLOW": SLOW,
        "POSITION": bounds.position,
        "ANGLE": bounds.angle,
        "LIMIT_Z": LIMITS["torque"],
        "LIMIT_Y": LIMITS["tracking"],
        "LIMIT_W": LIMITS["tool"],
        "NOISE": kinds.NOISY * sensors.joint,
        "LEAST": kinds.CARRIED[0],
        "MOST": kinds.CARRIED[1],
    }
    values |= {name: getattr(decision, name) for name in ("UNSURE", "SUSPECT", "WORSE", "PUSHED")}
    thresholds = ("SCALE", "STILL", "PART", "TIMES", "ALL", "MORE", "AWAY", "LOST", "GROWN", "DRIVEN")
    values |= {name: getattr(kinds, name) for name in thresholds}
    named = {name: str(cycles(seconds, dt)) for name, seconds in times.items()}
    named |= {name: number(value) for name, value in values.items()}
    torques = str(int(np.isfinite(bounds.torque).all()))
    named_kinds = ", ".join(map(quoted, _KINDS))
    words = {"WITH_TORQUES": torques, "KIND_WORDS": named_kinds, "LATE_CYCLES": str(round(sensors.latency * bounds.rate))}
    return {**words, **{f"CONST_{name}": value for name, value in named.items()}}


def _array(name: str, values: Array) -> str:
    return f"static const double {name}[{len(values)}] = {{{', '.join(map(number, values))}}};\n"


def _functions(arm: Arm, bounds: Bounds) -> dict[str, Function]:
    """What is computed of the arm's equations, by the graph that the Python monitor has."""
    q, v = kinematics.joint_symbols(arm), ca.SX.sym("v", arm.n)
    pose = kinematics.tool_pose(arm, q)
    moving, _ = kinematics.frames(arm, kinematics.joint_steps(arm, q))
    ends = [*(position - pose[:3, 3] for _, position in moving[2:]), ca.SX(3, 1)]  # of links, from the tool
    there = {"there": [pose[:3, :3].T, pose[:3, 3]], "jacobian": [kinematics.jacobian(arm, q)], "ends": ends}
    functions = {"tool": Function({"q": q}, there)}
    if np.isfinite(bounds.torque).all():
        terms = zip(("p", "energy", "gravity"), momentum_terms(bounds.body(arm), q, v), strict=True)
        functions["momentum"] = Function({"q": q, "v": v}, {term: [x] for term, x in terms})
    return functions


def javascript_of(arm: Arm, bounds: Bounds, *, sensors: Sensors | None = None) -> str:
    """The monitor as a module of JavaScript that exports a class ``Monitor``: the same numbers and the same verdicts.

    ``monitor.step(q, reference, torque, pose)`` takes arrays, the last two or ``null``, and returns the verdict of C's struct:
    ``{alarm, time, joint, kind, loss}``; ``monitor.kind()`` is the word. ``monitor.stale()`` has the words of
    :attr:`Monitor.stale`. It is no certified safety function.

    Args:
        arm: The arm.
        bounds: Of the healthy arm.
        sensors: How good they are.

    Raises:
        InputError: Bounds of another arm.
        ArmError: The bounds have torques, and the arm's inertial data are missing or impossible.
    """
    bounds.require(arm, bounds.rate)
    known = sensors or Sensors()
    words = {"COUNT": str(arm.n), "RATE_HZ": repr(bounds.rate), "NAME": "monitor", **_constants(arm, bounds, known)}
    words = {word: text.replace("HUGE_VAL", "Infinity") for word, text in words.items()}
    programs = [javascript(function.program(call), call) for call, function in _functions(arm, bounds).items()]
    arrays = {
        "torqueBound": bounds.torque,
        "changeBound": bounds.change,
        "trackingBound": bounds.tracking,
        "weight": _weights(known),
        "viscous": bounds.viscous,
        "coulomb": bounds.coulomb,
    }
    numbers = [f"const {key} = [{', '.join(map(number, values))}];\n" for key, values in arrays.items()]
    named = f"export const joints = {json.dumps(arm.joint_names)};\n"
    text = "".join(numbers).replace("HUGE_VAL", "Infinity") + named
    return "\n".join(
        [
            _about(arm, bounds, "monitor", _digest(bounds, known), "JavaScript, needs nothing"),
            *programs,
            text,
            filled("holdfast.diagnosis", "c", "monitor.js", words),
        ]
    )


def _weights(sensors: Sensors) -> Array:
    return np.repeat(1 / np.array([sensors.position, sensors.angle]), 3)


def _graph(arm: Arm, bounds: Bounds, sensors: Sensors, name: str) -> str:
    """Names, bounds, and what is computed of the arm's equations."""
    functions = _functions(arm, bounds)
    text = written(functions)
    joints = ", ".join(quoted(x) for x in arm.joint_names)
    text += f"\nconst char *const {name}_joints[{arm.n}] = {{{joints}}};\n\n"
    text += "".join(_array(f"{x}_bound", getattr(bounds, x)) for x in ("torque", "change", "tracking"))
    text += _array("weight", _weights(sensors))
    text += _array("viscous", bounds.viscous) if "momentum" in functions else ""
    return text + _array("coulomb", bounds.coulomb)


def _about(arm: Arm, bounds: Bounds, name: str, digest: str, needs: str = "C99, needs only math.h") -> str:
    told = bounds.false_alarms()
    limit = "unknown" if told is None else f"fewer than {told[1]:.3g} an hour with 95 % confidence, for motion as calibrated"
    lines = [
        f"{name}: watches the arm {arm.title} for joint faults, {bounds.rate:g} cycles a second.",
        f"Made by holdfast {version()} of the arm {arm.fingerprint}",
        f"and the bounds {digest}; {needs}.",
        "",
        f"False alarms: {limit}.",
        "No alarm does not mean that nothing is wrong. THIS IS NO CERTIFIED SAFETY FUNCTION.",
        *(["Compile without -ffast-math."] if "C99" in needs else []),
    ]
    return commented(lines)
