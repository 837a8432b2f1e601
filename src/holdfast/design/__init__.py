"""Which arm to build: search over geometry and limits by what the arm guarantees over a region, or where it still arrives."""

from holdfast._lazy import offer

offer(__name__)
