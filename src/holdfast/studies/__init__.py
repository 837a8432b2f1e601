"""Larger computations over regions, designs, and laws: assessments, designs, and study files.

A module belongs here if it combines many results of other wings into one answer. The names of ``study_files`` are offered
here, too.
"""

from holdfast.core._lazy import offer

offer(__name__)
