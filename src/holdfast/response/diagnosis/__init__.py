"""Monitor that detects a joint fault while the arm moves, isolates the joint, and reports inconclusive cases."""

from holdfast.core._lazy import offer

offer(__name__)
