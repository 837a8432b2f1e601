from holdfast.endurance.endurance import Endurance as Endurance
from holdfast.endurance.endurance import Found as Found
from holdfast.endurance.endurance import VelocityJump as VelocityJump
from holdfast.endurance.given import endurance_of as endurance_of
from holdfast.endurance.rates import FailureRates as FailureRates
from holdfast.endurance.search import endure as endure
