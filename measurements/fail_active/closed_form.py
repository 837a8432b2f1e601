"""Bar F2 against ssik (closed forms of a Panda's whole self-motions): ``python -m measurements.fail_active.closed_form SUITE``.

Reads the lines and drawers of a suite's folder, asks ``recover`` again, and looks whether ssik knows better: where a path is
proved infeasible, whether at every one of its poses there is a configuration with the locks, within the ranges and clear of
all bodies. If so a proof that some pose has none is wrong; a proof that these do not hang together is not. Needs
``pip install ssik==8.2.0``, of whose 210 MB nothing else has a use, so it is in no group.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import ssik
from numpy.typing import NDArray

import holdfast as hf

Array = NDArray[np.float64]

POSES = 21, 401  # of a path, one after the other
ALONG = 721  # of a chart, before roots are looked for
NEAR = 1e-7  # rad: a lock is met, a limit is kept


def main() -> None:
    """A line for each task: cases, proofs, by kind, and contradictions."""
    folder = Path(sys.argv[1])
    cases = [json.loads(line) for line in (folder / "cases.jsonl").read_text().splitlines()]
    arm = hf.arms.load("panda")
    closed = ssik.Manipulator.from_prebuilt("franka_panda_ik")
    to_tip = _tip(arm, closed)
    cell = hf.Cell.load(sys.argv[2]) if len(sys.argv) > 2 else None
    clear = hf.Clearance(arm, cell=cell)
    for task in ("line", "drawer"):
        some = [case for case in cases if case["task"] == task and bool(case["cell"]) == (cell is not None)]
        told: Counter[str] = Counter()
        for k, case in enumerate({case["digest"]: case for case in some}.values()):
            told.update(_case(arm, closed, to_tip, clear, case))
            print(f"{task}: {k + 1}, {dict(told)}", file=sys.stderr)
        print(
            f"| {task}{', in the cell' if cell else ''} | "
            + ", ".join(f"{n} {what}" for what, n in sorted(told.items()))
            + " |"
        )


def _case(arm: hf.Arm, closed: Any, to_tip: Array, clear: hf.Clearance, case: dict[str, Any]) -> list[str]:
    ranges = {name: tuple(limits) for name, limits in case["range"].items()}
    degraded = hf.Degraded(arm, locked=case["locked"], ranges=ranges, speeds=case["speed"])
    path = hf.paths.line(*np.array(case["path"]))
    settings: Any = {"task": "pose", "clearance": clear, "samples": 0, "time_limit": 10.0, "seed": 1}
    answer = hf.recover(arm, degraded, case["at"], goal=None, path=path, **settings)
    verdict = answer.verdict
    if verdict.answer != "proved infeasible":
        return [verdict.answer]
    kind = f"proved ({verdict.kind})"
    for count in POSES:
        poses = path.pose(np.linspace(path.bounds[0], path.bounds[-1], count))
        if not all(_exists(closed, pose @ to_tip, degraded, clear) for pose in poses[::-1]):
            return [kind, f"{kind}: a pose has none by ssik"]
    return [kind, f"{kind}: ssik has one at each of {POSES[-1]} poses"]


def _tip(arm: hf.Arm, closed: Any) -> Array:
    """From the pose of our end effector to that of ssik's, the same for every configuration."""
    q = np.random.default_rng(0).uniform(arm.lower, arm.upper, (5, arm.n))
    apart = np.array([np.linalg.inv(arm.forward_kinematics(x)) @ closed.fk(x) for x in q])
    assert np.ptp(apart, axis=0).max() < 1e-9, "ssik's Panda is another one"
    return np.asarray(apart[0])


def _exists(closed: Any, pose: Array, degraded: hf.Degraded, clear: hf.Clearance) -> bool:
    """Whether a clear configuration of the pose has the locks and keeps the limits."""
    locked = np.flatnonzero(~degraded.moves)
    low, high = degraded.limited.lower, degraded.limited.upper
    for chart in closed.self_motion(pose):
        for begin, end in chart.domain:
            t = np.linspace(begin, end, ALONG)
            q = np.array(chart.q(t))
            if locked.size:
                off = _wrapped(q[:, locked[0]] - degraded.lo[locked[0]])
                turns = np.flatnonzero((off[:-1] * off[1:] <= 0) & (abs(off[:-1] - off[1:]) < 1))
                q = np.array([_root(chart, t[k], t[k + 1], locked[0], degraded.lo[locked[0]]) for k in turns]).reshape(
                    -1, q.shape[1]
                )
            q = q[np.isfinite(q).all(axis=1)]
            if not len(q):
                continue
            q = low + np.mod(q - low + NEAR, 2 * np.pi) - NEAR  # joints of a Panda turn less than once
            good = (q <= high + NEAR).all(axis=1)
            if locked.size:
                good &= (abs(_wrapped(q[:, locked] - degraded.lo[locked])) < 1e-5).all(axis=1)
            if good.any() and clear.sign(q[good]).any():
                return True
    return False


def _root(chart: Any, a: float, b: float, joint: int, value: float) -> Array:
    """The configuration between two places of a chart where a joint has a value, by bisection."""
    below = _wrapped(np.array(chart.q(a))[joint] - value) < 0
    for _ in range(60):
        middle = (a + b) / 2
        if (_wrapped(np.array(chart.q(middle))[joint] - value) < 0) == below:
            a = middle
        else:
            b = middle
    return np.array(chart.q((a + b) / 2))


def _wrapped(angle: Any) -> Any:
    return np.mod(angle + np.pi, 2 * np.pi) - np.pi


if __name__ == "__main__":
    main()
