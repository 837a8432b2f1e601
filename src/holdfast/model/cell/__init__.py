"""Work cell: the objects around an arm that it must not touch. The data do not depend on the arm."""

from holdfast.core._lazy import offer

offer(__name__)
