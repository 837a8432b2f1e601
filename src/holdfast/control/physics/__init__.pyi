from holdfast.control.physics.body import Body as Body
from holdfast.control.physics.execution import Execution as Execution
from holdfast.control.physics.joint_motion import execute as execute
from holdfast.control.physics.loop import simulate_physics as simulate_physics
from holdfast.control.physics.run import PhysicalRun as PhysicalRun
from holdfast.control.physics.servos import Servos as Servos
