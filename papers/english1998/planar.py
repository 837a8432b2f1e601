"""Sections VI-A and VI-B: the planar arm, three unit links."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
from holdfast.kinematics.indices.susceptibility import Susceptibility
from holdfast.kinematics.path_following import Curvature
from holdfast.kinematics.paths import Constant, TimedPath, line
from holdfast.kinematics.solvers import best_path_over, fibres, self_motion
from holdfast.model.arm import as_task

Array = NDArray[np.float64]

POINT = (0.6, -1.9)  # Fig. 4
LINE = (1.8, -1.8)  # Fig. 5: x at the right end (the left end is its mirror image) and y; our assumption
SWING_LINE = (1.9, -0.09)  # Figs. 6 to 8; our assumption
# Other lines whose worst normalised swing criterion is 2.1 %, found by search; the paper does not print its own.
SWING_LINES = (
    (1.2, 0.736),
    (1.5, 0.479),
    (1.7, 0.239),
    (1.8, 0.089),
    SWING_LINE,
    (2.0, -0.317),
    (2.1, -0.639),
    (2.1, -1.712),
    (2.0, -1.988),
    (1.9, -2.171),
)
DURATION = 10.0  # s, at constant speed
SAMPLES = 1001
TORQUE_GAIN, SWING_GAIN = 800.0, 2000.0  # see RESULTS.md: what smaller and larger gains do
CAP = 1.0  # rad/s
SEED = 1


@dataclass(frozen=True)
class Planar:
    """The arm without joint limits, and the two normalised criteria: their largest value over all configurations is 1."""

    arm: hf.Arm
    torque: Susceptibility
    swing: Susceptibility

    @classmethod
    def load(cls) -> Planar:
        """The built-in arm, unit masses and centres of mass in the middle of the links."""
        arm = hf.arms.load("planar-3r").without_limits
        largest = hf.susceptibility.largest_static_torque(arm)
        torque = hf.susceptibility.torque(arm, 1 / (3 * largest**2))
        return cls(arm, torque, hf.susceptibility.swing_angle(arm, np.array([0, 1, 0]) / np.pi**2))

    @cached_property
    def largest(self) -> Array:
        """(3,) largest static torques, N m."""
        return 1 / np.sqrt(3 * np.diag(self.torque.weights))

    def run(self, measure: Susceptibility, x: float, y: float, to_left: bool = True, **options: object) -> hf.Trajectory:
        """Along the line from x to -x, or back, 10 s at constant speed."""
        way = 1 if to_left else -1
        path = TimedPath(line([way * x, y, 0], [-way * x, y, 0]), Constant(DURATION))
        settings = {"task": "planar", "samples": SAMPLES, "seed": SEED} | options
        return hf.follow(self.arm, path, minimise=measure, **settings)  # type: ignore[arg-type]

    def joints(self, q: Array) -> Array:
        """(..., 4, 2) places of the base, the joints and the end effector, m."""
        direction = np.cumsum(q, axis=-1)
        steps = np.stack([np.cos(direction), np.sin(direction)], axis=-1)
        return np.concatenate([np.zeros_like(steps[..., :1, :]), np.cumsum(steps, axis=-2)], axis=-2)


def pose(x: float, y: float) -> Array:
    """A pose of the end effector at a point."""
    out = np.eye(4)
    out[:2, 3] = x, y
    return out


@dataclass(frozen=True)
class Extremes:
    """Best and worst configuration of a point: by optimisation, and by tracing all its configurations."""

    best: Array
    worst: Array
    values: tuple[float, float]
    traced: tuple[float, float]


def extremes(planar: Planar, measure: Susceptibility, x: float, y: float) -> Extremes:
    """Fig. 4 for any measure and point."""
    q = [hf.optimise(planar.arm, pose(x, y), m, seed=SEED, task="planar").q for m in (measure, measure.reversed())]
    every = measure(self_motion(planar.arm, pose(x, y), "planar", spacing=0.01).q)
    return Extremes(q[0], q[1], (float(measure(q[0])), float(measure(q[1]))), (float(every.min()), float(every.max())))


@dataclass(frozen=True)
class Global:
    """The best of all configurations of each pose of a motion, and the best motions through them with limited joint rates."""

    x: Array
    value: Array
    motions: dict[float, Array]


def global_answer(
    planar: Planar, measure: Susceptibility, motion: hf.Trajectory, rates: Sequence[float], count: int = 101
) -> Global:
    """Dynamic programming over all configurations of ``count`` poses of the motion, joints up to each of the rates, rad/s."""
    few = np.linspace(0, len(motion.time) - 1, count).astype(int)
    curves = fibres(planar.arm, motion.poses[few], "planar", spacing=0.02, seed=SEED)
    step = DURATION / (count - 1)
    found = {rate: best_path_over(planar.arm, curves, measure, rate_limit=rate * step) for rate in rates}
    any_of_them = found[rates[0]].global_value
    return Global(motion.poses[few, 0, 3], any_of_them, {rate: path.value for rate, path in found.items()})


# ---- the rule about the borders of the region of zero cost -------------------------------------------------------------

_DIRECTIONS = np.linspace(-np.pi, np.pi, 1501)
_BISECTIONS = 34


@dataclass(frozen=True)
class Border:
    """Where the region of zero cost ends on a horizontal line.

    Attributes:
        x, y: The place, m.
        curvature: Of the normalised criterion along the self-motion there, against that at the best configuration of the
            nearest point of the scan outside the region.
        reach: Smallest singular value of the arm's Jacobian there.
    """

    x: float
    y: float
    curvature: float
    reach: float


class Borders:
    """Borders of the region in which joint two need not swing, in closed form and by bisection: no controller in between."""

    def __init__(self, planar: Planar) -> None:
        self.planar = planar
        self.curvature = Curvature(planar.swing, as_task(planar.arm, "planar"))

    def configurations(self, x: float, y: float, direction: Array, elbow: int) -> Array:
        """(N, 3) with the last link in given directions (N,): the triangle of the first two links; NaN where it is open."""
        wrist = np.stack([x - np.cos(direction), y - np.sin(direction)])
        cosine = (np.einsum("in,in->n", wrist, wrist) - 2) / 2
        second = elbow * np.arccos(np.where(np.abs(cosine) <= 1, cosine, np.nan))
        first = np.arctan2(wrist[1], wrist[0]) - np.arctan2(np.sin(second), 1 + np.cos(second))
        return np.stack([first, second, direction - first - second], axis=1)

    def swing(self, q: Array) -> Array:
        """Swing angle of joint two (N,), NaN where q is."""
        return self.planar.swing.by_joint(q)[:, 1]

    def closest(self, x: float, y: float) -> tuple[float, Array]:
        """The smallest swing of the point, and its configuration; 0 or less where there is one without swing."""
        from scipy.optimize import minimize_scalar

        found = []
        for elbow in (1, -1):
            angles = self.swing(self.configurations(x, y, _DIRECTIONS, elbow))
            k = int(np.nanargmin(np.abs(angles)))
            found.append((abs(angles[k]), angles[k], k, elbow))
        _, angle, k, elbow = min(found)
        sign = np.sign(angle)

        def signed(direction: float) -> float:
            value = sign * float(self.swing(self.configurations(x, y, np.array([direction]), elbow))[0])
            return value if np.isfinite(value) else np.pi

        window = 2 * (_DIRECTIONS[1] - _DIRECTIONS[0])
        near = (_DIRECTIONS[k] - window, _DIRECTIONS[k] + window)
        least = minimize_scalar(signed, bounds=near, method="bounded", options={"xatol": 1e-12})
        return float(least.fun), self.configurations(x, y, np.array([least.x]), elbow)[0]

    def on_line(self, y: float, count: int = 31) -> list[Border]:
        """All borders on the right half of a horizontal line; the left half is its mirror image."""
        xs = np.linspace(0, np.sqrt(9 - y * y) - 0.02, count)
        zero = np.array([self.closest(x, y)[0] <= 0 for x in xs])
        out = []
        for k in np.flatnonzero(zero[1:] != zero[:-1]):
            inside, outside = (xs[k], xs[k + 1]) if zero[k] else (xs[k + 1], xs[k])
            beyond = self.closest(outside, y)[1]
            for _ in range(_BISECTIONS):
                middle = (inside + outside) / 2
                if self.closest(middle, y)[0] <= 0:
                    inside = middle
                else:
                    outside = middle
            q = self.closest(outside, y)[1]
            here, there = self.curvature.smallest(np.stack([q, beyond]))
            reach = np.linalg.svd(self.planar.arm.jacobian(q)[:2], compute_uv=False)[-1]
            out.append(Border(float(outside), y, float(abs(here / there)), float(reach)))
        return out
