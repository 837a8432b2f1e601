"""Resumable sweeps: jobs in chunks that survive crashes and can run on several machines; nothing here is about robots."""

from holdfast.core._lazy import offer

offer(__name__)
