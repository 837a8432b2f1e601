"""holdfast: what happens to the task when a joint of a redundant arm fails, and what can be done about it beforehand."""

from holdfast.arm import DH, Arm, Joint, Link

__version__ = "0.1.0"

__all__ = ["DH", "Arm", "Joint", "Link", "__version__"]
