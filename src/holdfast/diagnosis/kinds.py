"""Which joint it is and what it has: decided from what follows the alarm.

Source: derived here; the thresholds were set on simulated faults other than those that they were measured with.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.diagnosis.observer import SLIP
from holdfast.diagnosis.signals import tool_residual

Array = NDArray[np.float64]

ISOLATE, CLASSIFY = 0.020, 0.100  # s after the alarm, s after that
AGAIN, WATCHED = 0.5, 2.0  # s after the alarm: the tool's pose may still call it a sensor, and may name that
_SENSOR = 1.5  # of the tool's bound
_WORSE = 28.0  # in squares of deviations: another joint explains the tool's pose so much worse
_PUSHED = 8.0  # likewise a force at the tool explains the torques so much better than one joint
_SCALE = 0.25  # of the bound: a deviation of the residual torque
_STILL, _PART, _NOISY = 2e-3, 0.15, 12.0  # rad or m; of the reference's travel; deviations of the sensor
_ALL, _CARRIED = 0.93, (0.8, 1.2)  # losses: of the whole motor; that friction may hide
_TIMES = 2.0  # of dry friction: a torque that would move a joint that can move


@dataclass(frozen=True)
class Verdict:
    """What a monitor says.

    Attributes:
        alarm: Something is outside its bounds.
        time: Of the alarm, s; NaN without one.
        _: What follows is known 20 and 120 ms later.
        joint: Its name; None if no joint is to blame or it is not known yet.
        kind: ``locked``, ``standstill`` (locked, or free-swinging and held by friction), ``limp``, ``weak``, ``friction``,
            ``sensor`` (of the joint, or a clutch that slips), ``contact`` or ``unknown``.
        loss: Fraction of its torque that the motor lost; NaN where that is not the question.
        candidates: Kinds that remain possible.
        evidence: A phrase for each reason.
    """

    alarm: bool
    time: float = np.nan
    _: KW_ONLY
    joint: str | None = None
    kind: str = "unknown"
    loss: float = np.nan
    candidates: tuple[str, ...] = ()
    evidence: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False, kw_only=True)
class Window:
    """What follows an alarm, W samples of n joints; the rows before ``split`` isolate the joint, the rest its kind.

    Attributes:
        q, reference, v, residual, torque, gravity: (W, n); ``torque`` through both filters of the residual.
        z, y: (W, n) residual torque and tracking in units of their bounds.
        w: (V,) the tool's pose likewise, for half a second.
        pose_q, x, quat: (K, n), (K, 3), (K, 4) measured poses since the alarm and the joints there.
    """

    time: float
    split: int
    levels: tuple[str, ...]
    alarmed: tuple[str, ...]
    q: Array
    reference: Array
    v: Array
    residual: Array
    torque: Array
    gravity: Array
    z: Array
    y: Array
    w: Array
    pose_q: Array
    x: Array
    quat: Array


def decided(
    arm: Arm, window: Window, *, bound: Array, coulomb: Array, deviations: tuple[float, float], noise: float
) -> Verdict:
    """The verdict of an alarm.

    Args:
        arm: The arm.
        window: What follows the alarm.
        bound: (n,) of residual torques, N m and N.
        coulomb: (n,) dry friction, N m and N.
        deviations: Standard deviations of the tool's measured position, m, and angle, rad.
        noise: Standard deviation of a joint sensor, rad or m.
    """
    first = slice(0, window.split)
    seen = "tool" in window.levels and (window.alarmed == ("tool",) or bool(np.nanmax(window.w, initial=0.0) > _SENSOR))
    if seen:
        return _sensor(arm, window, deviations)
    both = [signal[first] for name, signal in (("torque", window.z), ("tracking", window.y)) if name in window.levels]
    size = np.nan_to_num(np.max(both, axis=0)).mean(axis=0)
    if "torque" in window.levels and _is_a_push(arm, window, bound):
        return Verdict(
            True, window.time, kind="contact", candidates=("contact",), evidence=("a force at the tool explains all rows",)
        )
    return _joint_fault(arm, window, int(size.argmax()), coulomb=coulomb, noise=noise, size=size)


def _sensor(arm: Arm, window: Window, deviations: tuple[float, float]) -> Verdict:
    """Of which joint the sensor would explain the tool's pose: ``c = -J_i b``."""
    evidence = ["the measured tool is not where the joints say"]
    joint = None
    if len(window.x) > 1:
        c = tool_residual(arm, window.pose_q, window.x, window.quat)
        weight = np.repeat(1 / np.array(deviations), 3)
        scaled, columns = c * weight, arm.jacobian(window.pose_q) * weight[:, None]
        along = np.einsum("ki,kij->kj", scaled, columns) ** 2 / np.maximum((columns**2).sum(axis=1), 1e-300)
        # What a joint leaves unexplained, running: each sample has an error of its own, for one that is frozen drifts away.
        left = np.cumsum((scaled**2).sum(axis=1)[:, None] - along, axis=0)
        gaps = np.diff(np.sort(left, axis=1)[:, :2], axis=1)[:, 0] if arm.n > 1 else np.full(len(left), np.inf)
        row = int((gaps > _WORSE).argmax()) if (gaps > _WORSE).any() else len(gaps) - 1
        order, worse = np.argsort(left[row]), float(gaps[row])
        if worse > _WORSE:
            joint = arm.joint_names[int(order[0])]
            evidence.append(f"the next joint explains its pose worse by {worse:.3g} squared deviations")
        else:
            evidence.append(f"{arm.joint_names[int(order[0])]} and {arm.joint_names[int(order[1])]} explain its pose alike")
    return Verdict(
        True, window.time, joint=joint, kind="sensor", candidates=("sensor", "slipping_clutch"), evidence=tuple(evidence)
    )


def _is_a_push(arm: Arm, window: Window, bound: Array) -> bool:
    """Whether a force at the tool explains the residual torques better than any joint alone."""
    mean = window.residual[: window.split].mean(axis=0) / (_SCALE * bound)
    columns = (arm.jacobian(window.q[window.split - 1])[:3] / (_SCALE * bound)).T
    force = np.linalg.lstsq(columns, mean, rcond=None)[0]
    by_force = ((mean - columns @ force) ** 2).sum()
    return bool(by_force + _PUSHED < (mean**2).sum() - (mean**2).max())


def _joint_fault(arm: Arm, window: Window, i: int, *, coulomb: Array, noise: float, size: Array) -> Verdict:
    rest = slice(min(window.split, len(window.q) - 1), None)
    travel, wanted = np.ptp(window.q[rest, i]), np.ptp(window.reference[rest, i])
    still = bool(travel < _STILL and travel < _PART * wanted + _NOISY * noise)
    others = np.delete(size, i)
    evidence = [f"its residuals are {size[i]:.3g} times their bounds, those of the next joint {others.max(initial=0.0):.3g}"]
    unit, after = arm.joints[i].unit, 1e3 * CLASSIFY
    evidence.append(f"within {after:.0f} ms it moved by {travel:.3g} {unit}, its reference by {wanted:.3g} {unit}")

    def verdict(kind: str, candidates: Sequence[str], loss: float = np.nan) -> Verdict:
        more = () if np.isnan(loss) else (f"its motor lost {loss:.0%} of its torque",)
        return Verdict(
            True,
            window.time,
            joint=arm.joint_names[i],
            kind=kind,
            loss=loss,
            candidates=tuple(candidates),
            evidence=(*evidence, *more),
        )

    unless_seen = () if "tool" in window.levels else ("sensor",)
    if "torque" not in window.levels:
        return verdict(*(("locked", ("locked", "standstill", *unless_seen)) if still else ("unknown", ())))
    r, torque, gravity = window.residual[rest, i], window.torque[rest, i], window.gravity[rest, i]
    slip = np.tanh(window.v[rest, i] / SLIP)
    power = float((torque**2).sum())
    loss = float(np.clip(-(r * torque).sum() / power, 0.0, 1.3)) if power > 0 else np.nan
    drag = max(0.0, -float((r * slip).sum()) / max(float((slip**2).sum()), 1e-12))
    whole = float((r**2).sum())
    by_loss, by_drag = float(((r + loss * torque) ** 2).sum()), float(((r + drag * slip) ** 2).sum())
    if still and np.abs(torque - gravity).max() >= _TIMES * coulomb[i]:
        hidden = _CARRIED[0] < loss < _CARRIED[1] and np.abs(gravity).min() < _TIMES * coulomb[i]
        if hidden:
            evidence.append("friction may hold it: gravity on it is small")
            return verdict("standstill", ("locked", "limp", *unless_seen), loss)
        return verdict("locked", ("locked", *unless_seen))
    if by_drag < by_loss and by_drag < 0.5 * whole:
        return verdict("friction", ("friction", "weak"))
    if by_loss < 0.5 * whole:
        return verdict("limp" if loss > _ALL else "weak", ("limp",) if loss > _ALL else ("weak", "friction"), loss)
    return verdict("unknown", ("weak", "friction", "reduced_range", "reduced_speed", *unless_seen))
