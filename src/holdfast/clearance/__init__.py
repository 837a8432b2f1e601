"""How far an arm is from colliding with itself: capsules on its links and the distances between them."""

from holdfast._lazy import offer

offer(__name__)
