"""Which arm to build: search over geometry and limits by what the arm guarantees over a region."""

from holdfast.design.space import DesignSpace, Parameter, design_space, parse_vary

__all__ = ["DesignSpace", "Parameter", "design_space", "parse_vary"]
