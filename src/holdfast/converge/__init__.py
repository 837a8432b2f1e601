"""Where it ends: which targets stay within reach, where the failed arm comes to rest, and from where."""

from holdfast.converge.bounds import joint_bounds
from holdfast.converge.reachable import reachable_when_locked

__all__ = ["joint_bounds", "reachable_when_locked"]
