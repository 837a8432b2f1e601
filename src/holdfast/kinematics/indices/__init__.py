"""Fault tolerance of one configuration: locked-joint indices and free-swinging susceptibilities, with gradients.

Free-swinging joints are in :mod:`holdfast.kinematics.indices.susceptibility`. Every constructor of an index takes
``(arm, task="pose", failures="single", length=None)`` and its own further arguments, and returns an :class:`Index`.
"""

from holdfast.core._lazy import offer

offer(__name__)
