from holdfast.control import convergence as convergence
from holdfast.control import equilibria as equilibria
from holdfast.control import falls as falls
from holdfast.control import laws as laws
from holdfast.control import physics as physics
from holdfast.control import simulation as simulation
from holdfast.control.laws import *
