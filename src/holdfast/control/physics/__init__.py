"""Simulations with MuJoCo: free swings, servos, and the closed loop with masses."""

from holdfast.core._lazy import offer

offer(__name__)
