"""Which arm to build: search over geometry and limits by what the arm guarantees over a region."""

from holdfast.design.result import Check, Checked, Designs
from holdfast.design.search import design
from holdfast.design.space import DesignSpace, Parameter, design_space, parse_vary

__all__ = ["Check", "Checked", "DesignSpace", "Designs", "Parameter", "design", "design_space", "parse_vary"]
