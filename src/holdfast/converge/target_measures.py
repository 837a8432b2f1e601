"""The workspace measures over targets instead of starts: which targets does a lock put at risk, wherever the motion began?"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.configurations import without_idle_limits
from holdfast.control.law import Law
from holdfast.converge.places_file import axis_label, save_places
from holdfast.converge.starts import Places, read_places
from holdfast.converge.workspace import ENDS, workspace
from holdfast.solve import solve_ik

Array = NDArray[np.float64]

MEASURES = ("R100", "Ravg", "Rsens", "F100", "Favg", "Fsens")
TARGETS, STARTS, CONFIGURATIONS, POINTS = "grid:12", 20, 8, 2


@dataclass(frozen=True, eq=False)
class TargetMeasures:
    """Measures of T targets, each the mean over the same starts; the last of the n + 1 columns is for an arbitrary joint.

    Attributes:
        law: The law of the controller.
        targets: Where the hand should go.
        starts: Where it begins.
        measures: R100, Ravg, Rsens, F100, Favg and Fsens by name, (T, n + 1) each, percent; NaN for a target out of reach, and
            F where no failure leaves the target in reach.
        ends: (T, 6) how the failures ended, as in :class:`holdfast.Workspace`.
    """

    law: Law
    targets: Places
    starts: Places
    measures: dict[str, Array]
    ends: NDArray[np.int64]

    def describe(self) -> list[str]:
        """A few sentences for people."""
        told = ", ".join(f"{count} {name}" for name, count in zip(ENDS, self.ends.sum(axis=0).tolist(), strict=True))
        within = int(np.isfinite(self.measures["Ravg"][:, -1]).sum())
        return [
            f"{self.law.describe()} on '{self.law.arm.name}': {within} of {len(self.targets)} targets within reach of motions "
            f"from {len(self.starts)} starts",
            f"failures: {told}",
        ]

    def save(self, folder: str | Path) -> list[Path]:
        """Write ``targets.csv``, ``targets.json``, ``targets-reach.png`` and ``targets-finish.png``.

        Raises:
            StoreError: The folder cannot be written.
        """
        from holdfast.report.figures import save_png

        names = (*self.law.arm.joint_names, "any")
        columns = [*ENDS, *(f"{name}_{column}_percent" for name in self.measures for column in names)]
        facts: dict[str, Any] = {"arm": self.law.arm.name, "law": self.law.describe(), "starts": len(self.starts)}
        files = save_places(folder, "targets", self.targets, columns, [self.ends, *self.measures.values()], facts)
        for name, rows in (("reach", ("R100", "Ravg", "Rsens")), ("finish", ("F100", "Favg", "Fsens"))):
            files.append(save_png(self._figure(rows), Path(folder) / f"targets-{name}.png", 130))
        return files

    def _figure(self, names: tuple[str, ...]) -> Any:
        from holdfast.report.place_maps import Plane, place_maps

        arm, rows = self.law.arm, self.law.task.rows[:, :3]
        words = axis_label(rows[0]), axis_label(rows[1])
        plane = Plane(self.targets.points @ rows.T, words, self.targets.cells, self.targets.axes)
        about = (
            f"{arm.name}, {self.law.name}: each place is a target, its value the mean over {len(self.starts)} starts; "
            f"{int(self.ends.sum())} failures; grey: no value"
        )
        return place_maps(plane, {n: self.measures[n] for n in names}, [*arm.joint_names, "any joint"], "percent", about)


def target_measures(
    law: Law,
    targets: ArrayLike | str | int | Places = TARGETS,
    starts: ArrayLike | str | int | Places = STARTS,
    configurations: int = CONFIGURATIONS,
    points: int = POINTS,
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
    **options: Any,
) -> TargetMeasures:
    """The measures of :func:`holdfast.workspace` for many targets, each averaged over the same starts.

    Args:
        law: The law of the controller, with a task in a plane and one joint to spare.
        targets: A lattice (``"grid:14"``), a number of random ones, (T, m) positions or (T, 4, 4) poses.
        starts: Likewise.
        configurations: Of each start, on each curve of its self-motion.
        points: Failures of each joint on each motion.
        seed: Of random places.
        progress: Is told how many targets are done, and of how many.
        options: Further ones of :func:`holdfast.workspace`: ``method``, ``cells``, ``time_limit``, ``relative_to``.

    Returns:
        A :class:`holdfast.TargetMeasures`.

    Raises:
        InputError, TaskError: As :func:`holdfast.workspace`.

    Source: the measures are those of Goel, Maciejewski, Balakrishnan 2005, section 5; over targets they are ours.
    """
    generator = np.random.default_rng(seed)
    goals = read_places(law.arm, law.task, targets, generator)
    places = read_places(law.arm, law.task, starts, generator)
    within = solve_ik(without_idle_limits(law.arm), goals.poses, seed, law.task).success
    columns = law.arm.n + 1
    measures = {name: np.full((len(goals), columns), np.nan) for name in MEASURES}
    ends = np.zeros((len(goals), len(ENDS)), dtype=np.int64)
    for k, pose in enumerate(goals.poses):
        if within[k]:
            one = workspace(law, pose, places, configurations, points, seed=seed, **options)
            for name, mean in one.means().items():
                measures[name][k] = mean
            ends[k] = one.ends.sum(axis=0)
        if progress is not None:
            progress(k + 1, len(goals))
    return TargetMeasures(law, goals, places, measures, ends)
