"""Pages, figures, and tables of teleoperation experiments."""

from holdfast.core._lazy import offer

offer(__name__)
