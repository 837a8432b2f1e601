"""Train a policy by soft actor-critic (Haarnoja et al., 2018) on one core of a processor, with PyTorch.

A run is stored from time to time and goes on from there; it gives the same weights on the same machine with the same versions.
"""

from __future__ import annotations

import argparse
import itertools
import time
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import torch
from torch import Tensor
from torch.nn import functional

from holdfast.faults import Faults, FaultWrapper
from papers.faults.policy.network import HIGHEST, LOWEST, Policy
from papers.faults.policy.task import JOINTS, NAME, NEAR, STEPS, kinds, off

HERE = Path(__file__).parent
WIDTH, BATCH = 128, 128
FIRST = 5_000  # steps at random actions, which also tell how observations are scaled
RATE, DISCOUNT, FOLLOW = 7e-4, 0.98, 0.005
STORED, WATCHED, SHOWN = 20_000, 10_000, 20  # steps between; episodes
CHECK = 10**6  # seeds of the episodes that are watched meanwhile begin here
PROBABILITY = 0.1  # of each kind in an episode with faults
EVERY = 2  # steps for each update of the networks
BEHIND = 0.07  # m, seen from the goal


def reward_of(seen: Any, action: Any) -> float:
    """What it learns from, which leads to the object's far side; the environment's own leads on top of the object."""
    tip, thing, goal = seen[14:17], seen[17:20], seen[20:23]
    way = np.append((goal - thing)[:2], 0.0)
    left = float(np.linalg.norm(way))
    behind = thing - BEHIND * way / max(left, 0.02)
    near = float(np.linalg.norm(tip - behind))
    return 0.1 * (left <= NEAR) - 0.5 * near - 3 * left - 0.005 * float(np.square(action).sum())


class Learner:
    """Networks, optimisers and what was seen: all that a run consists of."""

    def __init__(self, seed: int, steps: int, sizes: tuple[int, int], limit: float) -> None:
        torch.manual_seed(seed)
        m, n = sizes
        self.n, self.limit, self.steps, self.count = n, limit, steps, 0
        self.actor = _layers(1, (m, WIDTH, WIDTH, 2 * n))
        self.critics = _layers(2, (m + n, WIDTH, WIDTH, 1))
        self.targets = [part.detach().clone() for part in self.critics]
        self.heat = torch.zeros((), requires_grad=True)  # logarithm of the temperature
        parts = (self.actor, self.critics, [self.heat])
        self.optimisers = [torch.optim.Adam(part, RATE, fused=True) for part in parts]
        self.seen = [torch.zeros(steps, size) for size in (m, n, 1, m)]  # observation, action, reward, what followed
        self.centre, self.spread = torch.zeros(m), torch.ones(m)
        self.minutes = 0.0

    def action(self, observation: Any) -> Any:
        """(n,) drawn, in -1 to 1."""
        if self.count < FIRST:
            return (2 * torch.rand(self.n) - 1).numpy()
        with torch.no_grad():
            x = (torch.as_tensor(observation, dtype=torch.float32) - self.centre) / self.spread
            return self._drawn(x[None, None])[0][0, 0].numpy()

    def note(self, observation: Any, action: Any, reward: float, following: Any) -> None:
        """A step."""
        for kept, part in zip(self.seen, (observation, action, [reward], following), strict=True):
            kept[self.count] = torch.as_tensor(np.asarray(part, dtype=np.float32))
        self.count += 1
        if self.count == FIRST:
            seen = self.seen[0][:FIRST]
            self.centre, self.spread = seen.mean(0), seen.std(0).clamp(min=0.05)

    def update(self) -> None:
        """One step of all three optimisers."""
        rows = torch.randint(self.count, (BATCH,))
        before, action, reward, after = (part[rows] for part in self.seen)
        before, after = ((x - self.centre) / self.spread for x in (before, after))
        heat = self.heat.exp().detach()
        with torch.no_grad():
            chosen, likely = self._drawn(after[None])
            worth = _through(self.targets, torch.cat([after[None], chosen], -1)).amin(0) - heat * likely[0]
            wanted = reward + DISCOUNT * worth
        told = _through(self.critics, torch.cat([before, action], -1)[None])
        self._descend(1, functional.mse_loss(told, wanted.expand(2, -1, -1), reduction="sum") / BATCH)
        chosen, likely = self._drawn(before[None])
        fixed = [part.detach() for part in self.critics]
        worth = _through(fixed, torch.cat([before[None], chosen], -1)).amin(0)
        self._descend(0, (heat * likely[0] - worth).mean())
        self._descend(2, -self.heat * (likely.detach().mean() - self.n))
        torch._foreach_lerp_(self.targets, [part.detach() for part in self.critics], FOLLOW)

    def policy(self, about: dict[str, str]) -> Policy:
        """As it is now."""
        parts = [part.detach().numpy()[0].copy() for part in self.actor]
        layers = tuple((parts[k], parts[k + 1][0]) for k in range(0, len(parts), 2))
        return Policy(self.centre.numpy(), self.spread.numpy(), layers, self.limit, about)

    def save(self, file: Path) -> None:
        """All of it, so that a run goes on as if it had not stopped."""
        parts: dict[str, Any] = {name: value for name, value in vars(self).items() if name not in ("optimisers", "seen")}
        parts["optimisers"] = [one.state_dict() for one in self.optimisers]
        parts["seen"] = [part[: self.count].clone() for part in self.seen]
        torch.save({**parts, "random": torch.get_rng_state()}, file.with_suffix(".part"))
        file.with_suffix(".part").replace(file)

    def resume(self, file: Path) -> None:
        """As :meth:`save` left it."""
        parts = torch.load(file)
        torch.set_rng_state(parts.pop("random"))
        for one, state in zip(self.optimisers, parts.pop("optimisers"), strict=True):
            one.load_state_dict(state)
        for mine, kept in zip(self.seen, parts.pop("seen"), strict=True):
            mine[: len(kept)] = kept
        with torch.no_grad():
            for name in ("actor", "critics", "targets"):
                for mine, kept in zip(getattr(self, name), parts.pop(name), strict=True):
                    mine.copy_(kept)
            self.heat.copy_(parts.pop("heat"))
        vars(self).update({name: parts[name] for name in ("count", "centre", "spread", "minutes")})

    def _drawn(self, x: Tensor) -> tuple[Tensor, Tensor]:
        """Actions in -1 to 1, and the logarithm of how likely they were."""
        mean, deviation = _through(self.actor, x).chunk(2, -1)
        deviation = deviation.clamp(LOWEST, HIGHEST)
        noise = torch.randn_like(mean)
        raw = mean + deviation.exp() * noise
        # log(1 - tanh(u)^2), without loss where u is large
        squashed = 2 * (np.log(2) - raw - functional.softplus(-2 * raw))
        likely = -0.5 * noise.square() - deviation - 0.5 * np.log(2 * np.pi) - squashed
        return raw.tanh(), likely.sum(-1, keepdim=True)

    def _descend(self, which: int, loss: Tensor) -> None:
        self.optimisers[which].zero_grad()
        loss.backward()
        self.optimisers[which].step()


def _layers(networks: int, sizes: Sequence[int]) -> list[Tensor]:
    """Weights and offsets of networks side by side."""
    made = []
    for below, above in itertools.pairwise(sizes):
        for shape in ((networks, below, above), (networks, 1, above)):
            made.append(((2 * torch.rand(shape) - 1) / below**0.5).requires_grad_())
    return made


def _through(layers: Sequence[Tensor], x: Tensor) -> Tensor:
    x = x.expand(layers[0].shape[0], -1, -1)
    for k in range(0, len(layers), 2):
        x = torch.baddbmm(layers[k + 1], x, layers[k])
        x = x.relu() if k + 2 < len(layers) else x
    return x


def watched(env: Any, policy: Policy) -> tuple[float, float, float]:
    """The fraction of episodes that end with the object at the goal, and the environment's mean return."""
    done = total = left = 0.0
    for k in range(SHOWN):
        observation, _ = env.reset(seed=CHECK + k)
        for _ in range(STEPS):
            observation, reward, *_ = env.step(policy(observation))
            total += reward
        done, left = done + (off(env) <= NEAR), left + off(env)
    return done / SHOWN, left / SHOWN, total / SHOWN


def train(learner: Learner, env: Any, seed: int, store: Path) -> None:
    """Up to the number of steps, stored on the way."""
    healthy, since = gymnasium.make(NAME), time.process_time()
    while learner.count < learner.steps:
        episode = learner.count // STEPS
        observation, _ = env.reset(seed=1000 * seed + episode, options={"episode": episode})
        for _ in range(STEPS):
            action = learner.action(observation)
            following, *_ = env.step(learner.limit * action)
            learner.note(observation, action, reward_of(following, action), following)
            observation = following
            if learner.count >= FIRST and learner.count % EVERY == 0:
                learner.update()
        if learner.count % WATCHED == 0:
            learner.minutes, since = learner.minutes + (time.process_time() - since) / 60, time.process_time()
            done, left, total = watched(healthy, learner.policy({}))
            print(
                f"step {learner.count}: done {done:.0%}, {100 * left:.1f} cm off, return {total:.1f}, temperature "
                f"{learner.heat.exp().item():.3f}, {learner.minutes:.1f} min",
                flush=True,
            )
            if learner.count % STORED == 0:
                learner.save(store)


def main() -> None:
    """Train, and write the weights beside this file."""
    parser = argparse.ArgumentParser(prog="python -m papers.faults.policy.train", description=__doc__)
    parser.add_argument("--faults", action="store_true", help="joints fail in most of the episodes that it learns from")
    parser.add_argument("--steps", type=int, default=400_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--store", type=Path, required=True, help="a folder for what a run goes on from")
    parser.add_argument("--out", type=Path, help="the file of the weights; beside this script if not given")
    chosen = parser.parse_args()
    torch.set_num_threads(1)
    name = "faults" if chosen.faults else "healthy"
    what = Faults(list(kinds((0.0, 3.0), PROBABILITY).values()) if chosen.faults else [], chosen.seed)
    env = FaultWrapper(gymnasium.make(NAME), what, joints=JOINTS)
    (m,), (n,) = env.observation_space.shape, env.action_space.shape
    learner = Learner(chosen.seed, chosen.steps, (m, n), float(env.action_space.high[0]))
    chosen.store.mkdir(parents=True, exist_ok=True)
    file = chosen.store / f"{name}-{chosen.seed}.pt"
    if file.exists():
        learner.resume(file)
    train(learner, env, chosen.seed, file)
    about = {"seed": chosen.seed, "steps": chosen.steps, "minutes": f"{learner.minutes:.0f}"}
    about |= {package: version(package) for package in ("torch", "numpy", "mujoco", "gymnasium")}
    learner.policy({key: str(value) for key, value in about.items()}).save(chosen.out or HERE / f"{name}.npz")


if __name__ == "__main__":
    main()
