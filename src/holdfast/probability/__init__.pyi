from holdfast.probability.distribution import Distribution as Distribution
from holdfast.probability.distribution import Interval as Interval
