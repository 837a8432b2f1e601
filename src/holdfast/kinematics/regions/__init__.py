"""Distributions of poses: regions of the workspace, and lists of poses with their weights."""

from holdfast.core._lazy import offer

offer(__name__)
