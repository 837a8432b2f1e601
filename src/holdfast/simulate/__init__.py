"""What then happens: the closed loop of a controller that knows of no failure, and the free swing of a failed joint."""

from holdfast.simulate.closed_loop import simulate
from holdfast.simulate.free_swing import BrakedDrop, FreeSwing, free_swing
from holdfast.simulate.runs import Outcome, Path, Reason, Runs

__all__ = ["BrakedDrop", "FreeSwing", "Outcome", "Path", "Reason", "Runs", "free_swing", "simulate"]
