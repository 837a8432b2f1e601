"""Planar arms with the largest failure-tolerant workspace: link lengths and artificial limits together."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.designs.evolution.annuli import ring_area
from holdfast.designs.evolution.found import EvolvedDesign
from holdfast.designs.evolution.strategy import evolved
from holdfast.designs.space import DesignSpace, Vary, design_space
from holdfast.errors import InputError
from holdfast.notice import Count, says
from holdfast.reach.closed_form import ThreeLinks, area

Array = NDArray[np.float64]

_POPULATION = 24
_SAMPLES, _LAST_SAMPLES = 9, 81  # of each range of a joint
_RADII, _LAST_RADII = 20, 1600
_TURN = 2 * np.pi


@checked
@says("searching designs")
def design_for_workspace(
    arm: Arm, vary: Vary, *, keep_reach: bool = True, generations: int = 250, restarts: int = 3, seed: int = 0
) -> EvolvedDesign:
    """Search the link lengths of a planar arm, with artificial limits, for the largest failure-tolerant workspace.

    A point is in the workspace if the arm reaches it within artificial limits and, whatever joint locks at whatever angle
    within them, the others, then without limits, still reach it (:func:`holdfast.tolerant_workspace`). Joints 1 and 2 have
    no artificial limits; of arms of three joints those with limits of every joint are searched, too.

    Args:
        arm: Planar, of three or more revolute joints that turn all the way.
        vary: Link lengths and their bounds, m: ``{"a1": (0.2, 2.0), ...}``.
        keep_reach: The varied lengths keep their sum.
        generations: Of each search.
        restarts: Searches.
        seed: Of all draws.

    Raises:
        InputError: An arm or a parameter of another kind, or counts below 1.

    Source: Lewis and Maciejewski 1997 for the workspace; search and bound derived here (``docs/ceilings.md``).
    """
    begin = time.monotonic()
    if generations < 1 or restarts < 1:
        raise InputError(f"generations is {generations} and restarts {restarts}; give at least 1")
    links = _Links(design_space(arm, vary), keep_reach)
    kinds: list[_Areas] = [_rings, *([_all_limits] if arm.n == 3 else [])]
    rng, history = np.random.default_rng(seed), list[float]()
    best, given = (0.0, links.space.start, np.tile([-np.pi, np.pi], (arm.n, 1))), 0.0
    with Count("generations", len(kinds) * (restarts + 1) * generations) as step:

        def tell(least: float) -> bool:
            step(1)
            history.append(max(-least, history[-1] if history else 0.0))
            return False

        for areas in kinds:
            for restart in range(restarts + 1):
                fixed = restart == 0  # the given lengths: what limits alone give
                size = len(links.space.start)
                angles = 2 * (arm.n - 2) if areas is _rings else 5
                start = np.concatenate([links.space.draw(1, int(rng.integers(1 << 30)))[0], rng.uniform(-1, 1, angles)])
                width = np.concatenate([(links.space.upper - links.space.lower) / 4, np.full(angles, 1.0)])

                def cost(x: Array, areas: _Areas = areas, fixed: bool = fixed, size: int = size, fine: bool = False) -> Array:
                    values, beyond = links.values(np.tile(links.space.start, (len(x), 1)) if fixed else x[:, :size])
                    return np.where(beyond > 0, beyond, -areas(links.lengths(values), x[:, size:], fine)[0])

                x, _ = evolved(cost, start, width, population=_POPULATION, generations=generations, rng=rng, tell=tell)
                value = -float(cost(x[None], fine=True)[0])
                values, _ = links.values(links.space.start[None] if fixed else x[None, :size])
                given = max(given, value) if fixed else given
                if value > best[0]:
                    best = value, values[0], areas(links.lengths(values), x[None, size:], True)[1][0]
    return EvolvedDesign(
        space=links.space,
        objective="tolerant-workspace",
        values=best[1],
        value=best[0],
        given=given,
        bound=links.bound,
        limits=best[2] - links.offset[:, None],
        history=np.array(history),
        seed=seed,
        seconds=time.monotonic() - begin,
    )


_Areas = Callable[[Array, Array, bool], tuple[Array, Array]]


def _rings(lengths: Array, angles: Array, fine: bool) -> tuple[Array, Array]:
    """Areas (P,), and limits (P, n, 2) of the link angles, from middles and halves of the ranges of joints 3 to n."""
    count, n = lengths.shape
    middle, half = angles[:, : n - 2], np.minimum(abs(angles[:, n - 2 :]), np.pi)
    limits = np.tile([-np.pi, np.pi], (count, n, 1))
    limits[:, 2:] = np.stack([middle - half, middle + half], axis=2)
    return ring_area(lengths, limits[:, 2:], _LAST_SAMPLES if fine else _SAMPLES), limits


def _all_limits(lengths: Array, angles: Array, fine: bool) -> tuple[Array, Array]:
    """The same of three joints, from halves and, of joints 2 and 3, middles of all ranges."""
    half = np.minimum(abs(angles[:, [0, 2, 4]]), np.pi)
    middle = np.column_stack([np.zeros(len(angles)), angles[:, [1, 3]]])
    limits = np.stack([middle - half, middle + half], axis=2)
    arms = [ThreeLinks(each, np.zeros(2), np.zeros(3), np.ones(3)) for each in lengths]
    found = [area(arm, pair[None], _LAST_RADII if fine else _RADII)[0] for arm, pair in zip(arms, limits, strict=True)]
    return np.array(found), limits


class _Links:
    """The link lengths of the designs of a space.

    Attributes:
        space: What varies.
        offset: (n,) angle of each link where its joint is at 0, rad.
        bound: No arm whose first joint has no limits has a larger workspace.
    """

    def __init__(self, space: DesignSpace, keep_reach: bool) -> None:
        rows, tool, arm = space.table.rows, space.table.tool, space.arm
        flat = all(r.type == "revolute" and abs(np.sin(r.alpha / 2)) < 1e-9 and r.a > 0 for r in rows)
        if arm.n < 3 or not flat or np.linalg.norm(tool[:3, 3]) > 1e-9 or not (arm.upper - arm.lower >= _TURN - 1e-9).all():
            raise InputError(
                f"'{arm.name}' is no planar arm of three or more revolute joints that turn all the way, whose tool is the end "
                "of its last link; a failure-tolerant workspace is maximised for those"
            )
        other = [p.name for p in space.parameters if p.kind != "a" or p.lower <= 0]
        if other:
            raise InputError(f"'{other[0]}' is no link length above 0; vary a1 to a{arm.n} alone, with bounds above 0")
        self.space, self.offset = space, np.array([r.theta for r in rows])
        self._fixed = np.array([r.a for r in rows])
        self._varied = [p.row for p in space.parameters if p.row is not None]
        self._total = float(space.start.sum()) if keep_reach else None
        longest = self._fixed.copy()
        longest[self._varied] = space.upper
        total = float(self._fixed.sum() if keep_reach else longest.sum())
        first = next((p.lower for p in space.parameters if p.row == 0), self._fixed[0])
        self.bound = np.pi * max(total - 2 * first, 0.0) ** 2
        if arm.n == 3:
            self.bound = min(self.bound, np.pi * total**2 / 3)

    def values(self, x: Array) -> tuple[Array, Array]:
        """Designs (P, k), with their sum if it is kept, and by how much (P,) they are beyond their bounds, m."""
        low, high = self.space.lower, self.space.upper
        if self._total is None:
            return np.clip(x, low, high), np.zeros(len(x))
        values = np.maximum(x, low / 10)
        values = values * (self._total / values.sum(axis=1, keepdims=True))
        return values, np.maximum(np.maximum(low - values, values - high) - 1e-13, 0.0).sum(axis=1)

    def lengths(self, values: Array) -> Array:
        """(P, n) m."""
        found = np.tile(self._fixed, (len(values), 1))
        found[:, self._varied] = values
        return found
