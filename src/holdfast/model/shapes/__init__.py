"""Visual and collision shapes of the links, read from the file of an arm, with their mesh files."""

from holdfast.core._lazy import offer

offer(__name__)
