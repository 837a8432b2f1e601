"""Certificates: claims about every target of a box, proved cell by cell and checked by an independent verifier."""

from holdfast.core._lazy import offer

offer(__name__)
