"""One arm and one task: the numbers that RESULTS.md is made of, kept as JSON."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any, Literal

import numpy as np

import holdfast as hf
from holdfast.control import Law

ARMS = ("panda", "xarm7", "iiwa14")
TASKS = ("position", "pose")
DAMPING, PRE_FAILURE = 0.1, 0.5
TIME_LIMIT = 1000.0  # 1/Ke
SEED = 1
COSTS: tuple[Literal["deviation", "angle", "time"], ...] = ("deviation", "angle", "time")


def laws(arm: hf.Arm, task: str) -> list[Law]:
    """The laws compared, the pseudoinverse first."""
    return [
        hf.control.pseudoinverse(arm, task),
        hf.control.damped(arm, DAMPING, task),
        hf.control.failure_tolerant(arm, task, PRE_FAILURE),
    ]


def part(name: str, task: str, motions: int, folder: Path, seed: int = SEED) -> dict[str, Any]:
    """What was found for an arm and a task: read if it is there, else run."""
    arm = hf.arms.load(name)
    file = folder / f"{name}-{task}-{motions}-{seed}-{arm.fingerprint[:10]}.json"
    if file.exists():
        return dict(json.loads(file.read_text(encoding="utf-8")))
    begun = time.perf_counter()
    drawn = hf.point_to_point(arm, motions, seed=seed)
    c = hf.compare_laws(laws(arm, task), drawn.q0, drawn.target, time_limit=TIME_LIMIT)
    found: dict[str, Any] = {
        "arm": name,
        "task": task,
        "motions": motions,
        "distance": np.quantile(drawn.distance, (0.05, 0.5, 0.95)).tolist(),
        "names": list(c.names),
        "joints": list(c.joints),
        "outcomes": c.table,
        "gains": [row | _error_changes(c, row["law"], row["failure"]) for row in c.to_dict()["gains"]],
        "bounds": {n: [c.gain(n, undecided="against").low, c.gain(n, undecided="for").high] for n in c.names[1:]},
        "any": {n: _any(c, n) for n in c.names},
        "cost": {n: {of: c.cost(n, of).tolist() for of in COSTS} for n in c.names},
        "comparable": int(c.comparable.sum()),
        "reasons": {n: c.reasons(n) for n in c.names},
    }
    found["seconds"] = time.perf_counter() - begun
    folder.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(found), encoding="utf-8")
    return found


def _error_changes(c: hf.LawComparison, law: str, failure: str) -> dict[str, float]:
    """Return the mean changes of the error, and of the error above the least possible, as norms over metres and radians."""
    errors: tuple[Literal["error", "excess"], ...] = ("error", "excess")
    changes = {of: c.change(law, of, failure) for of in errors}
    ends = {"": "value", "_low": "low", "_high": "high"}
    return {f"{of}{end}": getattr(change, name) for of, change in changes.items() for end, name in ends.items()}


def _any(c: hf.LawComparison, name: str) -> dict[str, float]:
    """Shares over all joints, each as likely to lock as any other."""
    arrived = c.share_any(name)
    code, past = c.pool_values(name, "code"), c.pool_values(name, "past_limits")
    reachable, error = c.pool_values(name, "reachable"), c.pool_values(name, "error")
    done = code == 0
    return {
        "converged": arrived.value,
        "low": arrived.low,
        "high": arrived.high,
        "stuck": float((code == 1).mean()),
        "moving": float((code == 2).mean()),
        "undecided": float((code == 3).mean()),
        "open": float(((code == 3) & reachable).mean()),
        "reachable": float(reachable.mean()),
        "of_reachable": float(done[reachable].mean()) if reachable.any() else float("nan"),
        "within_limits": float((done & ~past).mean()),
        "past_limits": float(past.mean()),
        "astray": float(np.nanmedian(error[~done])) if (~done).any() else float("nan"),
        "astray_90": float(np.nanquantile(error[~done], 0.9)) if (~done).any() else float("nan"),
    }
