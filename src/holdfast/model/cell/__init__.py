"""Work cell: the objects around an arm that it must not touch. The data depend on no arm."""

from holdfast.core._lazy import offer

offer(__name__)
