"""Interfaces between the fault-tolerant controller and a robot."""

from __future__ import annotations

from typing import Protocol


class Brakes(Protocol):
    """Interface of the joint brakes."""

    def brake(self, joint: str) -> None:
        """Stop a joint at its present position."""
        ...

    def release(self, joint: str) -> None:
        """Release the brake of a joint."""
        ...


class FaultMonitor(Protocol):
    """Interface of the fault monitor."""

    def rearm(self) -> None:
        """Resume monitoring after an alarm."""
        ...

    def exclude(self, joint: str) -> None:
        """Resume monitoring without one joint."""
        ...
