"""Presentation of the bounds of residuals: false alarms, delays, and the fitted model."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.presentation import Header, Presentation, TableSpec
from holdfast.response.diagnosis.bounds import Bounds


def to_dict(bounds: Bounds) -> dict[str, Any]:
    """Return the bounds with their rate of false alarms."""
    rates = bounds.false_alarms()
    return {**vars(bounds), "false_alarms_per_hour": rates and rates[0], "upper_limit_per_hour": rates and rates[1]}


def present(bounds: Bounds) -> Presentation:
    """Present the hours of calibration, the rate of false alarms, and the monitored signals."""
    lines = ["false alarms: unknown; calibrate with two records or more"]
    rates = bounds.false_alarms()
    if rates is not None:
        lines = [
            f"false alarms: {bounds.alarms} where each record is watched with the bounds of the others; with 95 % confidence "
            f"fewer than {rates[1]:.3g} an hour, for this arm and motion as it was recorded"
        ]
    if (bounds.speed > 0).any():
        delays = bounds.lock_delays()
        slowest = int(np.where(np.isfinite(delays), delays, -1.0).argmax())
        lines.append(
            f"a joint that locks while it moves at half its fastest calibrated speed is detected by its position after at most "
            f"{1e3 * delays[slowest]:.0f} ms ({bounds.joints[slowest]}); its torque usually shows it earlier"
        )
    if (bounds.scales != 1).any():
        smallest, largest = bounds.scales.min(), bounds.scales.max()
        lines.append(f"friction and masses are fitted to the records, masses {smallest:.2f} to {largest:.2f} times the arm's")
    missing = [] if np.isfinite(bounds.torque).all() else ["torques"]
    missing += [] if np.isfinite(bounds.position) else ["the measured tool pose"]
    lines += [f"not watched: {signal} (not in the records)" for signal in missing]
    columns = [
        Header("joint", "joint"),
        Header("torque", "residual torque, N m (N)", digits=3),
        Header("tracking", "tracking, rad (m)", digits=3),
        Header("speed", "fastest, rad/s (m/s)", digits=3),
    ]
    rows = list(zip(bounds.joints, bounds.torque, bounds.tracking, bounds.speed, strict=True))
    return Presentation(
        "Bounds of residuals",
        f"The bounds are those of {bounds.logs} record{'s' * (bounds.logs != 1)}, {bounds.hours:.3g} h of healthy motion at "
        f"{bounds.rate:.4g} Hz.",
        lines=[f"{capitalise_first(line)}." for line in lines],
        tables=[TableSpec("Bounds", columns, rows)],
    )
