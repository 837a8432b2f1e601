from holdfast.probability.distribution import Distribution as Distribution
from holdfast.probability.intervals import Difference as Difference
from holdfast.probability.intervals import Interval as Interval
