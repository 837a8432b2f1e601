"""What the hand should do: lines, arcs and sequences of poses, and how fast."""

from holdfast.paths.path import Path, arc, line, sequence
from holdfast.paths.timing import Constant, TimedPath, Timing, Trapezoid

__all__ = ["Constant", "Path", "TimedPath", "Timing", "Trapezoid", "arc", "line", "sequence"]
