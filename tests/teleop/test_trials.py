"""The arm under the stick, recorded trials and their measures, against plain loops and the closed loop in cycles."""

import numpy as np
import pytest

import holdfast as hf
from holdfast.kernels import Kernel
from holdfast.teleop.trials.driving import ComputerOperator, EndRules, Operator, RecordedOperator, drive_trials
from holdfast.teleop.trials.performance import compute_cpm, compute_measures
from holdfast.teleop.trials.plant import JoystickPlant
from holdfast.teleop.trials.recordings import End, Trials
from holdfast.teleop.trials.scenarios import SCENARIO_NAMES, PointTasks
from holdfast.teleop.trials.stick import Joystick


@pytest.fixture(scope="module")
def arm():
    return hf.arms.load("planar-3r")


@pytest.fixture(scope="module")
def plants(arm):
    return [JoystickPlant(SCENARIO_NAMES[k].make_law(arm)) for k in (0, 1)]


@pytest.fixture
def tasks(rng):
    q0 = rng.uniform(-np.pi, np.pi, (40, 3))
    angle = np.cumsum(q0, axis=1)
    x0 = np.stack([np.cos(angle).sum(axis=1), np.sin(angle).sum(axis=1)], axis=1)
    direction = rng.uniform(-np.pi, np.pi, 40)
    return PointTasks(q0, x0 + 0.9 * np.stack([np.cos(direction), np.sin(direction)], axis=1), rng.integers(-1, 3, 40))


class Wanderer(Operator):
    """Noise around the way to the target, with rests; gives up on some trials."""

    def __init__(self, rng):
        self._rng = rng

    def begin(self, x, target):
        self._patience = self._rng.integers(5, 80, len(x))

    def command_velocity(self, rows, cycle, x, target):
        v = target - x + self._rng.normal(0, 0.05, x.shape)
        return np.where(self._rng.random(rows.size)[:, None] < 0.2, 0.0, v)

    def gives_up(self, rows, cycle):
        return cycle >= self._patience[rows]


def wandered(plants, tasks, rng):
    which = rng.integers(0, 2, len(tasks))
    return which, drive_trials(
        plants,
        which,
        tasks.q0,
        target=tasks.target,
        healthy=tasks.healthy_mask(True),
        operator=Wanderer(rng),
        stick=Joystick(),
        rules=EndRules(at_rest=True),
    )


def test_computer_drives_as_the_closed_loop_in_cycles(arm, tasks):
    law = hf.control.failure_tolerant(arm, task="planar", gain=1.0, speed_limit=0.05)
    runs = hf.simulate(law, tasks.q0, tasks.target, locked=tasks.joint, cycles=True)
    trials = drive_trials(
        [JoystickPlant(law)],
        np.zeros(len(tasks), int),
        tasks.q0,
        target=tasks.target,
        healthy=tasks.healthy_mask(True),
        operator=ComputerOperator(),
        stick=Joystick(0.05, 0.0),
    )
    arrived = runs.outcome == "converged"
    assert arrived.sum() > 5
    np.testing.assert_array_equal(trials.is_completed, arrived)
    np.testing.assert_array_equal(trials.cycles[arrived], runs.time[arrived])
    np.testing.assert_allclose(trials.q_end[arrived], runs.q_final[arrived], atol=1e-9)
    np.testing.assert_allclose(compute_measures(trials)[arrived, 1], runs.path_length[arrived], atol=1e-9)


def test_one_cycle_is_ten_euler_steps_of_the_law(arm, rng):
    law = hf.control.damped(arm, 0.3, task="planar")
    plant = JoystickPlant(law)
    q, v, healthy = rng.uniform(-3, 3, (20, 3)), rng.normal(0, 0.05, (20, 2)), (rng.random((20, 3)) > 0.3).astype(float)
    after, actual = plant.step_batch(q, v, healthy)
    step = np.array(q)
    for k in range(10):
        rates = healthy * law.velocity(step, v)
        if k == 0:
            jacobian = arm.jacobian(q)[:, :2]
            np.testing.assert_allclose(actual, np.einsum("kij,kj->ki", jacobian, rates), atol=1e-14)
        step = step + rates / 10
    np.testing.assert_allclose(after, step, atol=1e-13)
    alone = [plant.step_one(*row) for row in zip(q, v, healthy, strict=True)]
    np.testing.assert_array_equal([a for a, _ in alone], after)
    np.testing.assert_array_equal([a for _, a in alone], actual)


def test_code_for_single_cycles_is_made_when_one_is_asked_for(arm, monkeypatch):
    """Batches do without it: simulated operators, and what is read from records."""
    made = []
    single = Kernel.single_row
    monkeypatch.setattr(Kernel, "single_row", lambda kernel: made.append(kernel) or single(kernel))
    plant = JoystickPlant(hf.control.pseudoinverse(arm, "planar"))
    plant.step_batch(np.full((2, 3), 0.3), np.zeros((2, 2)), np.ones((2, 3)))
    assert made == []
    for _ in range(2):
        plant.step_one(np.full(3, 0.3), np.zeros(2), np.ones(3))
    assert len(made) == 1


def test_singular_arm_stands(plants):
    q, v, healthy = np.zeros(3), np.array([0.05, 0.0]), np.ones(3)
    after, actual = plants[0].step_one(q, v, healthy)
    np.testing.assert_array_equal(after, q)
    np.testing.assert_array_equal(actual, [0, 0])


def test_stick_has_a_dead_zone_and_a_limit(rng):
    stick = Joystick()
    v = stick.command_velocity(rng.uniform(-1, 1, (2000, 2)))
    speed = np.linalg.norm(v, axis=1)
    assert speed.max() <= 0.05 * (1 + 1e-15)
    assert not ((speed > 0) & (speed < 0.005)).any()
    np.testing.assert_allclose(stick.command_velocity([0.5, 0.0]), [0.025, 0.0])
    np.testing.assert_array_equal(stick.command_velocity([0.09, 0.0]), [0, 0])


def test_replay_gives_the_same_bits(plants, tasks, rng):
    which, trials = wandered(plants, tasks, rng)
    again = drive_trials(
        plants,
        which,
        tasks.q0,
        target=tasks.target,
        healthy=tasks.healthy_mask(True),
        operator=RecordedOperator(trials),
        stick=None,
        rules=EndRules(at_rest=True),
    )
    for name in ("velocity", "q", "x", "actual", "first", "q_end", "x_end", "end"):
        np.testing.assert_array_equal(getattr(again, name), getattr(trials, name), err_msg=name)


def test_trials_can_be_taken_and_joined(plants, tasks, rng):
    _, trials = wandered(plants, tasks, rng)
    rows = rng.permutation(len(trials))
    again = Trials.concatenate([trials.take(rows[:11]), trials.take(rows[11:])])
    for new, old in enumerate(rows):
        np.testing.assert_array_equal(again.path(new), trials.path(int(old)))
        np.testing.assert_array_equal(again.configurations(new), trials.configurations(int(old)))
    np.testing.assert_array_equal(compute_measures(again), compute_measures(trials)[rows])


def _measured(trials, i):
    """M1 to M11 of one trial, cycle by cycle."""
    first, stop = trials.first[i], trials.first[i + 1]
    x, q, xd = trials.path(i), trials.configurations(i), trials.target[i]
    v, a = trials.velocity[first:stop], trials.actual[first:stop]

    def aside(p):
        d = xd - x[0]
        t = min(max(np.dot(p - x[0], d) / np.dot(d, d), 0), 1)
        return np.hypot(*(p - x[0] - t * d))

    errors, angles = [], []
    for vk, ak in zip(v, a, strict=True):
        if np.hypot(*vk) > 0:
            errors.append(np.hypot(*(vk - ak)) / np.hypot(*vk))
            if np.hypot(*ak) > 1e-12 * np.hypot(*vk):
                angles.append(abs(np.arctan2(vk[0] * ak[1] - vk[1] * ak[0], vk @ ak)))
    to_go = [np.hypot(*(p - xd)) for p in x]
    return [
        stop - first,
        sum(np.hypot(*(x[k + 1] - x[k])) for k in range(len(x) - 1)),
        max(aside(p) for p in x),
        np.mean([aside(p) for p in x]),
        sum(max(0, to_go[k + 1] - to_go[k]) for k in range(len(x) - 1)),
        sum(abs(q[k + 1, j] - q[k, j]) for k in range(len(q) - 1) for j in range(3)),
        np.mean(errors) if errors else 0,
        max(errors, default=0),
        np.mean(angles) if angles else 0,
        max(angles, default=0),
        sum(np.hypot(*(v[k + 1] - v[k])) for k in range(len(v) - 1)),
    ]


def test_measures_are_what_their_definitions_say(plants, tasks, rng):
    _, trials = wandered(plants, tasks, rng)
    ms = compute_measures(trials)
    assert {End.ARRIVED, End.ABORTED} <= set(trials.end)
    for i in range(len(trials)):
        if trials.end[i] == End.ARRIVED:
            np.testing.assert_allclose(ms[i], _measured(trials, i), atol=1e-7)  # an angle close to 0 has half the digits
        else:
            assert np.isnan(ms[i]).all()


def test_trial_that_begins_in_the_circle_has_no_cycles(plants, tasks):
    start = plants[0].position(tasks.q0)
    trials = drive_trials(
        plants,
        np.zeros(40, int),
        tasks.q0,
        target=start,
        healthy=tasks.healthy_mask(False),
        operator=ComputerOperator(),
        stick=Joystick(),
    )
    assert trials.is_completed.all()
    np.testing.assert_array_equal(compute_measures(trials), 0)


def test_cpm_divides_by_the_largest(rng):
    m = rng.uniform(0, 5, (6, 4, 11))
    m[2, 3] = np.nan
    m[..., 5] = 0
    found = compute_cpm(m)
    expected = sum(m[..., k] / np.nanmax(m[..., k]) for k in range(11) if k != 5)
    np.testing.assert_allclose(found.values, expected)
    assert np.isnan(found.values[2, 3])
    np.testing.assert_allclose(compute_cpm(m[0], found.normalisers).values, found.values[0])


def test_bad_input_is_refused(arm, plants, tasks):
    with pytest.raises(hf.TaskError, match="use planar or position"):
        JoystickPlant(hf.control.pseudoinverse(hf.arms.load("panda"), task="pose"))
    with pytest.raises(hf.InputError, match="dead zone"):
        Joystick(0.05, 0.06)
    with pytest.raises(hf.InputError, match="q0 has shape"):
        drive_trials(
            plants, [0, 0], tasks.q0, target=tasks.target, healthy=tasks.healthy_mask(True), operator=ComputerOperator()
        )
    with pytest.raises(hf.InputError, match="0 or more"):
        compute_cpm([[-1.0]])
