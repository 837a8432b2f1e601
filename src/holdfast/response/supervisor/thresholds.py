"""Thresholds of the fault-tolerant controller, shared by the Python controller and the exported C++ controller."""

from __future__ import annotations

EARLY_BRAKE_DELAY_S = 0.020  # after the alarm, a joint that does not move or runs away is braked before its fault kind is known
NAMING_DEADLINE_S = 2.0  # after the alarm, the arm stops if the monitor has not named a joint
VERDICT_DEADLINE_S = 0.6  # after the alarm, a verdict is final; before, further tool poses may change it

STILL_SPEED = 0.02  # rad/s or m/s; a slower joint counts as at rest
MOVING_SPEED = 0.2  # rad/s or m/s; only a faster joint can count as running away
RUNAWAY_SPEED_ERROR = 0.3  # rad/s or m/s between the measured and the commanded rate
LAGGING_TRACKING_RATIO = 1.5  # tracking error divided by the monitor's threshold
RUNAWAY_TRACKING_RATIO = 8.0  # tracking error divided by the threshold; lower for a falling joint, whose servo saturates nearby

SLOW_PACE = 0.3  # fraction of the commanded speed during a contact and until the fault kind is known
REDUCED_PACE = 0.5  # fraction of the commanded speed with a weak motor or more friction
TRIAL_PACE = 0.2  # fraction of a route's speed with a joint on trial
TRIAL_SPEED_FRACTION = 0.8  # fraction of the speed that a lagging joint on trial has reached
PACE_RATE_PER_S = 5.0  # change of the pace; from standstill to the commanded speed, and back, in 0.2 s

CONTACT_END_S = 1.0  # after this time a contact is over
GRAVITY_SAFETY_FACTOR = 1.2  # a weak motor must be able to carry gravity times this factor
SETTLING_TIME_S = 0.05  # after braking
MIN_POSE_SAMPLES = 10  # measured tool poses that determine the position of a braked joint
LATE_SAMPLES_WAIT_S = 0.5  # additional waiting time for measured tool poses that arrive more slowly
SENSOR_TOLERANCE = 1e-3  # rad or m; a sensor is trusted if the measured tool pose agrees to within this distance

MIN_CALIBRATED_SPEED = 0.1  # rad/s or m/s that a joint may have although it hardly moved in calibration
IDLE_SPEED = 1e-3  # rad/s or m/s; a law that commands less has ended
SLOWING_KINDS = frozenset({"weak", "friction", "sluggish"})  # fault kinds with which a joint still follows, more slowly
