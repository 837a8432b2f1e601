from holdfast.kinematics.paths.path import Path as Path
from holdfast.kinematics.paths.path import arc as arc
from holdfast.kinematics.paths.path import line as line
from holdfast.kinematics.paths.path import sequence as sequence
from holdfast.kinematics.paths.timed_path import TimedPath as TimedPath
from holdfast.kinematics.paths.timing import Constant as Constant
from holdfast.kinematics.paths.timing import Timing as Timing
from holdfast.kinematics.paths.timing import Trapezoid as Trapezoid
