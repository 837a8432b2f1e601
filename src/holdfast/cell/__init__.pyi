from holdfast.cell.cell import Cell as Cell
from holdfast.cell.solids import Box as Box
from holdfast.cell.solids import Capsule as Capsule
from holdfast.cell.solids import Cylinder as Cylinder
from holdfast.cell.solids import HalfSpace as HalfSpace
from holdfast.cell.solids import Solid as Solid
from holdfast.cell.solids import Sphere as Sphere
