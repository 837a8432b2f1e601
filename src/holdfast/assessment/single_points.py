"""Single points of failure by structure: joints whose failure ends the task in every configuration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, plane_normal
from holdfast.errors import TaskError
from holdfast.grammar import TASKS
from holdfast.indices.determinants import RelativeManipulability
from holdfast.words import either, number

Array = NDArray[np.float64]

_DRAWS = 256
_MOST, _NAMED = 3, 4  # joints of a set, and sets that are named
_FLAT = 1e-10  # rho^2 of several joints is rounding noise, or that of 1.5708 for pi/2 in a file
_ZERO = 1e-7  # rho of a joint that the self-motion never moves is rounding noise, about 1e-15
_LITTLE = 0.01  # rho that is left where axes meet but for half a millimetre, or for the digits of pi/2 in a file


@dataclass(frozen=True, kw_only=True)
class Structure:
    """What locking each joint does to a task whatever the configuration.

    Attributes:
        task: Name of the task.
        redundancy: Joints minus rows; 0 or less means that any lock ends the task.
        fatal: Joints, indices from 0, without which the task is singular in every configuration.
        never: The healthy arm itself is singular for the task in every configuration.
        together: Sets of two and three joints that do so when they lock at once and no fewer of them do; of those alone that
            leave as many joints as the task has rows.
        nearly: Joints, indices from 0, whose lock leaves almost nothing, and the most of it that was found, above 0 and
            at most 0.01: axes that would meet but for the rounding or the calibration in the arm's file.
    """

    task: str
    redundancy: int
    fatal: tuple[int, ...]
    never: bool
    together: tuple[tuple[int, ...], ...] = ()
    nearly: tuple[tuple[int, float], ...] = ()

    @property
    def survives(self) -> bool:
        """True if no single lock ends the task by structure, or all but ends it."""
        return self.redundancy > 0 and not self.fatal and not self.nearly and not self.never


def structure(arm: Arm, task: str | Task | Sequence[str] = "pose") -> Structure:
    """Find the joints whose lock makes a task singular everywhere.

    A joint is one if its relative manipulability vanishes at each of 256 random configurations (seeded): a function that
    is analytic in q and zero there is zero everywhere, up to events of probability zero.
    """
    t = as_task(arm, task)
    redundancy = arm.n - t.m
    if redundancy <= 0:
        return Structure(task=t.name, redundancy=redundancy, fatal=tuple(range(arm.n)), never=False)
    generator = np.random.default_rng(20120514)
    # Not the joint limits: a narrow range could hide what another part of it shows.
    q = generator.uniform(-np.pi, np.pi, (_DRAWS, arm.n))
    index = RelativeManipulability(arm, t)
    result = index.evaluate(q)
    most = result.by_failure.max(axis=0)
    fatal = tuple(np.flatnonzero(most < _ZERO).tolist())
    nearly = tuple((int(k), float(most[k])) for k in np.flatnonzero((most >= _ZERO) & (most <= _LITTLE)))
    never = bool((result.value == 0).all() and (result.by_failure == 0).all())
    together = () if never else _together(index.task_jacobian(q), fatal)
    return Structure(task=t.name, redundancy=redundancy, fatal=fatal, never=never, together=together, nearly=nearly)


def _together(jacobians: Array, fatal: tuple[int, ...]) -> tuple[tuple[int, ...], ...]:
    """Least sets of two and three joints whose minors of the null-space projector vanish for all Jacobians (N, m, n)."""
    m, n = jacobians.shape[1:]
    rows = np.linalg.svd(jacobians)[2][:, :m]
    projector = np.eye(n) - np.swapaxes(rows, 1, 2) @ rows
    found = [frozenset({k}) for k in fatal]
    for size in range(2, min(_MOST, n - m) + 1):
        for some in combinations(range(n), size):
            if any(less <= set(some) for less in found):
                continue
            if np.linalg.det(projector[:, some][:, :, some]).max() < _FLAT:
                found.append(frozenset(some))
    return tuple(tuple(sorted(s)) for s in found if len(s) > 1)


def structures(arm: Arm) -> list[Structure]:
    """The structure of every task that the arm's kind of motion has, the most demanding first."""
    flat = plane_normal(arm) is not None
    found = []
    for name in sorted((name for name in TASKS if name.startswith("planar") == flat), key=TASKS.__getitem__, reverse=True):
        try:
            found.append(structure(arm, name))
        except TaskError:
            continue
    return found


def explain(arm: Arm, found: Structure, others: list[Structure]) -> str:
    """One or two sentences for people about one task, with the tasks that do survive."""
    survivors = [s.task for s in others if s.survives and s.task != found.task]
    instead = f" A task that every single lock leaves possible: {', '.join(survivors)}." if survivors else ""
    if found.never:
        return f"'{arm.name}' can never do task '{found.task}': it is singular in every configuration.{instead}"
    if found.redundancy <= 0:
        return f"'{arm.name}' is not redundant for task '{found.task}': any locked joint ends it.{instead}"
    if not found.fatal and not found.nearly:
        sets = [" + ".join(arm.joint_names[k] for k in s) for s in found.together]
        more = f" and {len(sets) - _NAMED} more" if len(sets) > _NAMED else ""
        also = f" Sets whose locks together end it in every configuration: {', '.join(sets[:_NAMED])}{more}." if sets else ""
        return f"No single joint of '{arm.name}' is a point of failure by structure for task '{found.task}'.{also}"
    parts = []
    if found.fatal:
        parts.append(
            f"Single point of failure by structure: once {_either(arm, found.fatal)} locks, '{arm.name}' is singular for task "
            f"'{found.task}' in every configuration, however well it is chosen."
        )
    for k, left in found.nearly:
        parts.append(
            f"All but a single point of failure by structure: once {_either(arm, [k])} locks, '{arm.name}' has at most "
            f"{number(left)} of its manipulability for task '{found.task}' left, at each of {_DRAWS} random configurations."
        )
    return " ".join(parts) + instead


def _either(arm: Arm, joints: Sequence[int]) -> str:
    return either([f"{arm.joint_names[k]} (joint {k + 1})" for k in joints])
