from holdfast.present.teleop.allocation import write_allocation as write_allocation
from holdfast.present.teleop.bank import bank_figure as bank_figure
