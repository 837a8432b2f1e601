"""Big runs: chunks, commit, resume. Knows no robots."""

from holdfast.study.store import Column, Store

__all__ = ["Column", "Store"]
