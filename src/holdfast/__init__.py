"""holdfast: what happens to the task when a joint of a redundant arm fails, and what can be done about it beforehand."""

from holdfast.core._lazy import offer

__version__ = "0.1.0"

offer(__name__)
