"""Simulation of a whole experiment with simulated people: the same protocol and the same records, in seconds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import InputError, StoreError
from holdfast.core.files import reading
from holdfast.core.progress import print_warning, reports_progress
from holdfast.core.sweeps.folder import describe_difference, lock_folder
from holdfast.core.typing import IndexArray
from holdfast.teleop.bank.tasks import drive_tasks
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import Subject, SubjectKind, SubjectState, TrialKind
from holdfast.teleop.records.file import LOCK_FILE, RECORDS_FILE
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import completion_times, find_training_scenario, select_valid_trials, training_tasks
from holdfast.teleop.trials.operators import Person, SimulatedPeople, rate_comfort, sample_people
from holdfast.teleop.trials.recordings import End, Trials
from holdfast.teleop.trials.scenarios import PointTasks

OPERATORS_PER_BATCH = 64  # operators whose trials are driven together and kept in memory


@reports_progress("simulating the experiment", passes_progress=False)
def simulate_experiment(
    folder: str | Path,
    protocol: Protocol,
    operators: int | Sequence[Person] = 24,
    *,
    seed: int = 0,
    progress: Callable[[str], None] | None = None,
) -> Records:
    """Run an experiment with simulated people, from training to the last rating, and record it.

    The same call resumes a stopped experiment. Each round of training, and the session of each operator, is recorded as a whole
    or not at all, and a resumed experiment has the same results as one that was not stopped.

    Args:
        folder: New or empty folder, or the folder of the same experiment.
        protocol: Protocol of the experiment.
        operators: Number of operators, sampled by :func:`holdfast.teleop.sample_people`, or the people themselves.
        seed: Seed of the people and of their noise.
        progress: Function that is called with a text about the progress. None: no reports.

    Returns:
        Open records, in which the subjects are marked *simulated*.

    Raises:
        StoreError: The folder contains something else, another program writes to it, or it cannot be written.
        InputError: There is no operator.
    """
    report_progress = progress or (lambda text: None)
    people_seed, training_seed, trial_seed, rating_seed = (
        int(sequence.generate_state(1)[0]) for sequence in np.random.SeedSequence(seed).spawn(4)
    )
    people = sample_people(operators, people_seed) if isinstance(operators, int) else list(operators)
    if not people:
        raise InputError("there are no simulated operators; give 1 or more")
    records = _create_or_resume_records(Path(folder), protocol, operators, seed)
    try:
        with lock_folder(records.folder, LOCK_FILE):
            subjects = _add_or_read_subjects(records, people)
            trained = _train_people(records, subjects, people, training_seed, report_progress)
            ready = [person for person, passed in enumerate(trained) if passed]
            seeds = [trial_seed, rating_seed]
            for first in range(0, len(ready), OPERATORS_PER_BATCH):
                batch = ready[first : first + OPERATORS_PER_BATCH]
                _run_sessions(
                    records,
                    [subjects[person] for person in batch],
                    [people[person] for person in batch],
                    seeds,
                    report_progress,
                )
                seeds = [int(np.random.SeedSequence(sequence).generate_state(1)[0]) for sequence in seeds]
    except BaseException:
        records.close()
        raise
    return records


def _create_or_resume_records(folder: Path, protocol: Protocol, operators: int | Sequence[Person], seed: int) -> Records:
    """Create the records of a simulated experiment, or open those that the same call began.

    Raises:
        StoreError: The folder contains another experiment or something else.
    """
    content = sha256(f"{protocol.to_yaml()}{protocol.arm.fingerprint}".encode()).hexdigest()[:8]
    people = {"number of operators": operators} if isinstance(operators, int) else {"people": [vars(p) for p in operators]}
    plan: dict[str, Any] = {**people, "protocol": f"{protocol.name} ({content})", "seed": int(seed)}
    if not reading.path_exists(folder / RECORDS_FILE):
        return Records.create(folder, protocol, plan)
    records = Records.open(folder)
    plan_of_folder = records.simulation
    if plan_of_folder is None:
        problem = "an experiment that does not state how it was simulated"
    elif other := describe_difference(plan_of_folder, plan):
        problem = f"another simulated experiment: {other}"
    else:
        return records
    records.close()
    raise StoreError(f"'{folder}' contains {problem}; give another folder")


def _add_or_read_subjects(records: Records, people: Sequence[Person]) -> list[Subject]:
    """Add the subjects, or read them and report the recorded part of the experiment.

    Raises:
        StoreError: Subjects were added or deleted since.
    """
    subjects = records.subjects()
    if not subjects:
        with records.transaction():
            return [records.add_subject(kind=SubjectKind.SIMULATED) for _ in people]
    if [s.number for s in subjects] != list(range(len(people))):
        raise StoreError(f"subjects of '{records.folder}' were added or deleted since it was simulated; give another folder")
    training = len(records.entries(kind=TrialKind.TRAINING))
    sessions = len({e.subject for e in records.entries(kind=TrialKind.TRIAL)})
    recorded = f"{training} training tasks and the sessions of {sessions} of {len(people)} operators"
    print_warning(f"'{records.folder}' already contains {recorded}")
    return subjects


def _train_people(
    records: Records, subjects: list[Subject], people: Sequence[Person], seed: int, report_progress: Callable[[str], None]
) -> list[bool]:
    """Run training tasks, in rounds, until each person meets the criterion or has done all tasks.

    Returns:
        True for each subject who meets the criterion; the others have dropped out.
    """
    protocol = records.protocol
    criterion, scenario = protocol.training, find_training_scenario(protocol)
    tasks = [training_tasks(protocol, s.number) for s in subjects]
    recorded = [completion_times(records, select_valid_trials(records.entries(s.code, TrialKind.TRAINING))) for s in subjects]
    cycles: list[list[float]] = [[] for _ in subjects]
    first, noise_seeds = 0, np.random.SeedSequence(seed)
    while first < criterion.most:
        practising = [
            person
            for person in range(len(subjects))
            if not criterion.is_met_by(cycles[person]) and len(cycles[person]) == first
        ]
        if not practising:
            break
        # Training takes at least `at_least` tasks, which are therefore run in one batch.
        count = min(criterion.at_least if first == 0 else 1, criterion.most - first)
        noise_seed = int(noise_seeds.spawn(1)[0].generate_state(1)[0])
        if any(len(recorded[person]) == first for person in practising):
            report_progress(f"training: {len(practising)} operators, {first + count} tasks")
            task_rows = np.arange(first, first + count)
            batch = [tasks[person].take(task_rows) for person in practising]
            batch_tasks = PointTasks(
                *(np.concatenate([getattr(part, name) for part in batch]) for name in ("q0", "target", "joint"))
            )
            person_of_trial = np.repeat(practising, count)
            trials = _run_simulated_trials(
                protocol,
                batch_tasks,
                np.full(len(person_of_trial), scenario),
                [people[person] for person in person_of_trial],
                noise_seed,
            )
            with records.transaction():
                for trial, person in enumerate(person_of_trial):
                    recorded[person].append(float(trials.cycles[trial]) if trials.is_completed[trial] else np.nan)
                    position = first + trial % count
                    _record_trial(
                        records, subjects[person].code, TrialKind.TRAINING, position, scenario, batch_tasks, trial, -1, trials
                    )
        for person in practising:
            cycles[person] += recorded[person][first : first + count]
        first += count
    trained = [criterion.is_met_by(durations) for durations in cycles]
    for subject, ok in zip(subjects, trained, strict=True):
        if not ok and subject.state == SubjectState.OPEN:
            records.set_state(subject.code, SubjectState.DROPPED)
    return trained


def _run_sessions(
    records: Records, subjects: list[Subject], people: list[Person], seeds: Sequence[int], say: Callable[[str], None]
) -> None:
    """Run the sessions of a batch of subjects, and record those that are missing, each as a whole or not at all.

    Args:
        records: Records of the experiment.
        subjects: Subjects of the batch.
        people: Simulated person of each subject.
        seeds: Seeds of the trials and of the ratings.
        say: Function that is called with a text about the progress.
    """
    missing = [k for k, s in enumerate(subjects) if not records.entries(s.code, TrialKind.TRIAL)]
    if not missing:
        return
    protocol = records.protocol
    sessions = [protocol.session_order(s.row, s.number) for s in subjects]
    order = np.concatenate(sessions)
    who = np.repeat(np.arange(len(subjects)), [len(s) for s in sessions])
    say(f"{len(order)} trials")
    tasks = protocol.tasks.take(order[:, 0])
    trials = _run_simulated_trials(protocol, tasks, order[:, 1], [people[k] for k in who], seeds[0])
    start = protocol.plants[0].position(protocol.tasks.q0)
    ideal = (np.linalg.norm(protocol.tasks.target - start, axis=1) - protocol.radius) / protocol.stick.limit
    time = np.where(trials.is_completed, trials.cycles, np.nan)
    ratings = rate_comfort(time, ideal[order[:, 0]], len(protocol.rating), seed=seeds[1])
    for k in missing:
        say(f"recording the session of {subjects[k].code}")
        with records.transaction():
            for position, i in enumerate(np.flatnonzero(who == k).tolist()):
                task, scenario = order[i].tolist()
                number = _record_trial(records, subjects[k].code, TrialKind.TRIAL, position, scenario, tasks, i, task, trials)
                records.rate_trial(number, int(ratings[i]))
            records.set_state(subjects[k].code, SubjectState.COMPLETED)


def _run_simulated_trials(
    protocol: Protocol, tasks: PointTasks, scenario: IndexArray, people: list[Person], seed: int
) -> Trials:
    operator = SimulatedPeople(people, protocol.rate, protocol.stick, radius=protocol.radius, seed=seed)
    return drive_tasks(protocol.plants, protocol.scenarios, scenario, tasks, operator, protocol.stick, protocol.rules)


def _record_trial(
    records: Records,
    code: str,
    kind: TrialKind,
    position: int,
    scenario: int,
    tasks: PointTasks,
    index: int,
    task: int,
    trials: Trials,
) -> int:
    """Write trial ``index`` of a batch, and return its number in the records."""
    number = records.begin_trial(code, kind, position, scenario=scenario, tasks=tasks.take(np.array([index])), task=task)
    cycles = slice(trials.first[index], trials.first[index + 1])
    times = np.arange(trials.cycles[index]) / records.protocol.rate
    records.append_cycles(number, 0, times, velocity=trials.velocity[cycles], q=trials.q[cycles])
    records.finish_trial(number, End(trials.end[index]), trials.q_end[index])
    return number
