"""What is added to a motion once it is found: its timing, and what other code finds of it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.recovery.question import Goal
from holdfast.recovery.recovery import Ending, Recovery
from holdfast.recovery.rows import Rows
from holdfast.recovery.space import Space
from holdfast.recovery.timing.motion import TimedMotion, timed_motion
from holdfast.recovery.verification import Verification, verify
from holdfast.recovery.waypoints import FIRST, parameter

if TYPE_CHECKING:
    from holdfast.paths.path import Path

Array = NDArray[np.float64]


def completed(
    ended: Recovery, space: Space, rows: Rows, aim: Goal | None, path: Path | None, pace: tuple[Array, float] | None
) -> Recovery:
    """A recovery that has a motion, verified, and timed where that is asked for.

    Args:
        ended: With its motion.
        space: In which it was planned.
        rows: That count.
        aim: The goal, if there is one.
        path: The tool path, if there is one.
        pace: Accelerations (n,), rad/s^2 and m/s^2, and the period of the timed motion, s.
    """
    leg = next((leg for leg in ended.legs if leg.name == "along the path"), None)
    places = None
    if leg is not None and ended.rest is not None:
        places = ended.rest.share, slice(leg.first, leg.last + 1)

    def found(q: Array, along: tuple[Array, slice] | None, times: tuple[Array, Array] | None = None) -> Verification:
        whole = ended.ending == Ending.HOME
        return verify(
            ended.degraded,
            ended.at,
            q,
            rows=rows,
            goals=None if aim is None or not whole else aim.poses,
            goal_q=None if aim is None or not whole else aim.q,
            along=None if path is None or along is None or not whole else (path, *along),
            keep=ended.keep,
            clearance=ended.clearance,
            margin=ended.margin,
            pace=times,
        )

    verified = found(ended.q, places)
    if pace is None:
        return replace(ended, verified=verified)
    name, at_speed = parameter(space.arm, ended.q)
    for cautious in (False, True):  # a corner whose rounding other code refuses is not rounded
        timed = timed_motion(
            space,
            ended.degraded,
            ended.q,
            accelerations=pace[0],
            period=pace[1],
            without=float(at_speed[-1]) if name == FIRST[0] else None,
            exact=[leg.last for leg in ended.legs],
            along=places,
            cautious=cautious,
        )
        again = found(timed.q, _on_path(timed), (timed.time, timed.accelerations))
        if again.ok:
            break
    return replace(ended, timed=timed, verified=verified.beside(again))


def _on_path(timed: TimedMotion) -> tuple[Array, slice] | None:
    """Places on the tool path of the rows that are there, and which rows; None if hardly any is."""
    some = np.flatnonzero(np.isfinite(timed.place))
    return (timed.place[some], slice(int(some[0]), int(some[-1]) + 1)) if len(some) > 1 else None
