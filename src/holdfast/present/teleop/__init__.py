"""Pages, figures, and tables of teleoperation experiments."""

from holdfast._lazy import offer

offer(__name__)
