"""Check whether an arm at rest stays where it is without motor torque: friction and stops against gravity."""

from holdfast.core._lazy import offer

offer(__name__)
