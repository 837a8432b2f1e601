"""Presentation of detection thresholds: false alarms, delays, and the fitted model."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_number
from holdfast.interface.presentation.presentation import Presentation, TableSpec, make_headers
from holdfast.response.diagnosis.bounds import Bounds


def to_dict(bounds: Bounds) -> dict[str, Any]:
    """Return the thresholds with their rate of false alarms."""
    rates = bounds.false_alarms()
    return {**vars(bounds), "false_alarms_per_hour": rates and rates[0], "upper_limit_per_hour": rates and rates[1]}


def present(bounds: Bounds) -> Presentation:
    """Present the duration of the calibration, the rate of false alarms, and the monitored signals."""
    lines = ["the rate of false alarms is unknown; calibrate with at least two logs"]
    rates = bounds.false_alarms()
    if rates is not None:
        lines = [
            f"false alarms: {bounds.alarms} if each log is monitored with thresholds from the others; with 95 % confidence "
            f"fewer than {format_number(rates[1], 3)} per hour, for this arm and the recorded kind of motion"
        ]
    if (bounds.speed > 0).any():
        delays = bounds.lock_delays()
        slowest = int(np.where(np.isfinite(delays), delays, -1.0).argmax())
        lines.append(
            f"a joint that locks at half its fastest calibrated speed is detected by its tracking error after at most "
            f"{1e3 * delays[slowest]:.0f} ms ({bounds.joints[slowest]}); its torque usually reveals the lock earlier"
        )
    if (bounds.scales != 1).any():
        smallest, largest = bounds.scales.min(), bounds.scales.max()
        lines.append(f"friction and masses are fitted to the logs, masses to {smallest:.2f} to {largest:.2f} times the model's")
    missing = [] if np.isfinite(bounds.torque).all() else ["torques"]
    missing += [] if np.isfinite(bounds.position) else ["the measured tool pose"]
    lines += [f"not monitored: {signal} (not in the logs)" for signal in missing]
    labels = ("residual torque, N m (N)", "tracking, rad (m)", "largest speed, rad/s (m/s)")
    hours = f"{bounds.hours:.3g} h" if bounds.hours >= 0.1 else f"{format_number(3600 * bounds.hours, 3)} s"
    rows = list(zip(bounds.joints, bounds.torque, bounds.tracking, bounds.speed, strict=True))
    return Presentation(
        "Detection thresholds",
        f"The thresholds come from {bounds.logs} log{'s' * (bounds.logs != 1)} with {hours} of "
        f"healthy motion at {bounds.rate:.4g} Hz.",
        lines=[f"{capitalise_first(line)}." for line in lines],
        tables=[TableSpec("Thresholds", ["joint", *make_headers(*labels, digits=3)], rows)],
    )
