from holdfast.clearance.capsules import Capsule as Capsule
from holdfast.clearance.capsules import Capsules as Capsules
from holdfast.clearance.capsules import IgnoredPair as IgnoredPair
from holdfast.clearance.choice import chosen_clearance as chosen_clearance
from holdfast.clearance.clearance import Clearance as Clearance
from holdfast.clearance.contacts import Contact as Contact
