from holdfast.control.falls.brakes import Brakes as Brakes
from holdfast.control.falls.fall import FallOutcome as FallOutcome
from holdfast.control.falls.fall import PowerLoss as PowerLoss
from holdfast.control.falls.physical import PhysicalFall as PhysicalFall
from holdfast.control.falls.power_cut import power_loss as power_loss
