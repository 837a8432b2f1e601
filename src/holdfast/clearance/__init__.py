"""How far an arm is from running through itself: capsules on its links and the distances between them."""

from holdfast.clearance.capsules import Capsule, Capsules
from holdfast.clearance.clearance import Clearance, IgnoredPair, too_close

__all__ = ["Capsule", "Capsules", "Clearance", "IgnoredPair", "too_close"]
