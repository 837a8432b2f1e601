"""What a motion will show of locks, before it is made: which joints, how soon, and which not from which."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.diagnosis.bounds import Bounds
from holdfast.diagnosis.foresight.delay import expected_delays
from holdfast.diagnosis.foresight.motions import resampled
from holdfast.diagnosis.foresight.probe import RATE
from holdfast.diagnosis.foresight.separation import separations, together, unseen
from holdfast.diagnosis.sensors import Sensors
from holdfast.errors import InputError
from holdfast.notice import says
from holdfast.result import Result

Array = NDArray[np.float64]

_ONSETS = 40  # times along the motion at which a joint may lock
_BANDWIDTH = 2 * np.pi * 10  # rad/s, of servos that nobody described
_MOVES = 2.0  # times dry friction: so much gravity moves a joint whose motor is dead


@dataclass(frozen=True, eq=False, kw_only=True)
class Observability(Result):
    """What a motion shows of locks. Hypothesis 0 is that nothing is locked.

    Attributes:
        arm: The arm.
        duration: s, of the motion.
        separation: (n + 1, n + 1) of hypotheses by the tool's measured pose, the lock there from the beginning; above 9.2 they
            can be told apart.
        delays: (K, n) s from a lock at one of K times of the motion to its alarm by joint sensors and torques, infinite where
            there is none; None without bounds.
        strayed: (K, n) m, how far the tool is from where it should be then.
        alike: Joints whose lock looks like a dead motor that friction holds; None without bounds.
    """

    arm: Arm
    duration: float
    separation: Array
    delays: Array | None
    strayed: Array | None
    alike: tuple[str, ...] | None

    @cached_property
    def unseen(self) -> tuple[str, ...]:
        """Joints whose lock the tool's pose does not show."""
        return tuple(self.arm.joint_names[i] for i in unseen(self.separation, range(self.arm.n)))

    @cached_property
    def together(self) -> tuple[tuple[str, str], ...]:
        """Pairs of joints whose locks the tool's pose shows and does not tell apart."""
        names = self.arm.joint_names
        return tuple((names[i], names[j]) for i, j in together(self.separation, range(self.arm.n)))

    def describe(self) -> list[str]:
        """Seen or not, by the tool's pose and by the joints; what stays together."""
        names, n = self.arm.joint_names, self.arm.n
        seen = f"{n - len(self.unseen)} of {n} joints"
        lines = [f"the tool's pose alone shows the lock of {seen} on this motion of {self.duration:.3g} s"]
        lines += [f"not shown: {', '.join(self.unseen)}"] if self.unseen else []
        lines += [f"locks of {a} and {b} cannot be told apart" for a, b in self.together]
        if self.delays is not None and self.strayed is not None:
            found = np.isfinite(self.delays)
            for k, name in enumerate(names):
                here = found[:, k]
                if not here.any():
                    lines.append(f"a lock of {name} would not be noticed by joint sensors or torques")
                    continue
                late, far = np.median(self.delays[here, k]), np.median(self.strayed[here, k])
                lines.append(
                    f"a lock of {name} is noticed after {1e3 * late:.3g} ms, with the tool {1e3 * far:.2g} mm off (medians; "
                    f"{here.mean():.0%} of the times at which it may lock)"
                )
        if self.alike:
            lines.append(f"locked and free-swinging look alike, for gravity is small: {', '.join(self.alike)}")
        return lines


@checked
@says("looking ahead")
def observe(
    arm: Arm,
    motion: ArrayLike,
    *,
    rate: float = 1000.0,
    sensors: Sensors | None = None,
    bounds: Bounds | None = None,
    stiffness: ArrayLike | None = None,
    damping: ArrayLike | None = None,
) -> Observability:
    """What a motion will show of locks of single joints, before it is made.

    Args:
        arm: The arm.
        motion: (T, n) references, rad and m.
        rate: Samples a second.
        sensors: How good the tool's measured pose is; 100 samples a second of it are counted.
        bounds: Of the healthy arm: then also how soon joint sensors and torques notice.
        stiffness: (n,) of the servos, N m/rad and N/m; those of 10 Hz if not given.
        damping: (n,) N m s/rad and N s/m, likewise.

    Raises:
        InputError: Another number of joints, fewer than two samples, bounds of another arm, or only one of stiffness
            and damping.
        ArmError: With bounds and without stiffness, if inertial data are missing or impossible.

    Source: derived here; see :func:`holdfast.diagnosis.expected_delays` and :func:`holdfast.diagnosis.plan_probe`.
    """
    q = arm.check_configurations(motion)
    if q.ndim != 2 or len(q) < 2 or not rate > 0:
        raise InputError(
            f"motion has shape {q.shape} at {rate:g} Hz; it must be two configurations or more, and a rate above 0"
        )
    if (stiffness is None) != (damping is None):
        raise InputError("only one of stiffness and damping is given; give both, or neither")
    some, duration = resampled(q, rate, RATE) if rate > RATE else q, (len(q) - 1) / rate
    delays = strayed = alike = None
    if bounds is not None:
        bounds.require(arm, bounds.rate)
        q = resampled(q, rate, bounds.rate)
        torques = bool(np.isfinite(bounds.torque).all())
        if stiffness is None and torques:
            inertia = arm.inertia_diagonal(some).max(axis=0)
            stiffness, damping = _BANDWIDTH**2 * inertia, 2 * _BANDWIDTH * inertia
        elif stiffness is None:
            stiffness = damping = np.zeros(arm.n)
        onsets = np.unique(np.linspace(0, 0.9 * (len(q) - 2), _ONSETS).astype(int))
        delays = np.array(
            [expected_delays(bounds, q, stiffness=stiffness, damping=damping, onset=k / bounds.rate) for k in onsets]  # type: ignore[arg-type]
        )
        strayed = _strayed(arm, q, onsets, np.where(np.isfinite(delays), delays, 0.0) * bounds.rate)
        if torques:
            least = np.abs(arm.gravity_torque(some)).max(axis=0) < _MOVES * bounds.coulomb
            alike = tuple(name for name, small in zip(arm.joint_names, least, strict=True) if small)
    return Observability(
        arm=arm,
        duration=duration,
        separation=separations(arm, some, sensors or Sensors()),
        delays=delays,
        strayed=strayed,
        alike=alike,
    )


def _strayed(arm: Arm, q: Array, onsets: NDArray[np.int64], later: Array) -> Array:
    """(K, n) m, the tool off its way so many samples after each joint locked."""
    out = np.zeros(later.shape)
    for k, onset in enumerate(onsets):
        rows = np.minimum(onset + np.round(later[k]).astype(int), len(q) - 1)
        locked = q[rows].copy()
        np.fill_diagonal(locked, q[onset])
        apart = arm.forward_kinematics(locked)[:, :3, 3] - arm.forward_kinematics(q[rows])[:, :3, 3]
        out[k] = np.linalg.norm(apart, axis=1)
    return out
