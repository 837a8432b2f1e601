"""Simulations with MuJoCo: free swings, servos, and the closed loop with masses."""

from holdfast._lazy import offer

offer(__name__)
