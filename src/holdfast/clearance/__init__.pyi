from holdfast.clearance.capsules import Capsule as Capsule
from holdfast.clearance.capsules import Capsules as Capsules
from holdfast.clearance.cell_check import CellCheck as CellCheck
from holdfast.clearance.cell_check import CheckedObject as CheckedObject
from holdfast.clearance.cell_check import check_cell as check_cell
from holdfast.clearance.choice import chosen_clearance as chosen_clearance
from holdfast.clearance.clearance import Clearance as Clearance
from holdfast.clearance.clearance import IgnoredPair as IgnoredPair
