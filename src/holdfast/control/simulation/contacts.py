"""Contacts of runs on their way, and the runs stopped at their first contact."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from holdfast.control.simulation.runs import Reason, Runs
from holdfast.core.progress import track
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.contacts import Contact, find_first_contacts

_END_FIELDS = ("code", "q_final", "x_final", "error", "closest", "path_length", "q_low", "q_high", "limits_passed", "time")


def add_contacts(runs: Runs, clearance: Clearance, stop: bool) -> Runs:
    """Return the runs with their contacts, stopped at the first contact if required, and otherwise unchanged.

    Every run is simulated again, one after the other; of one that repeats its motion the first 200/Ke are checked.
    """
    contacts: list[Contact] = []
    for run in track("runs looked at for contacts", range(len(runs))):
        if runs.reason[run] != Reason.BAD_INPUT:
            end_time = runs.checked_until(run)
            time, motion = runs._simulator.replay_run(runs, run, end_time)
            time = np.unique(np.minimum(time, end_time))
            contacts += [replace(contact, run=run) for contact in find_first_contacts(clearance, time, motion(time), motion)]
    runs = replace(runs, clearance=clearance, contacts=tuple(contacts))
    return _stop_at_contacts(runs, clearance) if stop else runs


def _stop_at_contacts(runs: Runs, clearance: Clearance) -> Runs:
    """Return runs that end at their first contact: all joints are locked from then on."""
    stop_times = np.array([np.inf if contact is None else contact.time for contact in runs.first_contacts])
    stop_times = np.ceil(stop_times) if runs.cycles else stop_times
    runs = replace(runs, stopped=stop_times)
    rows = np.flatnonzero(np.isfinite(stop_times))
    if rows.size:
        stopped_runs = runs._simulator.run(runs.q0[rows], runs.target[rows], runs.held_from[rows], runs._settings)
        fields = {name: getattr(runs, name).copy() for name in (*_END_FIELDS, "reason")}
        for name in _END_FIELDS:
            fields[name][rows] = getattr(stopped_runs, name)
        fields["reason"][rows], fields["time"][rows] = Reason.CONTACT, stop_times[rows]
        runs = replace(runs, **fields)
    contacts = [touch for touch in runs.contacts or () if touch.time <= stop_times[touch.run]]
    depths = -clearance.by_pair(runs.q_final[[touch.run for touch in contacts]])
    pair_columns = {name: column for column, name in enumerate(clearance.pair_names)}
    return replace(
        runs,
        contacts=tuple(
            replace(touch, depth=max(float(row[pair_columns[f"{touch.link} & {touch.object}"]]), 0.0))
            for touch, row in zip(contacts, depths, strict=True)
        ),
    )
