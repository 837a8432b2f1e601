from holdfast.enclosure.along_leg import parted as parted
from holdfast.enclosure.search import Configurations as Configurations
from holdfast.enclosure.search import Finding as Finding
from holdfast.enclosure.search import all_configurations as all_configurations
