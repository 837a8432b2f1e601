"""What can be reached after a lock: bounds of self-motion, the tolerant workspace."""

from holdfast._lazy import offer

offer(__name__)
