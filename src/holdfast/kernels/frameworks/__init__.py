"""Batch functions inside PyTorch and JAX with exact first derivatives; both are imported only when they are used."""

from holdfast.core._lazy import offer

offer(__name__)
