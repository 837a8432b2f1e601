"""What runs touch on their way, and where they stop if they stop there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from holdfast.clearance.clearance import Clearance
from holdfast.clearance.contacts import Contact, first_contacts
from holdfast.notice import each
from holdfast.simulation.runs import Reason, Runs

Array = NDArray[np.float64]

_ENDS = ("code", "q_final", "x_final", "error", "closest", "path_length", "q_low", "q_high", "limits_passed", "time")


def with_contacts(runs: Runs, clearance: Clearance, stop: bool) -> Runs:
    """The same runs with what they touch; stopped there if they are to, and otherwise unchanged.

    Every run is simulated again, one after the other; of one that repeats its motion the first 200/Ke are checked.
    """
    found: list[Contact] = []
    for k in each("runs looked at for contacts", range(len(runs))):
        if runs.reason[k] != Reason.BAD_INPUT:
            end = runs.checked_until(k)
            time, at = runs._motion.recorded(runs, k, end)
            time = np.unique(np.minimum(time, end))
            found += [replace(contact, run=k) for contact in first_contacts(clearance, time, at(time), at)]
    runs = replace(runs, clearance=clearance, contacts=tuple(found))
    return _stopped(runs, clearance) if stop else runs


def _stopped(runs: Runs, clearance: Clearance) -> Runs:
    """Runs that end at their first contact: all joints are held from then on."""
    stopped = np.array([np.inf if contact is None else contact.time for contact in runs.first_contacts])
    stopped = np.ceil(stopped) if runs.cycles else stopped
    runs = replace(runs, stopped=stopped)
    rows = np.flatnonzero(np.isfinite(stopped))
    if rows.size:
        again = runs._motion.run(runs.q0[rows], runs.target[rows], runs.held_from[rows], runs._setting)
        ends = {name: getattr(runs, name).copy() for name in (*_ENDS, "reason")}
        for name in _ENDS:
            ends[name][rows] = getattr(again, name)
        ends["reason"][rows], ends["time"][rows] = Reason.CONTACT, stopped[rows]
        runs = replace(runs, **ends)
    kept = [c for c in runs.contacts or () if c.time <= stopped[c.run]]
    depths = -clearance.by_pair(runs.q_final[[c.run for c in kept]])
    names = {name: k for k, name in enumerate(clearance.pair_names)}
    return replace(
        runs,
        contacts=tuple(
            replace(c, depth=max(float(row[names[f"{c.link} & {c.object}"]]), 0.0)) for c, row in zip(kept, depths, strict=True)
        ),
    )
