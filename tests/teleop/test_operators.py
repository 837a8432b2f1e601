"""Simulated people: each part of the model seen alone."""

import numpy as np
import pytest

import holdfast as hf
from holdfast.teleop.trials.driving import EndRules, drive_trials
from holdfast.teleop.trials.operators import Person, SimulatedPeople, rate_comfort, sample_people
from holdfast.teleop.trials.plant import JoystickPlant
from holdfast.teleop.trials.recordings import End
from holdfast.teleop.trials.scenarios import SCENARIO_NAMES
from holdfast.teleop.trials.stick import Joystick

PERFECT = Person(delay=0, lag=0, noise=0, bias=0, slowing=0, gives_up=1e6)
RULES = EndRules(at_rest=True, cycle_limit=5000, patience=10_000)


@pytest.fixture(scope="module")
def plant():
    return JoystickPlant(SCENARIO_NAMES[0].make_law(hf.arms.load("planar-3r")))


def run(plant, people, rate=6.0, q0=(0.3, 0.8, 0.6), target=(-0.4, 1.6), healthy=(1, 1, 1), seed=0):
    n = len(people)
    operator = SimulatedPeople(people, rate, Joystick(), radius=0.1, seed=seed)
    q0, target, healthy = (np.tile(np.asarray(a, dtype=float), (n, 1)) for a in (q0, target, healthy))
    return drive_trials(
        [plant], np.zeros(n, int), q0, target=target, healthy=healthy, operator=operator, stick=Joystick(), rules=RULES
    )


def test_a_perfect_person_goes_straight(plant):
    trials = run(plant, [PERFECT])
    x, xd = trials.path(0), trials.target[0]
    along = (xd - x[0]) / np.linalg.norm(xd - x[0])
    aside = (x - x[0]) @ [-along[1], along[0]]
    assert np.abs(aside).max() < 2e-3
    assert trials.end[0] == End.ARRIVED
    assert trials.cycles[0] <= np.ceil(np.linalg.norm(xd - x[0]) / 0.05) + 1
    assert np.linalg.norm(x[-1] - xd) < 0.1


def test_delay_is_in_seconds(plant):
    for cycles_per_second in (6.0, 60.0):
        trials = run(plant, [Person(delay=0.5, lag=0, noise=0, bias=0, gives_up=5)], cycles_per_second)
        moves = np.flatnonzero(trials.velocity.any(axis=1))
        assert moves[0] == 0.5 * cycles_per_second


def test_lag_is_of_first_order(plant):
    trials = run(plant, [Person(delay=0, lag=0.3, noise=0, bias=0, slowing=0)], 60.0)
    speed = np.linalg.norm(trials.velocity, axis=1)[:30]
    expected = 0.05 * (1 - np.exp(-(np.arange(30) + 1) / 18))
    expected[expected < 0.005] = 0  # the dead zone
    np.testing.assert_allclose(speed, expected, atol=2e-4)


def test_bias_is_an_angle(plant):
    trials = run(plant, [Person(delay=0, lag=0, noise=0, bias=0.2, slowing=0)] * 400)
    first = trials.velocity[trials.first[:-1]]
    straight = trials.target - trials.start()
    angle = np.arctan2(straight[:, 0] * first[:, 1] - straight[:, 1] * first[:, 0], np.einsum("ij,ij->i", straight, first))
    assert abs(angle.mean()) < 4 * 0.2 / 20
    assert abs(angle.std() - 0.2) < 4 * 0.2 / np.sqrt(800)


def test_noise_is_a_share_of_the_command(plant):
    person = Person(delay=0, lag=0, noise=0.1, bias=0, slowing=0)
    trials = run(plant, [person] * 400)
    early = trials.velocity[trials.first[:-1] + 5]
    along = (trials.target - trials.start())[0]
    across = early @ np.array([-along[1], along[0]]) / np.linalg.norm(along)
    assert abs(across.std() - 0.05 * 0.1) < 0.05 * 0.1 * 0.25


def test_who_is_led_away_tries_another_way(plant):
    """The folded trap: a straight way stands still for ever; a person looks for another and arrives."""
    angle = np.pi / 4 + np.arccos(1 / np.hypot(1.5, 1.5))
    q0 = (angle, *np.deg2rad([-66.0098, 155.7258]))
    trials = run(plant, sample_people(12, 2), q0=q0, target=(1.5, 1.5), healthy=(0, 1, 1))
    assert trials.is_completed.sum() >= 3
    stubborn = [Person(noise=0, bias=0, look_back=130, gives_up=120)] * 3
    assert (run(plant, stubborn, q0=q0, target=(1.5, 1.5), healthy=(0, 1, 1)).end == End.ABORTED).all()


def test_gives_up_in_time(plant):
    trials = run(plant, [Person(gives_up=10)], target=(3.5, 3.5))
    assert trials.end[0] == End.ABORTED
    assert trials.cycles[0] == 60


def test_same_seed_same_trials(plant):
    people = sample_people(6, 1)
    a, b, c = (run(plant, people, seed=s) for s in (4, 4, 5))
    np.testing.assert_array_equal(a.q, b.q)
    assert len(a.q) != len(c.q) or (a.q != c.q).any()


def test_people_differ_around_the_middle():
    people = sample_people(400, 3)
    delays = np.log([p.delay for p in people])
    assert abs(delays.mean() - np.log(0.24)) < 0.03
    assert abs(delays.std() - 0.15) < 0.03


def test_rating_grows_with_time():
    ratio = np.repeat([1.0, 1.9, 3.0, 10.0], 500)
    level = rate_comfort(40 * ratio, 40, seed=1).reshape(4, 500).mean(axis=1)
    assert (np.diff(level) > 0.5).all()
    assert level[0] < 0.1
    assert level[3] > 2.9
    np.testing.assert_array_equal(rate_comfort([np.nan, np.nan], 40), [3, 3])


def test_bad_input_is_refused(plant):
    with pytest.raises(hf.InputError, match="lag is -1"):
        Person(lag=-1)
    with pytest.raises(hf.InputError, match="1 or more"):
        sample_people(0)
    with pytest.raises(hf.InputError, match="one for each"):
        SimulatedPeople([Person()], 6.0, Joystick(), radius=0.1).begin(np.zeros((2, 2)), np.ones((2, 2)))
