"""Fault-tolerant control loop: a joint fails, the monitor names it, the controller responds, and the task continues."""

from holdfast.core._lazy import offer

offer(__name__)
