"""Workspaces after a lock: bounds of self-motion, the failure-tolerant workspace, and working ranges."""

from holdfast.core._lazy import offer

offer(__name__)
