"""How to move: control laws that do not know of a failure, and redundancy resolution that serves an objective before one."""

from holdfast._lazy import offer

offer(__name__)
