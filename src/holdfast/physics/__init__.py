"""What needs MuJoCo: free swings, servos, the closed loop with masses."""

from holdfast._lazy import offer

offer(__name__)
