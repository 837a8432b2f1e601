"""Where it ends: over a workspace, from where a failed arm still arrives."""

from holdfast.converge.starts import Places
from holdfast.converge.workspace import Workspace, workspace

__all__ = ["Places", "Workspace", "workspace"]
