"""Which arm to build: search over geometry and limits by what the arm guarantees over a region, or where it still arrives."""

from holdfast.design.convergence import ConvergenceDesigns, design_for_convergence
from holdfast.design.design_joints import DesignJoints, LawOfDesigns
from holdfast.design.planar_rest import PlanarRest, Radial
from holdfast.design.result import Check, Checked, Designs
from holdfast.design.search import design
from holdfast.design.space import DesignSpace, Parameter, design_space, parse_vary

__all__ = [
    "Check",
    "Checked",
    "ConvergenceDesigns",
    "DesignJoints",
    "DesignSpace",
    "Designs",
    "LawOfDesigns",
    "Parameter",
    "PlanarRest",
    "Radial",
    "design",
    "design_for_convergence",
    "design_space",
    "parse_vary",
]
