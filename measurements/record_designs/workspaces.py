"""Search for planar arms with the largest failure-tolerant workspace: link lengths and artificial limits together."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.progress import ProgressCount, reports_progress
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.workspace.closed_form import ThreeLinks, workspace_area
from holdfast.model.arm.model import Arm
from holdfast.studies.designs.space import DesignSpace, Vary, design_space
from measurements.record_designs.annuli import compute_tolerant_area
from measurements.record_designs.found import EvolvedDesign
from measurements.record_designs.strategy import minimise_by_evolution

_POPULATION_SIZE = 24
# _RANGE_SAMPLES and _FINAL_RANGE_SAMPLES: of each range of a joint
_RANGE_SAMPLES = 9
_FINAL_RANGE_SAMPLES = 81
_SEARCH_RADII = 20
_FINAL_RADII = 1600
_FULL_TURN_RAD = 2 * np.pi


@check_arguments
@reports_progress("searching designs")
def design_for_workspace(
    arm: Arm, vary: Vary, *, keep_reach: bool = True, generations: int = 250, restarts: int = 3, seed: int = 0
) -> EvolvedDesign:
    """Search for the link lengths and artificial limits of a planar arm with the largest failure-tolerant workspace.

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

    Source: Lewis and Maciejewski 1997 for the workspace; search and bound derived here (``docs/theory/arms-at-the-bound.md``).
    """
    start_time = time.monotonic()
    if generations < 1 or restarts < 1:
        raise InputError(f"generations is {generations} and restarts {restarts}; give at least 1")
    links = _LinkLengths(design_space(arm, vary), keep_reach)
    area_functions: list[_Areas] = [_compute_tolerant_areas, *([_compute_three_link_areas] if arm.n == 3 else [])]
    rng, history = np.random.default_rng(seed), list[float]()
    best, baseline_area = (0.0, links.space.start, np.tile([-np.pi, np.pi], (arm.n, 1))), 0.0
    with ProgressCount("generations", len(area_functions) * (restarts + 1) * generations) as advance:

        def record_generation(least_cost: float) -> bool:
            advance(1)
            history.append(max(-least_cost, history[-1] if history else 0.0))
            return False

        for compute_areas in area_functions:
            for restart in range(restarts + 1):
                keep_lengths = restart == 0  # the given lengths: what limits alone give
                parameter_count = len(links.space.start)
                angles = 2 * (arm.n - 2) if compute_areas is _compute_tolerant_areas else 5
                start_point = np.concatenate([links.space.draw(1, int(rng.integers(1 << 30)))[0], rng.uniform(-1, 1, angles)])
                deviations = np.concatenate([(links.space.upper - links.space.lower) / 4, np.full(angles, 1.0)])

                def compute_cost(
                    x: FloatArray,
                    compute_areas: _Areas = compute_areas,
                    keep_lengths: bool = keep_lengths,
                    parameter_count: int = parameter_count,
                    fine: bool = False,
                ) -> FloatArray:
                    values, beyond = links.project_to_bounds(
                        np.tile(links.space.start, (len(x), 1)) if keep_lengths else x[:, :parameter_count]
                    )
                    return np.where(
                        beyond > 0, beyond, -compute_areas(links.link_lengths(values), x[:, parameter_count:], fine)[0]
                    )

                x, _ = minimise_by_evolution(
                    compute_cost,
                    start_point,
                    deviations,
                    population=_POPULATION_SIZE,
                    generations=generations,
                    rng=rng,
                    on_generation=record_generation,
                )
                final_area = -float(compute_cost(x[None], fine=True)[0])
                values, _ = links.project_to_bounds(links.space.start[None] if keep_lengths else x[None, :parameter_count])
                baseline_area = max(baseline_area, final_area) if keep_lengths else baseline_area
                if final_area > best[0]:
                    best = (
                        final_area,
                        values[0],
                        compute_areas(links.link_lengths(values), x[None, parameter_count:], True)[1][0],
                    )
    return EvolvedDesign(
        space=links.space,
        objective="tolerant-workspace",
        values=best[1],
        value=best[0],
        given=baseline_area,
        bound=links.bound,
        limits=best[2] - links.offset[:, None],
        history=np.array(history),
        seed=seed,
        seconds=time.monotonic() - start_time,
    )


_Areas = Callable[[FloatArray, FloatArray, bool], tuple[FloatArray, FloatArray]]


def _compute_tolerant_areas(lengths: FloatArray, angles: FloatArray, fine: bool) -> tuple[FloatArray, FloatArray]:
    """Return areas (P,) and limits (P, n, 2) of the link angles, from the middles and half widths of the ranges of joints 3 to
    n.
    """
    arm_count, n = lengths.shape
    middle, half_ranges = angles[:, : n - 2], np.minimum(abs(angles[:, n - 2 :]), np.pi)
    limits = np.tile([-np.pi, np.pi], (arm_count, n, 1))
    limits[:, 2:] = np.stack([middle - half_ranges, middle + half_ranges], axis=2)
    return compute_tolerant_area(lengths, limits[:, 2:], _FINAL_RANGE_SAMPLES if fine else _RANGE_SAMPLES), limits


def _compute_three_link_areas(lengths: FloatArray, angles: FloatArray, fine: bool) -> tuple[FloatArray, FloatArray]:
    """Return areas and limits of arms of three joints, from the half widths of all ranges and the middles of those of joints 2
    and 3.
    """
    half_ranges = np.minimum(abs(angles[:, [0, 2, 4]]), np.pi)
    middle = np.column_stack([np.zeros(len(angles)), angles[:, [1, 3]]])
    limits = np.stack([middle - half_ranges, middle + half_ranges], axis=2)
    arms = [ThreeLinks(link_lengths, np.zeros(2), np.zeros(3), np.ones(3)) for link_lengths in lengths]
    areas = [
        workspace_area(arm, pair[None], _FINAL_RADII if fine else _SEARCH_RADII)[0]
        for arm, pair in zip(arms, limits, strict=True)
    ]
    return np.array(areas), limits


class _LinkLengths:
    """Link lengths of the designs of a space.

    Attributes:
        space: What varies.
        offset: (n,) angle of each link where its joint is at 0, rad.
        bound: No arm whose first joint has no limits has a larger workspace.
    """

    def __init__(self, space: DesignSpace, keep_reach: bool) -> None:
        rows, tool, arm = space.table.rows, space.table.tool, space.arm
        is_planar = all(row.type == "revolute" and abs(np.sin(row.alpha / 2)) < 1e-9 and row.a > 0 for row in rows)
        if (
            arm.n < 3
            or not is_planar
            or np.linalg.norm(tool[:3, 3]) > 1e-9
            or not (arm.upper - arm.lower >= _FULL_TURN_RAD - 1e-9).all()
        ):
            raise InputError(
                f"'{arm.name}' is no planar arm of three or more revolute joints that turn all the way, whose tool is the end "
                "of its last link; a failure-tolerant workspace is maximised for those"
            )
        other_names = [parameter.name for parameter in space.parameters if parameter.kind != "a" or parameter.lower <= 0]
        if other_names:
            raise InputError(f"'{other_names[0]}' is no link length above 0; vary a1 to a{arm.n} alone, with bounds above 0")
        self.space, self.offset = space, np.array([row.theta for row in rows])
        self._baseline_lengths = np.array([row.a for row in rows])
        self._varied_rows = [parameter.row for parameter in space.parameters if parameter.row is not None]
        self._kept_sum = float(space.start.sum()) if keep_reach else None
        longest = self._baseline_lengths.copy()
        longest[self._varied_rows] = space.upper
        total = float(self._baseline_lengths.sum() if keep_reach else longest.sum())
        first_length = next(
            (parameter.lower for parameter in space.parameters if parameter.row == 0), self._baseline_lengths[0]
        )
        self.bound = np.pi * max(total - 2 * first_length, 0.0) ** 2
        if arm.n == 3:
            self.bound = min(self.bound, np.pi * total**2 / 3)

    def project_to_bounds(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return designs (P, k), with their sum if it is kept, and by how much (P,) they exceed their bounds, m."""
        lower, upper = self.space.lower, self.space.upper
        if self._kept_sum is None:
            return np.clip(x, lower, upper), np.zeros(len(x))
        values = np.maximum(x, lower / 10)
        values = values * (self._kept_sum / values.sum(axis=1, keepdims=True))
        return values, np.maximum(np.maximum(lower - values, values - upper) - 1e-13, 0.0).sum(axis=1)

    def link_lengths(self, values: FloatArray) -> FloatArray:
        """Return the link lengths (P, n), m."""
        lengths = np.tile(self._baseline_lengths, (len(values), 1))
        lengths[:, self._varied_rows] = values
        return lengths
