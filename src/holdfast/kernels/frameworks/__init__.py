"""Batch functions inside PyTorch and JAX with exact first derivatives; both packages are imported only when they are used."""

from holdfast.core._lazy import offer

offer(__name__)
