"""Certificates: claims about every target of a box, proved by cells and checked by a verifier that trusts nobody."""

from holdfast._lazy import offer

offer(__name__)
