from holdfast.enclosure.search import Configurations as Configurations
from holdfast.enclosure.search import Finding as Finding
from holdfast.enclosure.search import all_configurations as all_configurations
