"""Modules that all other packages use and that contain nothing about robots: errors, results, files, probability, and sweeps.

A module belongs here if it would make sense in another numerical library. It imports no other package of holdfast.
"""

from holdfast.core._lazy import offer

offer(__name__)
