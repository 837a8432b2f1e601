from holdfast.reaction.export import ExportedController as ExportedController
from holdfast.reaction.export import export_controller as export_controller
from holdfast.reaction.loop import simulate_faults as simulate_faults
from holdfast.reaction.run import Action as Action
from holdfast.reaction.run import FaultRun as FaultRun
