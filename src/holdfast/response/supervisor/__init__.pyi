from holdfast.response.supervisor.export import ExportedController as ExportedController
from holdfast.response.supervisor.export import export_controller as export_controller
from holdfast.response.supervisor.frozen_joints import FrozenJoints as FrozenJoints
from holdfast.response.supervisor.loop import simulate_faults as simulate_faults
from holdfast.response.supervisor.run import Action as Action
from holdfast.response.supervisor.run import FaultRun as FaultRun
from holdfast.response.supervisor.states import TRANSITION_TABLE as TRANSITION_TABLE
