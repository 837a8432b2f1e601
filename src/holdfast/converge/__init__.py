"""Where it ends: where a failed arm can come to rest, what attracts it, and from where."""

from holdfast.converge.best_law import Difference, LawChoice, best_law
from holdfast.converge.bounds import joint_bounds
from holdfast.converge.convergence_map import ConvergenceMap, convergence_map
from holdfast.converge.curves import Curve, Curves, Segment
from holdfast.converge.linearisation import Kind, Linearisation, linearisation
from holdfast.converge.measures import Measures
from holdfast.converge.reachable import reachable_when_locked
from holdfast.converge.starts import Places
from holdfast.converge.stationary import RestPoints, stationary
from holdfast.converge.theorem import column_residual, is_stuck, null_components, stuck_subspace
from holdfast.converge.tolerant_workspace import TolerantWorkspace, tolerant_workspace
from holdfast.converge.workspace import Workspace, workspace

__all__ = [
    "ConvergenceMap",
    "Curve",
    "Curves",
    "Difference",
    "Kind",
    "LawChoice",
    "Linearisation",
    "Measures",
    "Places",
    "RestPoints",
    "Segment",
    "TolerantWorkspace",
    "Workspace",
    "best_law",
    "column_residual",
    "convergence_map",
    "is_stuck",
    "joint_bounds",
    "linearisation",
    "null_components",
    "reachable_when_locked",
    "stationary",
    "stuck_subspace",
    "tolerant_workspace",
    "workspace",
]
