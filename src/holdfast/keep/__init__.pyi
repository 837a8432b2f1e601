from holdfast.keep.kept import ToolConstraint as ToolConstraint
from holdfast.keep.kept import plane as plane
from holdfast.keep.kept import rail as rail
from holdfast.keep.kept import upright as upright
from holdfast.keep.labels import by_label as by_label
