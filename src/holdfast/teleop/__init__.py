"""Teleoperation experiments: tasks, protocol, recorded trials, measures, operators, and statistics.

A module belongs here if it serves the experiment in which people or simulated operators drive an arm with a joystick. The
statistics are in :mod:`holdfast.teleop.analysis`, which needs statsmodels and is not imported with the rest.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003.
"""

from holdfast.core._lazy import offer

offer(__name__)
