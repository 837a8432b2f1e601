"""Sweeps of an arm's own numbers as cells of a study: designs spread over their bounds, each with what it guarantees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.task import Task
from holdfast.arms.serial import from_dict
from holdfast.designs.evaluation import Evaluator
from holdfast.designs.family import Family
from holdfast.designs.quantile import guaranteed
from holdfast.designs.reach import Reaches
from holdfast.designs.search import region_poses
from holdfast.designs.space import DesignSpace, Parameter
from holdfast.engine.job import Chunk
from holdfast.engine.store import Column
from holdfast.indices.own_file import check_digest
from holdfast.regions.region import Region
from holdfast.studies.jobs.process import PlannedJob

Array = NDArray[np.float64]
Rows = dict[str, NDArray[Any]]


def space_of(plan: dict[str, Any]) -> DesignSpace:
    """The designs of a plan."""
    return DesignSpace(from_dict(plan["arm"]), tuple(Parameter(*p[:3], unit=p[3]) for p in plan["vary"]))


def designs_of(space: DesignSpace, count: int, seed: int) -> Array:
    """(count, k): the given arm first."""
    return np.concatenate([space.start[None], space.draw(count, seed)])[:count]


Made = tuple[Evaluator, Reaches, Array, Array | None]


@dataclass(frozen=True, eq=False)
class DesignJob(PlannedJob[Made]):
    """The given arm, then designs as :meth:`holdfast.DesignSpace.draw` spreads them, all at the same poses; a row is a design.

    Attributes:
        plan: Arm, what is varied, region, index, task, failures, level, poses, seed.
        rows: Designs in all.
    """

    rows: int

    def compiled(self) -> Made:
        """What is evaluated, its reach, all designs, and the weights of the poses."""
        p = self.plan
        space = space_of(p)
        family = Family(space, p["index"], Task.from_dict(p["task"]), failures=[list(f) for f in p["failures"]])
        check_digest(family.index, p)
        poses, weights = region_poses(Region.from_dict(p["region"]), p["poses"], p["seed"])
        designs = designs_of(space, self.rows, p["seed"])
        return Evaluator(family, poses, p["seed"]), Reaches(family, p["seed"]), designs, weights

    def columns(self) -> list[Column]:
        """See :class:`holdfast.engine.Job`."""
        k = len(self.plan["vary"])
        level = self.plan["level"]
        return [
            Column(
                "design", "float64", (("parameter", k),), units="rad or m", about=", ".join(p[0] for p in self.plan["vary"])
            ),
            Column("guaranteed", "float64", (), units="1", about=f"index that a share {level:g} of the poses have at least"),
            Column("median", "float64", (), units="1", about="median index over the poses, 0 where they are not reached"),
            Column("reached", "float64", (), units="1", about="share of the poses that is reached"),
            Column("reach", "float64", (), units="m", about="largest distance of the tool point from the base"),
        ]

    def run(self, chunk: Chunk) -> Rows:
        """See :class:`holdfast.engine.Job`."""
        evaluate, reaches, designs, weights = self.made
        values = designs[chunk.start : chunk.stop]
        found = evaluate(values)
        return {
            "design": values,
            "guaranteed": guaranteed(found.value, self.plan["level"], weights),
            "median": guaranteed(found.value, 0.5, weights),
            "reached": np.average(found.reached, axis=1, weights=weights),
            "reach": reaches(values, evaluate.finite_limits(values))[0],
        }
