"""Designs of an arm as cells of a study, spread over their bounds, each with its lower quantile of the index."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from holdfast.core.sweeps.job import Chunk
from holdfast.core.sweeps.samples import Column
from holdfast.core.typing import FloatArray, Rows
from holdfast.kinematics.indices.own_file import check_function_digest
from holdfast.kinematics.regions.region import Region
from holdfast.model.arm.task import Task
from holdfast.model.arms.serial import from_dict
from holdfast.studies.designs.evaluation import Evaluator
from holdfast.studies.designs.family import Family
from holdfast.studies.designs.quantile import compute_lower_quantile
from holdfast.studies.designs.reach import ReachEvaluator
from holdfast.studies.designs.search import sample_comparison_poses
from holdfast.studies.designs.space import DesignParameter, DesignSpace
from holdfast.studies.study_files.jobs.process import PlannedJob


def read_design_space(plan: dict[str, Any]) -> DesignSpace:
    """Return the design space of a plan."""
    return DesignSpace(from_dict(plan["arm"]), tuple(DesignParameter(*entry[:3], unit=entry[3]) for entry in plan["vary"]))


def list_designs(space: DesignSpace, count: int, seed: int) -> FloatArray:
    """Return the designs (count, k), the baseline arm first."""
    return np.concatenate([space.start[None], space.draw(count, seed)])[:count]


CompiledDesigns = tuple[Evaluator, ReachEvaluator, FloatArray, FloatArray | None]


@dataclass(frozen=True, eq=False)
class DesignJob(PlannedJob[CompiledDesigns]):
    """Job of the baseline arm and designs of :meth:`holdfast.DesignSpace.draw` at the same poses, with one row per design.

    Attributes:
        plan: Arm, varied parameters, region, index, task, failures, level, poses, and seed.
        rows: Number of all designs.
    """

    rows: int

    def compile_plan(self) -> CompiledDesigns:
        """Return the evaluators of index and reach, all designs, and the weights of the poses."""
        plan = self.plan
        space = read_design_space(plan)
        family = Family(
            space, plan["index"], Task.from_dict(plan["task"]), failures=[list(failed) for failed in plan["failures"]]
        )
        check_function_digest(family.index, plan)
        poses, weights = sample_comparison_poses(Region.from_dict(plan["region"]), plan["poses"], plan["seed"])
        designs = list_designs(space, self.rows, plan["seed"])
        return Evaluator(family, poses, plan["seed"]), ReachEvaluator(family, plan["seed"]), designs, weights

    def columns(self) -> list[Column]:
        """Return the columns of the results; see :class:`holdfast.core.sweeps.SweepJob`."""
        parameter_count = len(self.plan["vary"])
        level = self.plan["level"]
        return [
            Column(
                "design",
                "float64",
                (("parameter", parameter_count),),
                units="rad or m",
                about=", ".join(entry[0] for entry in self.plan["vary"]),
            ),
            Column("guaranteed", "float64", (), units="1", about=f"index that a share {level:g} of the poses have at least"),
            Column("median", "float64", (), units="1", about="median index over the poses, 0 where they are not reached"),
            Column("reached", "float64", (), units="1", about="share of the poses that is reached"),
            Column("reach", "float64", (), units="m", about="largest distance of the tool point from the base"),
        ]

    def run(self, chunk: Chunk) -> Rows:
        """Compute the rows of a chunk; see :class:`holdfast.core.sweeps.SweepJob`."""
        evaluate, evaluate_reach, designs, weights = self.compiled_parts
        values = designs[chunk.start : chunk.stop]
        evaluated = evaluate(values)
        return {
            "design": values,
            "guaranteed": compute_lower_quantile(evaluated.value, self.plan["level"], weights),
            "median": compute_lower_quantile(evaluated.value, 0.5, weights),
            "reached": np.average(evaluated.reached, axis=1, weights=weights),
            "reach": evaluate_reach(values, evaluate.finite_limits(values))[0],
        }
