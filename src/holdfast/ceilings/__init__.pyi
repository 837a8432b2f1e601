from holdfast.ceilings.ceiling import Ceiling as Ceiling
from holdfast.ceilings.ceiling import CeilingTable as CeilingTable
from holdfast.ceilings.ceiling import look_up as look_up
from holdfast.ceilings.ceiling import of_index as of_index
from holdfast.ceilings.ceiling import table as table
from holdfast.ceilings.minor_programmes import bounds_by_arrangement as bounds_by_arrangement
from holdfast.ceilings.searching import CeilingSearch as CeilingSearch
from holdfast.ceilings.searching import search as search
