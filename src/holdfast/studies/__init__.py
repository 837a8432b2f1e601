"""Larger computations over regions, designs, and laws: assessments, designs, and study files.

A module belongs here if it combines many results of other packages into one answer. This package also exports the names of
``study_files``.
"""

from holdfast.core._lazy import offer

offer(__name__)
