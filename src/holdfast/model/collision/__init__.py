"""Clearance of an arm from itself and its cell: capsules on its links and the distances between them."""

from holdfast.core._lazy import offer

offer(__name__)
