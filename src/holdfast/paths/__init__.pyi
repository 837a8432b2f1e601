from holdfast.paths.path import Path as Path
from holdfast.paths.path import arc as arc
from holdfast.paths.path import line as line
from holdfast.paths.path import sequence as sequence
from holdfast.paths.timed_path import TimedPath as TimedPath
from holdfast.paths.timing import Constant as Constant
from holdfast.paths.timing import Timing as Timing
from holdfast.paths.timing import Trapezoid as Trapezoid
