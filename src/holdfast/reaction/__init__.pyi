from holdfast.reaction.loop import simulate_faults as simulate_faults
from holdfast.reaction.run import Action as Action
from holdfast.reaction.run import FaultRun as FaultRun
