"""How often a learned policy finishes under each kind of fault, of all episodes and of those that can be finished."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Sequence
from datetime import datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

from holdfast.response.faults import FaultWrapper
from measurements.faults.policy.network import Policy, load
from measurements.faults.policy.task import NEAR, ONSET, STEPS, environment, finished, kinds
from measurements.faults.policy.teacher import PARTS, Teacher
from measurements.faults.store import limits

HERE = Path(__file__).parent
HEALTHY = "none"
COUNTED = [HEALTHY, *(kind for kind in kinds() if kind != "slipping_clutch")]
POLICIES = {"healthy": "learned from healthy episodes", "faults": "learned with faults"}
FIRST, SEED = 2 * 10**6, 25  # seeds of the episodes begin here; of the faults
LIGHT = 0.02  # m/rad: the fork's orientation hardly counts
Drivers = dict[str, Callable[[FaultWrapper], Callable[[Any], Any]]]


def drivers(policies: dict[str, Policy]) -> Drivers:
    """Policies, the controller that knows the fault, and its other ways to push, which try what nobody has finished."""
    found: Drivers = {name: lambda env, policy=policy: policy for name, policy in policies.items()}  # type: ignore[misc]
    found["known"] = lambda env: Teacher(env, knows=True)
    for part in range(len(PARTS)):
        for rotation in (None, LIGHT):
            options = {"part": part} if rotation is None else {"part": part, "rotation": rotation}
            found[f"way {part} {rotation or ''}".strip()] = lambda env, o=options: Teacher(env, knows=True, **o)  # type: ignore[misc]
    return found


def outcomes(kind: str, count: int, chosen: Drivers, known: dict[str, list[bool]]) -> dict[str, list[bool]]:
    """For each driver whether it finished; ways to push are tried where nobody before has."""
    env, done = environment(kinds().get(kind), SEED), dict(known)
    for name, driver in chosen.items():
        told = done.setdefault(name, [])
        act = driver(env)
        for k in range(len(told), count):
            idle = name.startswith("way") and any(other[k] for other in done.values() if len(other) > k)
            told.append(False if idle else finished(env, act, seed=FIRST + k, episode=k))
    env.close()
    return done


def row(kind: str, done: dict[str, list[bool]]) -> list[str]:
    """A line of the table."""
    count = len(done["known"])
    can = [any(told[k] for told in done.values()) for k in range(count)]
    shown = [kind, percent(sum(can), count), percent(sum(done["known"]), count)]
    for name in POLICIES:
        shown += [percent(sum(done[name]), count), percent(sum(done[name]), sum(can))]
    return shown


def percent(some: int, count: int) -> str:
    """Format a percentage with its exact 95 % interval."""
    return f"{100 * some / count:.1f} ({limits(some, count)})"


def text(rows: Sequence[Sequence[str]], count: int, policies: dict[str, Policy]) -> str:
    """POLICY.md."""
    made = ", ".join(f"{name} {version(name)}" for name in ("holdfast", "numpy", "mujoco", "gymnasium"))
    head = ["fault", "can be finished", "known fault"]
    for what in POLICIES.values():
        head += [what, "of those that can be finished"]
    about = [f"- {POLICIES[k]}: " + ", ".join(f"{key} {value}" for key, value in p.about.items()) for k, p in policies.items()]
    return "\n".join(
        [
            "# A learned policy on Pusher-v5 when a joint fails",
            "",
            f"Written by `python -m measurements.faults.policy --count {count}` on {datetime.now():%Y-%m-%d} with {made}. "
            f"Everything is "
            "**simulated**.",
            "",
            ABOUT,
            "",
            *about,
            "",
            f"{count} episodes of each kind, in per cent, with Clopper-Pearson intervals of 95 %.",
            "",
            f"| {' | '.join(head)} |",
            "|" + "---|" * len(head),
            *(f"| {' | '.join(cells)} |" for cells in rows),
            "",
        ]
    )


ABOUT = f"""An episode counts as finished if the object's centre is within {100 * NEAR:g} cm of the goal's at the end, on
the table. It has {STEPS} steps of 0.05 s, twice as many as in the environment. The object is so light and its damping so high
that one contact moves it at about 4 cm/s however hard it is pushed, and it begins 17 to 40 cm away. One joint fails
{ONSET[0]:g} to {ONSET[1]:g} s after the start and does not recover (kinds and amounts in `task.py`). The policies are not
informed. A slipping clutch has no row, because the environment has no reference that a sensor could follow, so it equals a
lock.

A policy observes the 23 numbers of the environment, without memory, and returns 7 torques. It learned to imitate a
controller that knows the true state (`teacher.py`, data aggregation, Ross, Gordon and Bagnell, 2011). One policy learned from
healthy episodes only, and the other one with a fault in 12 of 13 episodes. There the controller knows the fault, but the
policy does not.

*Can be finished* means that one of the policies finishes the episode, or the controller that knows the fault from its onset, in
one of seven ways to push. This is a lower bound of the feasible episodes by construction and not by a proof. A better
controller may finish more episodes, and the policies would then finish a smaller fraction of those that can be finished."""


def main() -> None:
    """Count, and write POLICY.md."""
    parser = argparse.ArgumentParser(prog="python -m measurements.faults.policy", description=__doc__)
    parser.add_argument("--count", type=int, default=300, help="episodes of each kind")
    parser.add_argument("--kinds", nargs="*", default=COUNTED)
    parser.add_argument("--store", type=Path, required=True, help="a folder for what is counted, which a run goes on from")
    chosen = parser.parse_args()
    policies = {name: load(HERE / f"{name}.npz") for name in POLICIES}
    chosen.store.mkdir(parents=True, exist_ok=True)
    rows = []
    for kind in chosen.kinds:
        file = chosen.store / f"{kind}.json"
        known = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
        done = outcomes(kind, chosen.count, drivers(policies), known)
        file.write_text(json.dumps(done), encoding="utf-8")
        rows.append(row(kind, done))
        print(*rows[-1], sep=" | ", flush=True)
    if len(rows) == len(COUNTED):
        (HERE.parent / "POLICY.md").write_text(text(rows, chosen.count, policies), encoding="utf-8")


if __name__ == "__main__":
    main()
