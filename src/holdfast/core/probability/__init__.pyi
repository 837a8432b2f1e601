from holdfast.core.probability.distribution import Distribution as Distribution
from holdfast.core.probability.intervals import Difference as Difference
from holdfast.core.probability.intervals import Interval as Interval
