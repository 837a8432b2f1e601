"""Where it ends: which targets stay within reach, where the failed arm comes to rest, and from where."""

from holdfast.converge.bounds import joint_bounds
from holdfast.converge.reachable import reachable_when_locked
from holdfast.converge.tolerant_workspace import TolerantWorkspace, tolerant_workspace

__all__ = ["TolerantWorkspace", "joint_bounds", "reachable_when_locked", "tolerant_workspace"]
