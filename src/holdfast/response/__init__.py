"""Everything between a failure and the end of the task: faults, their diagnosis, recovery, and the supervisor of the arm.

A module belongs here if it simulates or detects a fault, or decides the response of an arm. Motions that are planned in advance
so that they survive a lock are in ``lock_survival``.
"""

from holdfast.core._lazy import offer

offer(__name__)
