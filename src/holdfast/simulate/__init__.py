"""What then happens: the free swing of a failed joint under gravity, on MuJoCo."""

from holdfast.simulate.free_swing import BrakedDrop, FreeSwing, free_swing

__all__ = ["BrakedDrop", "FreeSwing", "free_swing"]
