"""Where it ends: what stays within reach, where a failed arm comes to rest and from where, and the way home afterwards."""

from holdfast._lazy import offer

offer(__name__)
