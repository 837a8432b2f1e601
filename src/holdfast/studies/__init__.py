"""What a study may compute: assessments, maps of convergence, workspaces and task banks, from a study file."""

from holdfast._lazy import offer

offer(__name__)
