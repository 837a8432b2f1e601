from holdfast.clearance.capsules import Capsule as Capsule
from holdfast.clearance.capsules import Capsules as Capsules
from holdfast.clearance.clearance import Clearance as Clearance
from holdfast.clearance.clearance import IgnoredPair as IgnoredPair
from holdfast.clearance.clearance import too_close as too_close
