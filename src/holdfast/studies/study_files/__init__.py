"""Studies that a study file defines, with assessments, convergence maps, workspaces, and task banks."""

from holdfast.core._lazy import offer

offer(__name__)
