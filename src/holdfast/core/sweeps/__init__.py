"""Resumable sweeps: jobs in chunks that survive crashes and can run on several machines, without knowledge of robots."""

from holdfast.core._lazy import offer

offer(__name__)
