from holdfast.control.simulation.closed_loop import simulate as simulate
from holdfast.control.simulation.runs import Reason as Reason
from holdfast.control.simulation.runs import RunOutcome as RunOutcome
from holdfast.control.simulation.runs import RunPath as RunPath
from holdfast.control.simulation.runs import Runs as Runs
