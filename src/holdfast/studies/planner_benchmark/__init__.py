"""Benchmark suites that anyone can run again, with the same cases for the planners of holdfast and for others."""

from holdfast.core._lazy import offer

offer(__name__)
