"""Train a policy to do what a teacher does that knows more: data aggregation (Ross, Gordon and Bagnell, 2011).

In each round the policy acts, the more so the later, and the teacher says what it would have done; then the policy fits all
that was said so far. One core, NumPy alone; a run is stored after each round and goes on from there to the same weights.
"""

from __future__ import annotations

import argparse
import time
from importlib.metadata import version
from pathlib import Path

import numpy as np

from measurements.faults.policy import network
from measurements.faults.policy.network import Array, Policy
from measurements.faults.policy.task import LIMIT, STEPS, environment, finished, kinds
from measurements.faults.policy.teacher import Teacher

HERE = Path(__file__).parent
WIDTH, BATCH = 192, 256
ROUNDS, EPISODES = 24, 26  # rounds, and episodes in each
FITS, LAST = 1500, 20_000  # steps of Adam after each round, and after the last
LESS = 0.7  # of the steps at which the teacher acts, from one round to the next
NOISE = 0.2  # N m, on what the policy does
CHECK = 10**6  # seeds of the episodes that are watched meanwhile begin here


def said(policy: Policy | None, faulty: bool, seed: int, turn: int) -> tuple[Array, Array]:
    """What was observed in a round, (N, 23), and what the teacher said, (N, 7)."""
    fault = [None, *kinds().values()] if faulty else [None]
    seen, told = [], []
    for k in range(EPISODES):
        episode, generator = turn * EPISODES + k, np.random.default_rng([seed, turn, k])
        env = environment(fault[k % len(fault)], seed)
        teacher = Teacher(env, knows=True)
        observation, _ = env.reset(seed=1000 * seed + episode, options={"episode": episode})
        for _ in range(STEPS):
            advice = teacher()
            seen.append(observation)
            told.append(advice)
            own = policy is not None and generator.random() > LESS**turn
            action = policy(observation) if own and policy is not None else advice
            noise = NOISE * generator.standard_normal(len(advice))
            observation, *_ = env.step(np.clip(action + noise, -LIMIT, LIMIT).astype(np.float32))
    return np.array(seen, dtype=np.float32), np.array(told, dtype=np.float32)


def train(faulty: bool, seed: int, store: Path) -> Policy:
    """From where the store is to the end."""
    policy: Policy | None = None
    seen, told = np.zeros((0, 23), np.float32), np.zeros((0, 7), np.float32)
    first, minutes = 0, 0.0
    weights, records = store.with_suffix(".policy.npz"), store.with_suffix(".said.npz")
    if records.exists() and weights.exists():
        policy = network.load(weights)
        with np.load(records) as data:
            seen, told, first, minutes = data["seen"], data["told"], int(data["turns"]), float(data["minutes"])
    for turn in range(first, ROUNDS):
        since = time.process_time()
        new = said(policy, faulty, seed, turn)
        seen, told = np.concatenate([seen, new[0]]), np.concatenate([told, new[1]])
        generator = np.random.default_rng([seed, turn])
        if policy is None:
            spread = np.maximum(seen.std(0), 0.05)
            policy = network.made(seen.mean(0), spread, width=WIDTH, outputs=7, limit=LIMIT, generator=generator)
        steps = LAST if turn + 1 == ROUNDS else FITS
        left = policy.learn(seen, told, steps=steps, batch=BATCH, generator=generator)
        minutes += (time.process_time() - since) / 60
        policy.save(weights)
        np.savez(records, seen=seen, told=told, turns=turn + 1, minutes=minutes)
        line = f"round {turn + 1} of {ROUNDS}: mean square {left:.4f}, {minutes:.1f} min"
        if turn % 5 == 4:
            env = environment(None, 0)
            done = sum(finished(env, policy, seed=CHECK + k, episode=k) for k in range(20))
            line += f", {done} of 20 episodes done"
        print(line, flush=True)
    assert policy is not None
    about = {"seed": seed, "episodes": ROUNDS * EPISODES, "minutes": f"{minutes:.1f}", "faults": faulty}
    about |= {package: version(package) for package in ("numpy", "mujoco", "gymnasium")}
    return Policy(policy.centre, policy.spread, policy.layers, LIMIT, {key: str(value) for key, value in about.items()})


def main() -> None:
    """Train, and write the weights beside this file."""
    parser = argparse.ArgumentParser(prog="python -m measurements.faults.policy.train", description=__doc__)
    parser.add_argument("--faults", action="store_true", help="joints fail in most of the episodes that it learns from")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--store", type=Path, required=True, help="a folder for what a run goes on from")
    chosen = parser.parse_args()
    name = "faults" if chosen.faults else "healthy"
    chosen.store.mkdir(parents=True, exist_ok=True)
    train(chosen.faults, chosen.seed, chosen.store / f"{name}-{chosen.seed}").save(HERE / f"{name}.npz")


if __name__ == "__main__":
    main()
