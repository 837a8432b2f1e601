"""Statistics of the teleoperation experiment: from a table of trials to a report.

Needs statsmodels: ``pip install holdfast-arms[stats]``.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, section 7.
"""

from holdfast.core._lazy import offer

offer(__name__)
