from holdfast.physics.execution import Execution as Execution
from holdfast.physics.fall import BrakedDrop as BrakedDrop
from holdfast.physics.fall import FreeSwing as FreeSwing
from holdfast.physics.joint_motion import execute as execute
from holdfast.physics.loop import simulate_physics as simulate_physics
from holdfast.physics.run import PhysicalRun as PhysicalRun
from holdfast.physics.servos import Servos as Servos
from holdfast.physics.swing import free_swing as free_swing
