from holdfast.reach import closed_form as closed_form
from holdfast.reach.bounds import joint_bounds as joint_bounds
from holdfast.reach.reachable import reachable_when_locked as reachable_when_locked
from holdfast.reach.tolerance import TolerantWorkspace as TolerantWorkspace
from holdfast.reach.tolerance import tolerant_workspace as tolerant_workspace
from holdfast.reach.working_ranges import WorkingRanges as WorkingRanges
from holdfast.reach.working_ranges import find_working_ranges as find_working_ranges
