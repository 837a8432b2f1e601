"""Symbols of one step of the kinematic closed loop that a kind of fault may change."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from holdfast.kernels.program import SX

KERNEL_INFINITY = 1e300  # kernels turn infinity into NaN


@dataclass(kw_only=True)
class StepSymbols:
    """Symbols of one step, (n,) where nothing else is given: rad and rad/s, or m and m/s.

    A kind may change ``command``, ``speed_limits``, ``lower``, and ``upper`` before the motion, and ``q_measured`` after it.
    """

    first: SX  # parameters of the fault of each joint in the order of its kind
    second: SX  # parameters of the fault of each joint in the order of its kind
    third: SX  # parameters of the fault of each joint in the order of its kind
    onset: SX  # onset of the fault of each joint, s
    last_command: SX  # commanded rates of the last step
    q_onset: SX  # positions at the onset
    noise: SX  # numbers of the standard normal distribution
    time: SX  # scalar, time of the reading, s
    command: SX  # commanded rates
    speed_limits: SX  # largest rates
    lower: SX  # lower stops
    upper: SX  # upper stops
    q_motor: SX = None  # positions of the motors, which differ from those of the links after a slipping clutch
    q_measured: SX = None  # sensor readings

    @staticmethod
    def select(condition: SX, value: SX, otherwise: SX) -> SX:
        """Return ``value`` where the condition is 1, and ``otherwise`` elsewhere."""
        return ca.if_else(condition, value, otherwise)

    @staticmethod
    def all_true(*conditions: SX) -> SX:
        """Return 1 where all conditions are 1."""
        conjunction = conditions[0]
        for condition in conditions[1:]:
            conjunction = ca.logic_and(conjunction, condition)
        return conjunction

    @staticmethod
    def minimum(a: SX, b: SX) -> SX:
        """Return the smaller value."""
        return ca.if_else(a < b, a, b)

    @staticmethod
    def maximum(a: SX, b: SX) -> SX:
        """Return the larger value."""
        return ca.if_else(a > b, a, b)

    @classmethod
    def clip(cls, value: SX, lower: SX, upper: SX) -> SX:
        """Return the value within bounds."""
        return cls.minimum(cls.maximum(value, lower), upper)

    @staticmethod
    def is_given(parameter: SX) -> SX:
        """Return 1 where a parameter is given whose ``absent`` number is infinite."""
        return ca.logic_and(parameter < KERNEL_INFINITY, parameter > -KERNEL_INFINITY)
