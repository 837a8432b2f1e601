"""What the end effector should do: lines, arcs and sequences of poses, and how fast."""

from holdfast._lazy import offer

offer(__name__)
