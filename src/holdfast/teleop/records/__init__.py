"""Records of an experiment: trials with digests, tables, and copies."""

from holdfast.core._lazy import offer

offer(__name__)
