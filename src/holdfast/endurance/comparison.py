"""What other motions along the same path survive: least norm, gradient projection of a measure, and its best at every pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from holdfast.endurance.endurance import Compared, Endurance
from holdfast.endurance.problem import Problem
from holdfast.errors import InputError
from holdfast.indices.determinants import relative_manipulability
from holdfast.indices.objective import Objective
from holdfast.motion.tracking import follow
from holdfast.motion.trajectory import Trajectory

Array = NDArray[np.float64]

LEAST_NORM = "least-norm"


def beside(problem: Problem, best: Endurance, others: Sequence[Objective | str], seed: int) -> Endurance:
    """The result with the others beside it, each from its own best start.

    Raises:
        InputError: An unknown word, or a measure of another arm.
    """
    found: list[Compared] = []
    for other in others:
        if isinstance(other, str):
            if other != LEAST_NORM:
                raise InputError(f"compare holds '{other}'; give '{LEAST_NORM}', or a measure such as relative manipulability")
            plain = _followed(problem, relative_manipulability(problem.arm, problem.task), "none", False, seed)
            found.append(_judged(problem, "least norm", plain.q))
            continue
        local = _followed(problem, other, "gradient-projection", True, seed)
        found.append(_judged(problem, f"gradient projection of {other.name}", local.q))
        assert local.best_path is not None
        found.append(_judged(problem, f"best continuous {other.name}", local.best_path))
    return replace(best, beside=tuple(found))


def _followed(problem: Problem, objective: Objective, method: str, best: bool, seed: int) -> Trajectory:
    aim = {"minimise" if objective.better == "smaller" else "maximise": objective}
    kept, margin = problem.kept or (None, 0.0)
    return follow(
        problem.arm,
        problem.path,
        **aim,  # type: ignore[arg-type]
        method=method,  # type: ignore[arg-type]
        task=problem.task,
        samples=len(problem.time),
        best=best,
        seed=seed,
        clearance=kept,
        margin=margin,
    )


def _judged(problem: Problem, name: str, q: Array) -> Compared:
    """What a motion survives; where it is off the path nothing is."""
    off = problem.off(q)
    survives = problem.judge(np.where(off[:, None], np.nan, q))
    made = Endurance.of(problem, q, survives=survives)
    return Compared(name=name, survival=made.survival, curve=made.curve(), off=float(off.mean()))
