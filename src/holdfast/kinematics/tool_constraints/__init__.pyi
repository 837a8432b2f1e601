from holdfast.kinematics.tool_constraints.constraint import ToolConstraint as ToolConstraint
from holdfast.kinematics.tool_constraints.constraint import plane as plane
from holdfast.kinematics.tool_constraints.constraint import rail as rail
from holdfast.kinematics.tool_constraints.constraint import upright as upright
from holdfast.kinematics.tool_constraints.labels import by_label as by_label
