from holdfast.simulation.closed_loop import simulate as simulate
from holdfast.simulation.runs import Reason as Reason
from holdfast.simulation.runs import RunOutcome as RunOutcome
from holdfast.simulation.runs import RunPath as RunPath
from holdfast.simulation.runs import Runs as Runs
