"""The closed loop against scipy's integrators, the closed forms of the two-link arm and the published cases."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.control import Damped, FailureTolerant, Pseudoinverse
from holdfast.control.simulation import Reason, RunOutcome, batch, simulate
from holdfast.kernels import compiled

RAD = np.deg2rad


@pytest.fixture(scope="module")
def two() -> Pseudoinverse:
    return Pseudoinverse(arms.load("planar-2r"), "planar")


@pytest.fixture(scope="module")
def three() -> Pseudoinverse:
    return Pseudoinverse(arms.load("planar-3r"), "planar")


@pytest.fixture(scope="module")
def panda() -> Pseudoinverse:
    return Pseudoinverse(arms.load("panda"), "pose")


def around(rho, phi):
    """A target about joint 2 of the two-link arm whose joint 1 stands at 0."""
    return np.array([1 + rho * np.cos(RAD(phi)), rho * np.sin(RAD(phi))])


def planar_rates(q, x, mask):
    """The failed planar arm with unit links, written apart: numpy's pseudoinverse."""
    s = np.cumsum(q)
    j = np.array([-np.cumsum(np.sin(s)[::-1])[::-1], np.cumsum(np.cos(s)[::-1])[::-1]])
    return mask * (np.linalg.pinv(j) @ (x - [np.cos(s).sum(), np.sin(s).sum()]))


def reference(rates, q0, end=3000.0, rtol=1e-10, atol=1e-12, until=()):
    """scipy until at rest, or another event."""

    def rest(t, q):
        return np.linalg.norm(rates(q)) - 1e-8

    rest.terminal = True
    return solve_ivp(lambda t, q: rates(q), (0, end), q0, "DOP853", rtol=rtol, atol=atol, events=[rest, *until])


# ---- Goel et al. 2005, section on the two-link arm -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("rho", "phi", "outcome", "angle", "error", "time"),
    [
        (1, 45, "converged", -315.0, 0.0, None),
        (1, 0, "stuck", -30.0, 0.517638, 0.0),
        (2, 120, "stuck", -261.7868, 1.133893, None),
        (2, 75, "stuck", 28.0389 - 360, 1.506658, None),
        (2, 90, "stuck", 53.1301 - 360, 1.341641, None),
        (2, 105, "stuck", 76.3055 - 360, 1.221160, None),
        (2, 135, "stuck", 119.2776 - 360, 1.072220, None),
        (2, 150, "stuck", 139.7922 - 360, 1.031171, None),
    ],
)
def test_two_link_arm_ends_where_the_paper_says(two, rho, phi, outcome, angle, error, time):
    runs = simulate(two, RAD([0.0, -30.0]), around(rho, phi), locked=[0])
    assert runs.outcome == outcome
    assert runs.reason == Reason.NONE
    assert np.rad2deg(runs.q_final[1]) == pytest.approx(angle, abs=1e-4)
    assert runs.error == pytest.approx(error, abs=1e-6)
    assert runs.closest <= runs.error + 1e-12
    assert time is None or runs.time == time


def test_two_link_arm_that_never_rests_turns_at_a_constant_rate(two):
    runs = simulate(two, RAD([0.0, -30.0]), around(2, 60), locked=[two.arm.joint_names[0]])
    assert runs.outcome == "moving"
    assert (runs.q_final[1] - RAD(-30)) / runs.time == pytest.approx(-1.732051, abs=1e-6)
    assert runs.closest == pytest.approx(1, abs=1e-3)
    assert runs.path_length == pytest.approx(np.sqrt(3) * 3000, rel=1e-6)  # the hand is 1 m from joint 2
    path = runs.path(0, 4000, until=3.6276)
    assert path.error.max() == pytest.approx(3, abs=1e-3)
    assert path.error.min() == pytest.approx(1, abs=1e-3)
    assert path.error[0] == pytest.approx(path.error[-1], abs=1e-4)


def test_a_singularity_reached_in_finite_time_leaves_the_run_undecided(two):
    runs = simulate(two, RAD([0.0, -30.0]), around(2, 30), locked=[0])
    assert (runs.outcome, runs.reason) == ("undecided", Reason.SINGULAR)
    assert "singular" in Reason(int(runs.reason)).sentence
    assert abs(runs.q_final[1]) < 1e-3
    stretched = simulate(two, [0.0, 0.0], around(2, 30), locked=[0])
    assert (stretched.outcome, stretched.reason) == ("undecided", Reason.SINGULAR)


def test_half_a_turn_from_the_target_the_shortest_turn_flips():
    """The turn of a planar hand is the sum of its joints."""
    arm = hf.arms.load("planar-3r")
    goal = np.array([[-0.7259, 0.6878, 0, -1.0299], [-0.6878, -0.7259, 0, 0.99], [0, 0, 1, 0], [0, 0, 0, 1]])
    goal[:2, :2] /= np.sqrt(np.linalg.det(goal[:2, :2]))
    runs = simulate(hf.control.pseudoinverse(arm, ["vx", "vy", "wz"]), [-0.9, 0.4, -1.1], goal, locked=[1], time_limit=50.0)
    assert (runs.outcome, runs.reason) == ("undecided", Reason.HALF_TURN)
    assert np.cos(runs.q_final.sum() - np.arctan2(goal[1, 0], goal[0, 0])) == pytest.approx(-1, abs=1e-5)
    assert "half a turn" in " ".join(runs.describe())


@pytest.mark.parametrize("tolerance", [1e-9, 1e-13])
def test_a_run_caught_at_half_a_turn_is_told_soon_and_is_not_called_singular(rng, monkeypatch, tolerance):
    """With joint 2 standing off 0 and pi the Jacobian of the planar pose, of determinant sin q2, is regular everywhere."""
    from holdfast.kernels import Loop

    taken, run = [], Loop.run

    def counted(self, *given, **told):
        result = run(self, *given, **told)
        taken.append(int(result.steps.max(initial=0)))
        return result

    monkeypatch.setattr(Loop, "run", counted)
    arm = hf.arms.load("planar-3r")
    q0 = rng.uniform([-np.pi, 0.5, -np.pi], [np.pi, 2.5, np.pi], (150, 3))
    target = arm.forward_kinematics(rng.uniform(-np.pi, np.pi, (150, 3)))
    law = hf.control.pseudoinverse(arm, ["vx", "vy", "wz"])
    runs = simulate(law, q0, target, locked=[1], time_limit=50.0, tolerance=tolerance)
    assert not np.isin(runs.reason, (Reason.SINGULAR, Reason.STEPS)).any()
    caught = runs.reason == Reason.HALF_TURN
    away = runs.q_final.sum(axis=1) - np.arctan2(target[:, 1, 0], target[:, 0, 0])
    np.testing.assert_allclose(np.cos(away[caught]), -1, atol=1e-6)
    assert caught.sum() > 10
    assert sum(taken) < 20_000


def test_excess_error_is_what_the_closed_form_leaves(two):
    starts = np.tile(RAD([0.0, -30.0]), (2, 1))
    targets = np.array([around(2, 120), around(1, 45)])
    runs = simulate(two, starts, targets, locked=[0])
    np.testing.assert_allclose(runs.least_error(), [1, 0], atol=1e-8)
    np.testing.assert_allclose(runs.excess_error, [0.133893, 0], atol=1e-6)


# ---- the planar arm with three joints ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("joint", "start", "q_final", "error"),
    [
        (1, (-79.3348, 45, 42.7735), (-5.6173, 45, 66.1698), 0),
        (1, (-35.6493, 45, -87.7735), (50.6173, 45, -111.1698), 0),
    ],
)
def test_figure_5_of_the_paper(three, joint, start, q_final, error):
    runs = simulate(three, RAD(start), [1.5, 1.5], locked=[joint])
    assert runs.outcome == "converged"
    turn = np.rad2deg(runs.q_final) - q_final
    assert np.abs((turn + 180) % 360 - 180).max() < 1e-3
    assert runs.error == pytest.approx(error, abs=1e-5)


def test_unreachable_targets_end_at_the_published_points(three):
    """The families of rest points of a locked joint 1 and 3."""
    starts = RAD([[125, -60, 40], [0, 0, 130], [-13, 150, 44]])
    starts[1, :2] = RAD([40, -50])
    runs = simulate(three, starts, [[1.5, 1.5], [1.5, 1.5], [-0.8, 0]], locked=np.array([0, 2, 2]))
    assert list(runs.outcome) == ["stuck"] * 3
    np.testing.assert_allclose(runs.error[[0, 2]], [0.342268, 0.2083], atol=1e-4)
    assert np.rad2deg(runs.q_final[1]) == pytest.approx([48.4314, -65, 130], abs=1e-3)


def test_a_limit_cycle_is_moving(three):
    """Reachable, no sink, and still no convergence: joint 2 at 168.30 degrees."""
    runs = simulate(three, RAD([-130.0, 168.30, -84.0]), [0.9, 0.0], locked=[1])
    assert runs.outcome == "moving"
    path = runs.path(0, 200_001)
    late = path.time > 1500
    angle, time = path.q[late, 0], path.time[late]
    assert np.rad2deg(np.ptp(angle)) == pytest.approx(9.2372, abs=2e-3)
    middle = angle - angle.mean()
    rises = time[1:][(middle[1:] > 0) & (middle[:-1] <= 0)]
    assert np.diff(rises).mean() == pytest.approx(79.76, abs=0.01)
    assert path.error[late].min() == pytest.approx(0.809, abs=1e-3)
    assert path.error[late].max() == pytest.approx(0.997, abs=1e-3)


@pytest.mark.parametrize(
    ("start", "x", "rate"),
    [
        ((-0.3283141, 2.08742931, -0.0742208), (-0.14897975, 0.06973707), 13),
        ((1.07891254, -0.21329997, 0.01236121), (0.69898401, 0.53231833), 37),
    ],
)
def test_a_fast_limit_cycle_is_moving(three, start, x, rate):
    """Joint 3 stands nearly straight: joint 1 turns forever, too fast for 100,000 steps to last until the limit."""
    runs = simulate(three, start, x, locked=[2])
    assert (runs.outcome, runs.reason) == ("moving", Reason.NONE)
    assert runs.time < 3000
    span = 6 * 2 * np.pi / rate

    def rates(t, q):
        return planar_rates(q, np.array(x), np.array([1, 1, 0]))

    found = solve_ivp(rates, (0, span), runs.q_final, "DOP853", rtol=1e-12, atol=1e-13, dense_output=True)
    # Once round it is where it was, and so again and again, after equal times.
    time = np.linspace(0, span, 200_001)
    q = found.sol(time)
    whole = 2 * np.pi * np.arange(5)
    round_ = np.interp(whole, np.abs(q[0] - q[0, 0]), time)
    np.testing.assert_allclose(np.diff(round_), round_[-1] / 4, rtol=1e-4)
    assert 2 * np.pi * 4 / round_[-1] == pytest.approx(rate, rel=0.15)
    np.testing.assert_allclose(np.interp(round_, time, q[1]), q[1, 0], atol=1e-6)
    assert np.linalg.norm([rates(0, q) for q in found.y.T], axis=1).min() > 0.1
    if rate < 20:
        orbit = hf.equilibria.orbit(runs)
        assert orbit.label == "turning"
        assert orbit.stable


def test_only_what_goes_on_is_said_to_circle(three, random_runs, monkeypatch):
    """With few steps every long run is looked at; one that would end elsewhere must not be taken for a cycle."""
    from holdfast.control.simulation import batch as compiled

    monkeypatch.setattr(compiled, "MAX_STEPS", 250)
    q0, x, locked, runs = random_runs
    few = simulate(three, q0, x, locked=locked)
    assert (few.reason == Reason.STEPS).any()
    moving = few.outcome == "moving"
    assert moving.any()
    assert (runs.outcome[moving] == "moving").all()


def test_a_creeping_arm_is_undecided_until_it_has_the_time(three):
    """Just off the folded line of joint 1 the transit takes very long, slower than anything that turns forever."""
    fold = 45 + np.rad2deg(np.arccos(1 / np.hypot(1.5, 1.5)))
    starts = RAD([[fold + d, -34.4697, 131.81] for d in (0.0, 0.01)])
    runs = simulate(three, starts, [1.5, 1.5], locked=[0], time_limit=500.0)
    assert list(runs.outcome) == ["stuck", "undecided"]
    assert list(runs.reason) == [Reason.NONE, Reason.TIME_LIMIT]
    assert runs.error[0] == pytest.approx(1.87083, abs=1e-4)
    assert simulate(three, starts[1], [1.5, 1.5], locked=[0], time_limit=20_000.0).outcome == "converged"


@pytest.fixture(scope="module")
def random_runs(three, generator):
    """Starts, targets and locked joints, their runs, and what scipy says of the first ones."""
    rng = generator("random runs of the closed loop")
    count = 400
    q0 = rng.uniform(-np.pi, np.pi, (count, 3))
    x = 2.6 * np.sqrt(rng.uniform(0.02, 1, count))[:, None] * directions(rng, count)
    locked = rng.integers(1, 3, count)  # joint 1 locked leaves singular points that attract
    return q0, x, locked, simulate(three, q0, x, locked=locked)


def directions(rng, count):
    angle = rng.uniform(-np.pi, np.pi, count)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def test_terminal_points_and_outcomes_are_those_of_scipy(random_runs):
    q0, x, locked, runs = random_runs
    compared = 0
    for k in np.flatnonzero((runs.code <= RunOutcome.STUCK) & (runs.time < 300))[:12]:
        mask = np.arange(3) != locked[k]
        found = reference(lambda q, k=k, mask=mask: planar_rates(q, x[k], mask), q0[k])
        q = found.y[:, -1]
        s = np.cumsum(q)
        tip = np.array([np.cos(s).sum(), np.sin(s).sum()])
        assert found.status == 1
        assert np.abs(tip - runs.x_final[k]).max() < 1e-6
        assert ("converged" if np.linalg.norm(x[k] - tip) < 1e-5 else "stuck") == runs.outcome[k]
        dense = np.sort(np.concatenate([found.y, (found.y[:, 1:] + found.y[:, :-1]) / 2], axis=1), axis=1)
        np.testing.assert_allclose([runs.q_low[k], runs.q_high[k]], [dense[:, 0], dense[:, -1]], atol=0.02)
        assert runs.q_low[k] == pytest.approx(np.minimum(runs.q_low[k], found.y.min(axis=1)), abs=1e-6)
        compared += 1
    assert compared == 12


def test_what_is_noted_on_the_way_is_that_of_scipy(three, random_runs):
    """Path, excursions and closest approach, although the integrator's steps are long."""
    q0, x, locked, runs = random_runs
    for k in np.flatnonzero(runs.time > 20)[:6]:
        mask = np.arange(3) != locked[k]
        found = solve_ivp(
            lambda t, q, k=k, mask=mask: planar_rates(q, x[k], mask),
            (0, 20),
            q0[k],
            "DOP853",
            rtol=1e-11,
            atol=1e-13,
            dense_output=True,
            max_step=0.2,
        )
        path = runs.path(k, 8001, until=20.0)
        q = found.sol(path.time).T
        np.testing.assert_allclose(path.q, q, atol=1e-7)
        short = simulate(three, q0[k], x[k], locked=[int(locked[k])], time_limit=20.0)
        np.testing.assert_allclose([short.q_low, short.q_high], [q.min(axis=0), q.max(axis=0)], atol=5e-5)
        s = np.cumsum(q, axis=1)
        error = np.hypot(np.cos(s).sum(axis=1) - x[k, 0], np.sin(s).sum(axis=1) - x[k, 1])
        assert short.closest == pytest.approx(error.min(), abs=2e-4)
        np.testing.assert_allclose(path.error, error, atol=1e-6)


def spatial(arm, task, q0, target, joint):
    """How a run of an arm in space ends for scipy: when it rests, where, and how near it came to a singular configuration."""
    mask = np.arange(arm.n) != joint
    size = len(task)

    def error(q, made=None):
        pose = (made or oracles.frames(arm, q[None]))[-1][0]
        turn = Rotation.from_matrix(target[:3, :3] @ pose[:3, :3].T).as_rotvec()
        return np.r_[target[:3, 3] - pose[:3, 3], turn][:size]

    def rates(q):
        made = oracles.frames(arm, q[None])
        return mask * (np.linalg.pinv(oracles.jacobian(arm, q[None], made)[0, :size]) @ error(q, made))

    def clear(t, q):
        return np.linalg.svd(oracles.jacobian(arm, q[None])[0, :size], compute_uv=False)[-1] - 0.02

    clear.terminal = True  # the way past a singular configuration takes scipy longest, and nothing is asked of it
    if clear(0, q0) <= 0:
        return None, np.nan, False
    found = reference(rates, q0, 40.0, 1e-8, 1e-10, [clear])
    turned = max(np.linalg.norm(error(q)[3:]) for q in found.y.T)
    return found, np.linalg.norm(error(found.y[:, -1])), not found.t_events[1].size and turned < 3.0


@pytest.mark.parametrize(("joints", "task"), [(4, ["vx", "vy", "vz"]), (5, ["vx", "vy", "vz"]), (7, list(oracles.ROWS))])
def test_the_outcome_does_not_depend_on_tolerance(rng, joints, task):
    """Random arms in space; what scipy says of them is neither ours nor at any of these tolerances."""
    arm = oracles.random_arm(rng, types="C" * joints)
    count = 5
    q0 = rng.uniform(-np.pi, np.pi, (count, joints))
    target = arm.forward_kinematics(q0 + rng.uniform(-0.8, 0.8, (count, joints)))
    locked = rng.integers(0, joints, count)
    law = Pseudoinverse(arm, task)
    every = [simulate(law, q0, target, locked=locked, tolerance=t, time_limit=40.0) for t in (1e-6, 1e-9, 1e-12)]
    compared = 0
    for k in range(count):
        found, error, clear = spatial(arm, task, q0[k], target[k], locked[k])
        if not clear:
            continue  # beside a singular configuration, or half a turn, neighbours part
        for runs in every:
            if found.status and found.t[-1] < 35:
                assert runs.outcome[k] == ("converged" if error < 1e-5 else "stuck")
                assert runs.time[k] == pytest.approx(found.t[-1], abs=5)
            assert np.abs(runs.q_final[k] - found.y[:, -1]).max() < 1e-4
            assert runs.error[k] == pytest.approx(error, abs=1e-5)
        compared += 1
        if compared == 4:  # of each of the three arms; scipy takes a second for a run
            break
    assert compared >= 3


def test_fixed_steps_end_where_adaptive_ones_do(three, random_runs):
    q0, x, locked, runs = random_runs
    few = np.flatnonzero(runs.time < 200)[:60]
    fixed = simulate(three, q0[few], x[few], locked=locked[few], method="rk4", step=0.02)
    smooth = np.isin(fixed.code, (RunOutcome.CONVERGED, RunOutcome.STUCK))
    assert smooth.mean() > 0.9
    assert (fixed.code[smooth] == runs.code[few][smooth]).all()
    assert np.median(np.abs(fixed.x_final - runs.x_final[few])[smooth]) < 1e-7


def test_batch_is_single_and_threads_do_not_matter(three, random_runs, threads):
    q0, x, locked, runs = random_runs
    threads(1)
    again = simulate(three, q0[:40], x[:40], locked=locked[:40])
    for name in ("q_final", "error", "closest", "path_length", "q_low", "time", "code"):
        np.testing.assert_array_equal(getattr(again, name), getattr(runs, name)[:40])
    one = simulate(three, q0[7], x[7], locked=[int(locked[7])])
    assert one.q_final.shape == (3,)
    assert one.code.shape == ()
    assert isinstance(str(one.outcome), str)
    np.testing.assert_array_equal(one.q_final, runs.q_final[7])
    assert len(one) == 1
    assert sum(runs.counts().values()) == len(runs)


def test_many_runs_are_computed_by_better_code_from_the_first_step_on(tmp_path, monkeypatch, rng):
    monkeypatch.setenv("HOLDFAST_CACHE", str(tmp_path))
    q0, target = rng.uniform(-2, 2, (4, 3)), rng.uniform(-1, 1, (4, 2))
    ends = []
    for calls, level in ((0, 0), (compiled.REPAYING_WORK, 1)):
        monkeypatch.setattr(batch, "LOOP_CALLS_PER_RUN", calls)
        runs = simulate(Pseudoinverse(arms.load("planar-3r"), "planar"), q0, target, locked=[1])
        assert runs._simulator._stepper.loop.step._compiled.level == level
        ends.append(runs.q_final)
    np.testing.assert_array_equal(*ends)


def test_gain_and_speed_limit_only_take_time(three, random_runs):
    q0, x, locked, runs = random_runs
    few = np.flatnonzero(runs.time < 100)[:20]
    slow = Pseudoinverse(three.arm, "planar", gain=4.0, speed_limit=0.1)
    limited = simulate(slow, q0[few], x[few], locked=locked[few])
    assert (limited.code == runs.code[few]).all()
    assert np.abs(limited.x_final - runs.x_final[few]).max() < 1e-6
    assert np.abs(limited.path_length - runs.path_length[few]).max() < 1e-4
    far = np.linalg.norm(x[few] - simulate(three, q0[few], q_target(three, q0[few]), locked=locked[few]).x_final, axis=1) > 1
    assert (limited.time[far] > 8).all()


def q_target(law, q):
    return law.arm.forward_kinematics(q)[:, :2, 3]


# ---- locks on the way, other arms -----------------------------------------------------------------------------------


def test_a_joint_that_locks_on_the_way(three, rng):
    q0, x, lock = RAD([20.0, 40.0, 60.0]), np.array([-0.5, 1.8]), 0.7
    healthy = solve_ivp(lambda t, q: planar_rates(q, x, 1), (0, lock), q0, "DOP853", rtol=1e-11, atol=1e-13).y[:, -1]
    mask = np.array([1, 0, 1])
    end = reference(lambda q: planar_rates(q, x, mask), healthy).y[:, -1]
    runs = simulate(three, q0, x, locked={1: None}, time=lock)
    assert runs.q_final[1] == pytest.approx(healthy[1], abs=1e-8)
    np.testing.assert_allclose(runs.q_final, end, atol=1e-6)
    path = runs.path(0, 301, until=2.0)
    np.testing.assert_allclose(path.q[path.time >= lock][:, 1], healthy[1], atol=1e-6)
    assert (path.locked[:, 1] == (path.time >= lock)).all()
    assert not path.locked[:, 0].any()
    many = simulate(three, np.tile(q0, (3, 1)), x, locked=[1, 0], time=[lock, 2.5])
    np.testing.assert_array_equal(many.q_final[0], many.q_final[2])
    assert many.q_final[0, 1] == runs.q_final[1]


@pytest.mark.parametrize("method", ["adaptive", "rk4"])
def test_every_sample_of_a_path_with_locks_on_the_way_is_that_of_scipy(three, rng, method):
    """Before the first lock, between the two and after them."""
    q0, x, locks = rng.uniform([-3, 0.6, 0.6], [3, 1.6, 1.6]), rng.uniform(-1.5, 1.5, 2), [1, 0]
    path = simulate(three, q0, x, locked=locks, method=method, time_limit=4.0, time=[0.5, 1.2]).path(0, 47)
    expected, q, ends = np.empty((47, 3)), q0, [0.0, 0.5, 1.2, 4.0]
    for k, mask in enumerate(([1, 1, 1], [1, 0, 1], [0, 0, 1])):
        found = solve_ivp(
            lambda t, q, mask=mask: planar_rates(q, x, np.array(mask)),
            ends[k : k + 2],
            q,
            "DOP853",
            rtol=1e-11,
            atol=1e-13,
            dense_output=True,
        )
        here = (path.time >= ends[k]) & (path.time <= ends[k + 1])
        expected[here], q = found.sol(path.time[here]).T, found.y[:, -1]
    np.testing.assert_allclose(path.q, expected, atol=1e-7 if method == "adaptive" else 1e-4)
    np.testing.assert_array_equal(path.locked, path.time[:, None] >= [1.2, 0.5, np.inf])


def test_samples_near_a_kink_follow_the_law():
    """Where the damping has kinks, a step to a sample can be rejected although the integrator's own step was not."""
    arm, gain, speed_limit = arms.load("panda"), 2.0, 0.25
    law = FailureTolerant(arm, "position", gain=gain, speed_limit=speed_limit)
    q = [-1.0309, 0.1471, -0.5728, -2.018, 2.7474, 0.6242, 0.6593]
    target = np.array([0.3772, -0.4767, 0.4987])
    path = simulate(law, q, target, locked=[2]).path(samples=201, until=2.0)
    middle = (path.q[1:] + path.q[:-1]) / 2
    error = target - arm.forward_kinematics(middle)[:, :3, 3]
    gains = np.minimum(gain, speed_limit / np.linalg.norm(error, axis=1))
    rates = law.velocity(middle, gains[:, None] * error)
    rates[:, 2] = 0
    found = np.diff(path.q, axis=0) / np.diff(path.time)[:, None]
    np.testing.assert_allclose(found, rates, rtol=0, atol=0.01 * np.linalg.norm(rates, axis=1).max())


@pytest.mark.parametrize("cycles", [False, True])
def test_lock_times_of_each_run(three, rng, cycles):
    """As many calls with a time each; whole numbers and infinity serve as well."""
    law = Pseudoinverse(three.arm, "planar", speed_limit=0.05) if cycles else three
    count = 12
    q0, x = rng.uniform([-3, 0.6, 0.6], [3, 1.6, 1.6], (count, 3)), rng.uniform(-1.5, 1.5, (count, 2))
    times = np.where(
        rng.uniform(size=(count, 3)) < 0.5, np.inf, np.floor(rng.uniform(0, 6, (count, 3))) * (1 if cycles else 0.3)
    )
    times[0], times[1] = np.inf, 0.0
    runs = simulate(law, q0, x, locked=times, cycles=cycles)
    np.testing.assert_array_equal(runs.lock_time, times)
    for k in range(count):
        joints = np.flatnonzero(np.isfinite(times[k])).tolist()
        alone = simulate(law, q0[k], x[k], locked=joints, cycles=cycles, time=times[k, joints])
        np.testing.assert_array_equal(runs.q_final[k], alone.q_final)
        assert (runs.code[k], runs.time[k]) == (alone.code, alone.time)
    np.testing.assert_array_equal(runs.q_final[1], q0[1])
    path = runs.path(2, 50)
    assert (path.locked == (path.time[:, None] >= times[2])).all()
    one = simulate(law, q0[0], x[0], locked=times[3:4], cycles=cycles)
    assert one.q_final.shape == (1, 3)


def test_whole_numbers_are_lock_times_too(three):
    q0, x = RAD([20.0, 40.0, 60.0]), [-0.5, 1.8]
    runs = simulate(three, q0, x, locked=np.array([[0, 1, 2], [1, 0, 2]]))
    np.testing.assert_array_equal(runs.lock_time, [[0, 1, 2], [1, 0, 2]])
    assert runs.q_final[0, 0] == q0[0]


def test_a_healthy_arm_goes_straight(panda, rng):
    q0 = RAD([0, -45, 0, -135, 0, 90, 45]) + rng.uniform(-0.1, 0.1, 7)
    target = panda.arm.forward_kinematics(q0 + rng.uniform(-0.2, 0.2, 7))
    runs = simulate(panda, q0, target)
    assert runs.outcome == "converged"
    assert runs.path_length == pytest.approx(np.linalg.norm(target[:3, 3] - panda.arm.forward_kinematics(q0)[:3, 3]), rel=1e-6)
    np.testing.assert_allclose(runs.x_final, target, atol=2e-6)
    assert not runs.limits_passed.any()


def test_pose_tasks_of_a_seven_joint_arm_are_those_of_scipy(panda, rng):
    q0 = RAD([0, -45, 0, -135, 0, 90, 45]) + rng.uniform(-0.2, 0.2, 7)
    target = panda.arm.forward_kinematics(q0 + rng.uniform(-0.4, 0.4, 7))
    mask = np.arange(7) != 2

    def rates(q):
        pose = panda.arm.forward_kinematics(q)
        turn = Rotation.from_matrix(target[:3, :3] @ pose[:3, :3].T).as_rotvec()
        j = oracles.jacobian(panda.arm, q[None])[0]
        return mask * (np.linalg.pinv(j) @ np.r_[target[:3, 3] - pose[:3, 3], turn])

    runs = simulate(panda, q0, target, locked=[2], time_limit=6.0)
    found = solve_ivp(lambda t, q: rates(q), (0, 6), q0, "DOP853", rtol=1e-10, atol=1e-12)
    assert runs.time == pytest.approx(6)
    np.testing.assert_allclose(runs.q_final, found.y[:, -1], atol=1e-7)
    assert runs.q_final[2] == q0[2]


def test_a_law_of_many_operations_takes_its_stages_one_by_one(three, monkeypatch, random_runs):
    from holdfast.control.simulation import runge_kutta

    monkeypatch.setattr(runge_kutta, "_STAGED_OPERATIONS", 10)
    q0, x, locked, runs = random_runs
    few = np.flatnonzero(runs.time < 100)[:20]
    staged = simulate(Pseudoinverse(three.arm, "planar"), q0[few], x[few], locked=locked[few])
    assert (staged.code == runs.code[few]).all()
    np.testing.assert_allclose(staged.q_final, runs.q_final[few], atol=1e-9)
    np.testing.assert_allclose(staged.path_length, runs.path_length[few], atol=1e-9)


# ---- control cycles --------------------------------------------------------------------------------------------------


def euler(law, q, x, mask, limit=0.05, radius=0.1):
    """Cycles written apart."""
    cycle = 0
    while cycle < 1000:
        s = np.cumsum(q)
        e = x - [np.cos(s).sum(), np.sin(s).sum()]
        r = np.linalg.norm(e)
        if r <= radius:
            break
        v = e * min(1, limit / r)
        for _ in range(10):
            s = np.cumsum(q)
            j = np.array([-np.cumsum(np.sin(s)[::-1])[::-1], np.cumsum(np.cos(s)[::-1])[::-1]])
            q = q + mask * (np.linalg.pinv(j) @ v) / 10
        cycle += 1
    return cycle, q


def test_cycles(three, rng):
    law = Pseudoinverse(three.arm, "planar", speed_limit=0.05)
    q0 = rng.uniform([-3, 0.6, 0.6], [3, 1.6, 1.6], (40, 3))
    start = q_target(law, q0)
    x = start - 2 * start / np.linalg.norm(start, axis=1)[:, None] * np.where(np.linalg.norm(start, axis=1) > 1, 1, -1)[:, None]
    runs = simulate(law, q0, x, cycles=True)
    done = runs.outcome == "converged"
    assert done.mean() > 0.8
    assert np.isin(runs.time[done], (38, 39, 40, 41)).mean() > 0.9
    locked = rng.integers(0, 3, 40)
    failed = simulate(law, q0, x, locked=locked, cycles=True)
    for k in np.flatnonzero(failed.outcome == "converged")[:5]:
        cycle, q = euler(law, q0[k], x[k], np.arange(3) != locked[k])
        assert failed.time[k] == cycle
        np.testing.assert_allclose(failed.q_final[k], q, atol=1e-7)


def test_the_ready_made_trap_is_stuck_in_cycles(three):
    """Task 24 of the teleoperation paper, as far as the pseudoinverse goes."""
    law = Pseudoinverse(three.arm, "planar", speed_limit=0.05)
    fold = 45 + np.rad2deg(np.arccos(1 / np.hypot(1.5, 1.5)))
    q0 = RAD([[fold, -66.0098, 155.7258], [fold, 89.7159, -155.7257]])
    runs = simulate(law, q0, [1.5, 1.5], locked=[0], cycles=True)
    assert list(runs.outcome) == ["stuck", "converged"]
    assert runs.time[0] == pytest.approx(390, abs=15)
    assert runs.time[1] == pytest.approx(420, abs=5)
    path = runs.path(1, 50)
    np.testing.assert_allclose(path.q[-1], runs.q_final[1], atol=1e-12)
    later = simulate(law, q0[1], [1.5, 1.5], locked=[0], cycles=True, time=10)
    assert later.outcome == "converged"
    assert later.q_final[0] != q0[1, 0]


def test_the_failure_tolerant_inverse_leaves_the_trap(three):
    """Task 24 again: scenario 4 takes about 504 cycles."""
    law = FailureTolerant(three.arm, "planar", speed_limit=0.05)
    fold = 45 + np.rad2deg(np.arccos(1 / np.hypot(1.5, 1.5)))
    runs = simulate(law, RAD([fold, -66.0098, 155.7258]), [1.5, 1.5], locked=[0], cycles=True)
    assert runs.outcome == "converged"
    assert runs.time == pytest.approx(504, abs=2)


# ---- what may go wrong -----------------------------------------------------------------------------------------------


def test_rows_with_nan_are_undecided_and_alone(three, random_runs):
    q0, x, locked, runs = random_runs
    starts, targets = q0[:8].copy(), x[:8].copy()
    starts[2, 1], targets[5, 0] = np.nan, np.nan
    found = simulate(three, starts, targets, locked=locked[:8])
    bad = np.isin(np.arange(8), (2, 5))
    assert (found.reason[bad] == Reason.BAD_INPUT).all()
    assert np.isnan(found.q_final[bad]).all()
    np.testing.assert_array_equal(found.q_final[~bad], runs.q_final[:8][~bad])
    assert np.isnan(found.least_error(2)[2])
    with pytest.raises(hf.InputError, match="has no path"):
        found.path(2)
    assert len(simulate(three, np.empty((0, 3)), [1.0, 1.0])) == 0


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"target": [1, 2, 3]}, "takes \\(2,\\) or \\(N, 2\\)"),
        ({"locked": ["elbow"]}, "no joint 'elbow'"),
        ({"locked": [3]}, "joints 0 to 2"),
        ({"locked": [0], "time": -1.0}, "0 or more"),
        ({"locked": [0], "time": np.inf}, "a finite time"),
        ({"locked": [0, 1], "time": [1.0]}, "give one time, or one for each"),
        ({"locked": [0, "joint1"]}, "twice"),
        ({"locked": np.array([0, 5])}, "joints 0 to 2, and -1"),
        ({"locked": np.array([0.5])}, "one joint index for each run"),
        ({"locked": np.zeros((1, 2))}, "lock times are numbers \\(N, 3\\)"),
        ({"locked": np.zeros((1, 3), dtype=bool)}, "lock times are numbers \\(N, 3\\)"),
        ({"locked": np.array([[0.0, np.nan, np.inf]])}, "locked\\[0, 1\\] is nan; a lock time is 0 or more"),
        ({"locked": np.array([[0.0, 1.0, -np.inf]])}, "locked\\[0, 2\\] is -inf"),
        ({"locked": np.ones((2, 3)), "q0": np.zeros((3, 3))}, "the same number, or one for all"),
        ({"q0": np.zeros((2, 3)), "target": np.ones((3, 2))}, "the same number, or one for all"),
        ({"method": "euler"}, "adaptive or rk4"),
        ({"cycles": True, "method": "rk4"}, "which have a fixed method"),
        ({"step": 0.1}, "belongs to method='rk4'"),
        ({"method": "rk4", "step": 5.0}, "not stable"),
        ({"time_limit": 0}, "time_limit is 0"),
        ({"tolerance": 1e-3}, "between 1e-13 and 1e-06"),
        ({"q0": [0, np.nan, 0]}, "holds NaN"),
    ],
)
def test_wrong_input_gets_one_sentence(three, options, words):
    given = {"q0": [0.1, 0.2, 0.3], "target": [1.0, 1.0], **options}
    with pytest.raises(hf.InputError, match=words):
        simulate(three, **given)


def test_pose_tasks_want_poses(panda):
    with pytest.raises(hf.InputError, match="needs tool poses"):
        simulate(panda, np.zeros(7), [0.3, 0.2, 0.1])
    damped = Damped(panda.arm, 0.1, "position")
    runs = simulate(damped, RAD([0, -45, 0, -135, 0, 90, 45]), [0.4, 0.2, 0.5], locked=[3], time_limit=4.0, time=0.5)
    assert runs.x_final.shape == (3,)
    assert runs.target.shape == (3,)
    with pytest.raises(hf.InputError, match="no run 1"):
        runs.path(1)


def test_an_angle_given_with_a_lock_is_refused_and_not_ignored(two):
    with pytest.raises(hf.InputError, match=r"locked has 0.5 for 'joint2'; a joint locks where it is: .* its value in q0"):
        hf.simulate(
            hf.control.pseudoinverse(hf.arms.load("planar-3r"), "planar"), [0.1, 0.2, 0.3], [1, 1], locked={"joint2": 0.5}
        )
