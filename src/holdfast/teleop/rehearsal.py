"""A whole experiment with simulated people: the same protocol, the same records, in seconds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from holdfast.errors import InputError
from holdfast.notice import says
from holdfast.teleop.bank.tasks import drive_tasks
from holdfast.teleop.protocol.order import Indices
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import Kind, State, Subject, Who
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import training_scenario, training_tasks
from holdfast.teleop.trials.operators import Person, SimulatedPeople, population, rate
from holdfast.teleop.trials.recordings import End, Trials
from holdfast.teleop.trials.scenarios import PointTasks


@says("simulating the experiment", counts=False)
def simulate_experiment(
    folder: str | Path,
    protocol: Protocol,
    operators: int | Sequence[Person] = 24,
    *,
    seed: int = 0,
    progress: Callable[[str], None] | None = None,
) -> Records:
    """Run an experiment with simulated people, from training to the last rating, and record it.

    Args:
        folder: A new or empty folder.
        protocol: What is done.
        operators: How many, drawn from :func:`holdfast.teleop.population`, or who.
        seed: Of the people and of their noise.
        progress: Is told how far it is.

    Returns:
        The records, open. Subjects are marked *simulated*.

    Raises:
        StoreError: The folder is not empty, or cannot be written.
        InputError: Fewer than one operator.
    """
    say = progress or (lambda text: None)
    people_seed, training_seed, trial_seed, rating_seed = (
        int(s.generate_state(1)[0]) for s in np.random.SeedSequence(seed).spawn(4)
    )
    people = population(operators, people_seed) if isinstance(operators, int) else list(operators)
    if not people:
        raise InputError("there are no simulated operators; give 1 or more")
    records = Records.create(folder, protocol)
    with records.together():
        subjects = [records.add_subject(kind=Who.SIMULATED) for _ in people]
    trained = _train(records, subjects, people, training_seed, say)
    for subject, ok in zip(subjects, trained, strict=True):
        if not ok:
            records.set_state(subject.code, State.DROPPED)
    going = [k for k, ok in enumerate(trained) if ok]
    sessions = [protocol.session(subjects[k].row, subjects[k].number) for k in going]
    order = np.concatenate([*sessions, np.empty((0, 2), dtype=np.int64)])
    who = np.repeat(np.array(going, dtype=np.int64), len(protocol.tasks) * len(protocol.scenarios))
    say(f"{len(order)} trials")
    tasks = protocol.tasks.take(order[:, 0])
    trials = _driven(protocol, tasks, order[:, 1], [people[k] for k in who], trial_seed)
    start = protocol.plants[0].position(protocol.tasks.q0)
    ideal = (np.linalg.norm(protocol.tasks.target - start, axis=1) - protocol.radius) / protocol.stick.limit
    time = np.where(trials.completed, trials.cycles, np.nan)
    ratings = rate(time, ideal[order[:, 0]], len(protocol.rating), seed=rating_seed)
    say("writing the records")
    position = np.concatenate([*(np.arange(len(s)) for s in sessions), np.empty(0, dtype=np.int64)])
    with records.together():
        for i in range(len(order)):
            code, task, scenario = subjects[who[i]].code, int(order[i, 0]), int(order[i, 1])
            number = _record(records, code, Kind.TRIAL, int(position[i]), scenario, tasks, i, task, trials)
            records.rate(number, int(ratings[i]))
        for k in going:
            records.set_state(subjects[k].code, State.COMPLETED)
    return records


def _train(
    records: Records, subjects: list[Subject], people: Sequence[Person], seed: int, say: Callable[[str], None]
) -> list[bool]:
    """Training tasks, one round after the other, until each meets the criterion or has done all."""
    protocol = records.protocol
    criterion, scenario = protocol.training, training_scenario(protocol)
    tasks = [training_tasks(protocol, s.number) for s in subjects]
    cycles: list[list[float]] = [[] for _ in subjects]
    done, seeds = 0, np.random.SeedSequence(seed)
    while True:
        busy = [k for k in range(len(subjects)) if not criterion.trained(cycles[k]) and len(cycles[k]) == done]
        if not busy or done >= criterion.most:
            return [criterion.trained(c) for c in cycles]
        # Nobody is trained before the least number of tasks: these are done side by side.
        count = min(criterion.at_least if done == 0 else 1, criterion.most - done)
        say(f"training: {len(busy)} operators, {done + count} tasks")
        rows = np.arange(done, done + count)
        batch = [tasks[k].take(rows) for k in busy]
        joined = PointTasks(*(np.concatenate([getattr(b, name) for b in batch]) for name in ("q0", "target", "joint")))
        who = np.repeat(busy, count)
        noise = int(seeds.spawn(1)[0].generate_state(1)[0])
        trials = _driven(protocol, joined, np.full(len(who), scenario), [people[k] for k in who], noise)
        with records.together():
            for i, k in enumerate(who):
                cycles[k].append(float(trials.cycles[i]) if trials.completed[i] else np.nan)
                _record(records, subjects[k].code, Kind.TRAINING, done + i % count, scenario, joined, i, -1, trials)
        done += count


def _driven(protocol: Protocol, tasks: PointTasks, scenario: Indices, people: list[Person], seed: int) -> Trials:
    operator = SimulatedPeople(people, protocol.rate, protocol.stick, radius=protocol.radius, seed=seed)
    return drive_tasks(protocol.plants, protocol.scenarios, scenario, tasks, operator, protocol.stick, protocol.rules)


def _record(
    records: Records,
    code: str,
    kind: Kind,
    position: int,
    scenario: int,
    tasks: PointTasks,
    i: int,
    task: int,
    trials: Trials,
) -> int:
    """Write trial i of a batch; its number in the records."""
    number = records.begin_trial(code, kind, position, scenario=scenario, tasks=tasks.take(np.array([i])), task=task)
    cycles = slice(trials.first[i], trials.first[i + 1])
    time = np.arange(trials.cycles[i]) / records.protocol.rate
    records.append(number, 0, time, velocity=trials.velocity[cycles], q=trials.q[cycles])
    records.finish(number, End(trials.end[i]), trials.q_end[i])
    return number
