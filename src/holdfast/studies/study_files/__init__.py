"""Studies from a study file: assessments, convergence maps, workspaces, and task banks."""

from holdfast.core._lazy import offer

offer(__name__)
