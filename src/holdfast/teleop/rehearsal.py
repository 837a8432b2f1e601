"""A whole experiment with simulated people: the same protocol, the same records, in seconds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.engine.folder import difference, held
from holdfast.errors import InputError, StoreError
from holdfast.files import reading
from holdfast.notice import aside, says
from holdfast.teleop.bank.tasks import drive_tasks
from holdfast.teleop.protocol.order import Indices
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import Kind, State, Subject, Who
from holdfast.teleop.records.file import FILE, LOCK
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import completion_times, done, training_scenario, training_tasks
from holdfast.teleop.trials.operators import Person, SimulatedPeople, population, rate
from holdfast.teleop.trials.recordings import End, Trials
from holdfast.teleop.trials.scenarios import PointTasks

OPERATORS_PER_BATCH = 64  # their trials are driven together and held in memory


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

    A stopped experiment is resumed by the same call: each round of training, and the session of each operator, is recorded as
    a whole or not at all, and the resumed experiment has the same results as one that was not stopped.

    Args:
        folder: A new or empty folder, or the folder of the same experiment.
        protocol: What is done.
        operators: How many, drawn from :func:`holdfast.teleop.population`, or who.
        seed: Of the people and of their noise.
        progress: Is told how far it is.

    Returns:
        The records, open. Subjects are marked *simulated*.

    Raises:
        StoreError: The folder holds something else, another program writes to it, or it cannot be written.
        InputError: Fewer than one operator.
    """
    say = progress or (lambda text: None)
    people_seed, training_seed, trial_seed, rating_seed = (
        int(s.generate_state(1)[0]) for s in np.random.SeedSequence(seed).spawn(4)
    )
    people = population(operators, people_seed) if isinstance(operators, int) else list(operators)
    if not people:
        raise InputError("there are no simulated operators; give 1 or more")
    records = _open(Path(folder), protocol, operators, seed)
    try:
        with held(records.folder, LOCK):
            subjects = _enrol(records, people)
            trained = _train(records, subjects, people, training_seed, say)
            ready = [k for k, ok in enumerate(trained) if ok]
            seeds = [trial_seed, rating_seed]
            for first in range(0, len(ready), OPERATORS_PER_BATCH):
                batch = ready[first : first + OPERATORS_PER_BATCH]
                _run_sessions(records, [subjects[k] for k in batch], [people[k] for k in batch], seeds, say)
                seeds = [int(np.random.SeedSequence(s).generate_state(1)[0]) for s in seeds]
    except BaseException:
        records.close()
        raise
    return records


def _open(folder: Path, protocol: Protocol, operators: int | Sequence[Person], seed: int) -> Records:
    """Create the records of a simulated experiment, or open those that the same call began.

    Raises:
        StoreError: The folder holds another experiment or something else.
    """
    content = sha256(f"{protocol.text()}{protocol.arm.fingerprint}".encode()).hexdigest()[:8]
    people = {"number of operators": operators} if isinstance(operators, int) else {"people": [vars(p) for p in operators]}
    plan: dict[str, Any] = {**people, "protocol": f"{protocol.name} ({content})", "seed": int(seed)}
    if not reading.exists(folder / FILE):
        return Records.create(folder, protocol, plan)
    records = Records.open(folder)
    plan_of_folder = records.simulation
    if plan_of_folder is None:
        problem = "an experiment that does not state how it was simulated"
    elif other := difference(plan_of_folder, plan):
        problem = f"another simulated experiment: {other}"
    else:
        return records
    records.close()
    raise StoreError(f"'{folder}' holds {problem}; give another folder")


def _enrol(records: Records, people: Sequence[Person]) -> list[Subject]:
    """Add the subjects, or read them and say how much of the experiment is recorded already.

    Raises:
        StoreError: Subjects were added or deleted since.
    """
    subjects = records.subjects()
    if not subjects:
        with records.together():
            return [records.add_subject(kind=Who.SIMULATED) for _ in people]
    if [s.number for s in subjects] != list(range(len(people))):
        raise StoreError(f"'{records.folder}' has lost or got subjects since it was simulated; give another folder")
    training, sessions = len(records.entries(kind=Kind.TRAINING)), len({e.subject for e in records.entries(kind=Kind.TRIAL)})
    recorded = f"{training} training tasks and the sessions of {sessions} of {len(people)} operators"
    aside(f"'{records.folder}' already holds {recorded}")
    return subjects


def _train(
    records: Records, subjects: list[Subject], people: Sequence[Person], seed: int, say: Callable[[str], None]
) -> list[bool]:
    """Do training tasks that are not recorded yet, in rounds, until each subject meets the criterion or has done all.

    Returns:
        Whether each subject meets the criterion; the others have dropped out.
    """
    protocol = records.protocol
    criterion, scenario = protocol.training, training_scenario(protocol)
    tasks = [training_tasks(protocol, s.number) for s in subjects]
    recorded = [completion_times(records, done(records.entries(s.code, Kind.TRAINING))) for s in subjects]
    cycles: list[list[float]] = [[] for _ in subjects]
    first, seeds = 0, np.random.SeedSequence(seed)
    while first < criterion.most:
        busy = [k for k in range(len(subjects)) if not criterion.trained(cycles[k]) and len(cycles[k]) == first]
        if not busy:
            break
        # Nobody is trained before the least number of tasks: these are done side by side.
        count = min(criterion.at_least if first == 0 else 1, criterion.most - first)
        noise = int(seeds.spawn(1)[0].generate_state(1)[0])
        if any(len(recorded[k]) == first for k in busy):
            say(f"training: {len(busy)} operators, {first + count} tasks")
            rows = np.arange(first, first + count)
            batch = [tasks[k].take(rows) for k in busy]
            joined = PointTasks(*(np.concatenate([getattr(b, name) for b in batch]) for name in ("q0", "target", "joint")))
            who = np.repeat(busy, count)
            trials = _driven(protocol, joined, np.full(len(who), scenario), [people[k] for k in who], noise)
            with records.together():
                for i, k in enumerate(who):
                    recorded[k].append(float(trials.cycles[i]) if trials.completed[i] else np.nan)
                    position = first + i % count
                    _record(records, subjects[k].code, Kind.TRAINING, position, scenario, joined, i, -1, trials)
        for k in busy:
            cycles[k] += recorded[k][first : first + count]
        first += count
    trained = [criterion.trained(c) for c in cycles]
    for subject, ok in zip(subjects, trained, strict=True):
        if not ok and subject.state == State.OPEN:
            records.set_state(subject.code, State.DROPPED)
    return trained


def _run_sessions(
    records: Records, subjects: list[Subject], people: list[Person], seeds: Sequence[int], say: Callable[[str], None]
) -> None:
    """Do the sessions of a batch of subjects, and record those that are not recorded yet, each as a whole or not at all.

    Args:
        records: The records.
        subjects: The batch.
        people: Who they are.
        seeds: Of the trials and of the ratings.
        say: Is told how far it is.
    """
    missing = [k for k, s in enumerate(subjects) if not records.entries(s.code, Kind.TRIAL)]
    if not missing:
        return
    protocol = records.protocol
    sessions = [protocol.session(s.row, s.number) for s in subjects]
    order = np.concatenate(sessions)
    who = np.repeat(np.arange(len(subjects)), [len(s) for s in sessions])
    say(f"{len(order)} trials")
    tasks = protocol.tasks.take(order[:, 0])
    trials = _driven(protocol, tasks, order[:, 1], [people[k] for k in who], seeds[0])
    start = protocol.plants[0].position(protocol.tasks.q0)
    ideal = (np.linalg.norm(protocol.tasks.target - start, axis=1) - protocol.radius) / protocol.stick.limit
    time = np.where(trials.completed, trials.cycles, np.nan)
    ratings = rate(time, ideal[order[:, 0]], len(protocol.rating), seed=seeds[1])
    for k in missing:
        say(f"recording the session of {subjects[k].code}")
        with records.together():
            for position, i in enumerate(np.flatnonzero(who == k).tolist()):
                task, scenario = order[i].tolist()
                number = _record(records, subjects[k].code, Kind.TRIAL, position, scenario, tasks, i, task, trials)
                records.rate(number, int(ratings[i]))
            records.set_state(subjects[k].code, State.COMPLETED)


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
