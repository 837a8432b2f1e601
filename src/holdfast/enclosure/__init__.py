"""Every configuration of a pose within limits, or a proof that there is none: boxes of joints, halved until decided."""

from holdfast._lazy import offer

offer(__name__)
