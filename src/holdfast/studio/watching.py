"""A joint fails while the arm moves, and a monitor that was calibrated on the healthy arm says which: computed, then drawn.

The page has that monitor too, and runs it over what the robot told so far: what is said of the alarm comes from there.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html import escape
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.poses import pose_of, rotations_of_quaternions
from holdfast.diagnosis.decision import AGAIN, CLASSIFY, ISOLATE
from holdfast.errors import InputError
from holdfast.studio.motions import SAMPLES, Motion
from holdfast.studio.scene.machine import Machine
from holdfast.studio.state import State

if TYPE_CHECKING:
    from holdfast.diagnosis.answer import Diagnosis
    from holdfast.diagnosis.bounds import Bounds
    from holdfast.faults.log import Log
    from holdfast.reaction.run import FaultRun

Array = NDArray[np.float64]

KINDS: Mapping[str, Mapping[str, float | str]] = MappingProxyType(
    {
        "locked": {"at": "here"},
        "limp": {},
        "weak": {"gain": 0.3},
        "friction": {"coulomb": 8.0, "viscous": 0.0},
        "sensor_freeze": {},
        "sensor_drift": {"rate": 0.05},
        "slipping_clutch": {},
        "none": {},
    }
)
LATEST = 4.0  # s: the last time at which a fault can begin
SPEED, GAIN, LONGEST = 0.25, 2.0, 8.0  # m/s, 1/s, s: of the motions
HEALTHY, FACTOR = 4, 2.0  # motions that the bounds are of, and what these are multiplied by: few records need more room
POINTS, STEPS = 150, 60  # of a line, and of the time as it plays
_LOW, _HIGH = 0.1, 30.0  # of a bound: what the drawing shows
_WIDE, _TALL = 300, 74  # of one panel


@dataclass(frozen=True, kw_only=True)
class Watched:
    """What happened, and what the monitor saw.

    Attributes:
        motion: Of the arm with its fault.
        time: (T,) s.
        residuals: By what is watched, in units of its bound: (T, n), of the tool (T, 1).
        onset: Of the fault, s; infinite without one.
        alarm: s; infinite without one.
        joint: The one that was named, from 0; None if none was.
        named: When, s; infinite if none was.
        said: What was known, each with the time from which on, s.
        untold: What could not be told.
        record: HTML that shows nothing: what the robot told, and the monitor as a module of JavaScript.
    """

    motion: Motion
    time: Array
    residuals: Mapping[str, Array]
    onset: float
    alarm: float
    joint: int | None
    named: float
    said: tuple[tuple[float, str], ...]
    untold: tuple[str, ...]
    record: str


_known: dict[object, Bounds] = {}  # of the last question: to inject another fault takes one motion, not five


def watched(machine: Machine, state: State, progress: Callable[[int, int], None]) -> Watched:
    """Move to the target under the first law while a joint fails and nobody reacts, and what a monitor makes of it.

    Everything is simulated: masses and friction of the robot are up to 20 % off the arm's model, and its sensors are noisy.

    Args:
        machine: The arm.
        state: Where the arm is, its target, the law, and the fault: kind, joint and time.
        progress: Told of (done, in all) motions; raises to give up.

    Raises:
        InputError: No target, or no such fault.
        ArmError: The arm's inertial data are missing or impossible.
        HoldfastError: MuJoCo is not installed.
    """
    import holdfast as hf

    kind, joint, onset = state.fault
    if state.target is None:
        raise InputError("there is no target; choose one first")
    arm, q = machine.arm, np.array(state.q)
    there, here = pose_of(state.target[:3], state.target[3:]), machine.hand(q)
    law = hf.control.by_name(state.laws[0], arm, task=machine.task, gain=GAIN, speed_limit=SPEED)
    body, start, logs = hf.Body(), q, list[hf.faults.Log]()
    question = (arm.fingerprint, machine.task.name, state.laws[0], state.q, state.target)
    for k in range(HEALTHY if question not in _known else 0):
        progress(k, HEALTHY + 1)
        goal = _rows(machine, here if k % 2 else there)
        run = hf.simulate_faults(law, start, goal, body=body, seed=k, time_limit=LONGEST)
        logs, start = [*logs, run.log()], np.asarray(run.q[-1])
    if logs:
        dry, viscous = np.full(arm.n, body.coulomb), np.full(arm.n, body.viscous)
        _known.clear()
        _known[question] = hf.diagnosis.calibrate(arm, logs, factor=FACTOR, coulomb=dry, viscous=viscous)
    monitor = hf.diagnosis.Monitor(arm, _known[question])
    progress(HEALTHY, HEALTHY + 1)
    faults = [] if kind == "none" else [hf.faults.FaultEvent(kind, joint, onset, parameters=KINDS[kind])]  # type: ignore[arg-type]
    run = hf.simulate_faults(law, q, _rows(machine, there), faults=faults, body=body, seed=HEALTHY, time_limit=LONGEST)
    return _told(run, monitor.run(run.log()), onset if faults else np.inf, state.names)


def _rows(machine: Machine, pose: Array) -> Array:
    """A target as the task takes it."""
    return pose if machine.task.angular else np.asarray(machine.task.rows[:, :3] @ pose[:3, 3])


def _told(run: FaultRun, found: Diagnosis, onset: float, names: tuple[str, ...]) -> Watched:
    import holdfast as hf

    verdict, scaled, every = found.verdict, found.scaled, max(1, len(run.time) // POINTS)
    said: list[tuple[float, str]] = []
    alarm = float(verdict.time) if verdict.alarm else np.inf
    named = alarm + (AGAIN if verdict.kind == "sensor" else ISOLATE)
    if verdict.alarm:
        first, *more = [line for line in found.describe() if line.startswith("alarm at")] + list(verdict.evidence)
        known = named if verdict.kind == "sensor" else named + CLASSIFY
        said = [(known, text) for text in (first.partition(": ")[2], *more)]
    untold = [f"did not move enough to tell: {', '.join(found.untold)}"] if found.untold else []
    if verdict.alarm and len(verdict.candidates) > 1:
        untold.append(f"not told apart: {', '.join(verdict.candidates)}")
    if not verdict.alarm:
        untold.insert(0, "no fault was seen, which does not prove that there is none")
    residuals = {"torques": _largest(scaled.torque, every), "joint sensors": _largest(scaled.tracking, every)}
    if np.isfinite(scaled.tool).any():
        residuals["the tool's measured pose"] = _largest(scaled.tool[:, None], every)
    often = slice(None, None, max(1, len(run.time) // (4 * SAMPLES)))
    return Watched(
        motion=Motion("the arm with the fault, nobody reacts", run.time[often], "s", run.q[often]),
        time=run.time[::every],
        residuals=residuals,
        onset=onset,
        alarm=alarm,
        joint=names.index(verdict.joint) if verdict.joint in names else None,
        named=np.inf if verdict.joint is None else named,
        said=tuple(said),
        untold=tuple(untold),
        record=_record(found.log, hf.diagnosis.javascript_of(run.arm, found.bounds), onset),
    )


def _record(log: Log, monitor: str, onset: float) -> str:
    """Rows of joints, references and torques; the poses that were measured, (4, 4) by rows; the monitor; for the page."""
    assert log.tau is not None
    assert log.x is not None
    assert log.quat is not None
    seen = np.flatnonzero(np.isfinite(log.x[:, 0]))
    poses = np.tile(np.eye(4), (len(seen), 1, 1))
    poses[:, :3, :3], poses[:, :3, 3] = rotations_of_quaternions(log.quat[seen]), log.x[seen]
    numbers = (np.concatenate([log.q, log.q_ref, log.tau], axis=1), poses)
    texts = (*(b64encode(part.tobytes()).decode() for part in numbers), monitor)
    inside, every = "".join(f"<b>{escape(text)}</b>" for text in texts), int(np.diff(seen)[0])
    begins = onset if np.isfinite(onset) else ""
    return f'<div hidden class="hf-record" data-rate="{log.rate:g}" data-every="{every}" data-onset="{begins}">{inside}</div>'


def _largest(values: Array, every: int) -> Array:
    """The largest of each few samples, so that no peak is lost: (T', n); NaN where there is none."""
    rows = -(-len(values) // every)
    padded = np.full((rows * every, values.shape[1]), -np.inf)
    padded[: len(values)] = np.where(np.isfinite(values), values, -np.inf)
    top = padded.reshape(rows, every, -1).max(axis=1)
    return np.where(np.isfinite(top), top, np.nan)


# ---- drawn -----------------------------------------------------------------------------------------------------------


def watched_html(found: Watched, names: tuple[str, ...], now: float) -> str:
    """Residuals up to now, each in units of its bound, and what the monitor has said so far."""
    end = float(found.time[-1])
    now = now if now >= end else end * np.floor(now / end * STEPS) / STEPS  # or the page would be sent thirty times a second
    panels = [_panel(what, found, values, now, names) for what, values in found.residuals.items() if np.isfinite(values).any()]
    so_far = [text for time, text in found.said if time <= now]
    lines = [*so_far, *(found.untold if now >= end * (1 - 1e-9) else ())]
    items = "".join(f"<li>{escape(line)}</li>" for line in lines)
    key = "Each line is a joint; dashes: its bound, purple: the fault begins, orange: the alarm."
    return (
        f'<div class="hf-watch"><strong class="hf-head" data-now="{now:.6g}"></strong><div class="hf-soft">{key}</div>'
        f"{''.join(panels)}<ul>{items}</ul></div>"
    )


def _panel(what: str, found: Watched, values: Array, now: float, names: tuple[str, ...]) -> str:
    end = float(found.time[-1]) or 1.0
    seen = found.time <= now
    x = _WIDE * found.time / end
    y = _TALL - _TALL * np.log(np.clip(values, _LOW, _HIGH) / _LOW) / np.log(_HIGH / _LOW)
    bound = _TALL - _TALL * np.log(1 / _LOW) / np.log(_HIGH / _LOW)
    lines = []
    for k in range(values.shape[1]):
        good = seen & np.isfinite(values[:, k])
        named = k == found.joint and values.shape[1] > 1 and now >= found.named
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x[good], y[good, k], strict=True))
        lines.append((named, f'<polyline{" class=hf-named" if named else ""} points="{points}"/>'))
    marks = [
        f'<line class="{mark}" x1="{_WIDE * t / end:.1f}" x2="{_WIDE * t / end:.1f}" y1="0" y2="{_TALL}"/>'
        for mark, t in (("hf-onset", found.onset), ("hf-alarm", found.alarm))
        if t <= min(now, end)
    ]
    over = [names[k] for k in range(values.shape[1]) if values.shape[1] > 1 and np.nanmax(np.append(values[seen, k], 0)) > 1]
    label = f"{what}, in units of their bounds, to {now:.2f} s; over: {', '.join(over) or 'none'}"
    drawn = "".join(text for _, text in sorted(lines))
    return (
        f"<figure><figcaption>{escape(what)}, of the bound</figcaption>"
        f'<svg viewBox="0 0 {_WIDE} {_TALL}" role="img" aria-label="{escape(label, quote=True)}">{drawn}'
        f'<line class="hf-bound" x1="0" x2="{_WIDE}" y1="{bound:.1f}" y2="{bound:.1f}"/>{"".join(marks)}'
        f'<text x="2" y="{bound - 2:.1f}">1</text></svg></figure>'
    )
