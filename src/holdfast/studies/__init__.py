"""What a study may compute: assessments, maps of convergence, workspaces and task banks, from a study file."""

from holdfast.studies.study_file import StudyFile, read

__all__ = ["StudyFile", "read"]
