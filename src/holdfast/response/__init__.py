"""Everything between a failure and the end of the task: faults, their diagnosis, recovery, and the supervisor of the arm.

A module belongs here if it simulates or detects a fault, or decides what an arm does after one. Motions that are planned
beforehand so that they survive a lock are in ``lock_survival``.
"""

from holdfast.core._lazy import offer

offer(__name__)
