"""holdfast: what happens to the task when a joint of a redundant arm fails, and what can be done about it beforehand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from holdfast.on_demand import offer

if TYPE_CHECKING:
    from holdfast import arms, control, indices, paths
    from holdfast.arm import DH, Arm, Joint, Link
    from holdfast.arm.task import Task
    from holdfast.assess import Assessment, Comparison, Region, assess, compare, load
    from holdfast.clearance import Capsules, Clearance
    from holdfast.control import Trajectory
    from holdfast.control.follow import follow  # where it is defined: mypy meets the module of that name first
    from holdfast.converge import (
        ConvergenceMap,
        LawChoice,
        Recovery,
        TargetMeasures,
        TolerantWorkspace,
        Workspace,
        basins,
        best_law,
        convergence_map,
        joint_bounds,
        reachable_when_locked,
        recover,
        stationary,
        target_measures,
        tolerant_workspace,
        workspace,
    )
    from holdfast.design import ConvergenceDesigns, Designs, DesignSpace, design, design_for_convergence
    from holdfast.errors import ArmError, HoldfastError, InputError, KernelError, StoreError, TaskError
    from holdfast.indices import susceptibility
    from holdfast.kernels import set_threads
    from holdfast.simulate import (
        BrakedDrop,
        FreeSwing,
        LawComparison,
        PhysicalRun,
        PointToPoint,
        Runs,
        Servos,
        compare_laws,
        free_swing,
        point_to_point,
        simulate,
        simulate_physics,
    )
    from holdfast.solve import Reach, solve_ik
    from holdfast.solve.optimise import Optimum, optimise
    from holdfast.solve.self_motion import self_motion
    from holdfast.status import Status

__version__ = "0.1.0"

__all__ = [
    "DH",
    "Arm",
    "ArmError",
    "Assessment",
    "BrakedDrop",
    "Capsules",
    "Clearance",
    "Comparison",
    "ConvergenceDesigns",
    "ConvergenceMap",
    "DesignSpace",
    "Designs",
    "FreeSwing",
    "HoldfastError",
    "InputError",
    "Joint",
    "KernelError",
    "LawChoice",
    "LawComparison",
    "Link",
    "Optimum",
    "PhysicalRun",
    "PointToPoint",
    "Reach",
    "Recovery",
    "Region",
    "Runs",
    "Servos",
    "Status",
    "StoreError",
    "TargetMeasures",
    "Task",
    "TaskError",
    "TolerantWorkspace",
    "Trajectory",
    "Workspace",
    "__version__",
    "arms",
    "assess",
    "basins",
    "best_law",
    "compare",
    "compare_laws",
    "control",
    "convergence_map",
    "design",
    "design_for_convergence",
    "follow",
    "free_swing",
    "indices",
    "joint_bounds",
    "load",
    "optimise",
    "paths",
    "point_to_point",
    "reachable_when_locked",
    "recover",
    "self_motion",
    "set_threads",
    "simulate",
    "simulate_physics",
    "solve_ik",
    "stationary",
    "susceptibility",
    "target_measures",
    "tolerant_workspace",
    "workspace",
]

offer(
    __name__,
    {
        "arm": "DH Arm Joint Link",
        "arm.task": "Task",
        "assess": "Assessment Comparison Region assess compare load",
        "clearance": "Capsules Clearance",
        "control": "Trajectory follow",
        "converge": "ConvergenceMap LawChoice Recovery TargetMeasures TolerantWorkspace Workspace basins best_law "
        "convergence_map joint_bounds reachable_when_locked recover stationary target_measures tolerant_workspace workspace",
        "design": "ConvergenceDesigns Designs DesignSpace design design_for_convergence",
        "errors": "ArmError HoldfastError InputError KernelError StoreError TaskError",
        "indices": "susceptibility",
        "kernels": "set_threads",
        "simulate": "BrakedDrop FreeSwing LawComparison PhysicalRun PointToPoint Runs "
        "Servos compare_laws free_swing point_to_point simulate simulate_physics",
        "solve": "Optimum Reach optimise self_motion solve_ik",
        "status": "Status",
    },
)
