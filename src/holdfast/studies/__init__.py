"""Studies from a study file: assessments, convergence maps, workspaces, and task banks."""

from holdfast._lazy import offer

offer(__name__)
