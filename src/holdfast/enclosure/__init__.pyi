from holdfast.enclosure.along_leg import prove_leg_impossible as prove_leg_impossible
from holdfast.enclosure.search import Configurations as Configurations
from holdfast.enclosure.search import SearchOutcome as SearchOutcome
from holdfast.enclosure.search import all_configurations as all_configurations
