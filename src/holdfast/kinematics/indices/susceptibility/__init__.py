"""Effect of a free-swinging failure of each joint of an arm at rest: torque, acceleration, and swing angle.

Each constructor takes ``(arm, weights=None)`` and returns a :class:`Susceptibility`; smaller is better. Weights combine the
joints into ``f' W f``: None (equal weights), n numbers (diagonal), an (n, n) positive semidefinite matrix, and for torques also
``"effort"`` (each torque divided by its joint's effort limit) or ``"worst-case"`` (each divided by its largest static value in
the workspace, so that every term is 0 to 1).

Source: English and Maciejewski 1998.
"""

from holdfast.core._lazy import offer

offer(__name__)
