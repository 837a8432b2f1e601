"""Faults in simulated records, what is refused, and that the monitor in a loop says what it says of a record."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import holdfast as hf
from cards import check_card
from holdfast.core.errors import InputError
from holdfast.model.arm.poses import pose_from_quaternion
from holdfast.response.diagnosis.kinds import FaultClassifier
from holdfast.response.faults import FaultEvent, Log


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


@pytest.fixture(scope="module")
def healthy(panda):
    return [hf.diagnosis.simulate_log(panda, 2.5, seed=k) for k in range(5)]


@pytest.fixture(scope="module")
def bounds(panda, healthy):
    return hf.diagnosis.calibrate(panda, healthy, coulomb=np.full(7, 0.5), viscous=np.full(7, 0.3))


FAULTS = {
    "locked": ("panda_joint4", {}, {"locked"}),
    "limp": ("panda_joint2", {}, {"limp", "weak"}),
    "weak": ("panda_joint4", {"gain": 0.3}, {"weak"}),
    "sensor_drift": ("panda_joint6", {"rate": 0.03}, {"sensor"}),
    "sensor_freeze": ("panda_joint3", {}, {"sensor"}),
    "slipping_clutch": ("panda_joint5", {}, {"sensor"}),
}


@pytest.fixture(scope="module")
def records(panda):
    return {
        kind: hf.diagnosis.simulate_log(panda, 1.6, seed=50, faults=[FaultEvent(kind, joint, 0.9, parameters=numbers)])
        for kind, (joint, numbers, _) in FAULTS.items()
    }


@pytest.mark.parametrize("kind", FAULTS)
def test_a_fault_is_noticed_and_named(kind, panda, bounds, records):
    joint, numbers, named = FAULTS[kind]
    found = hf.diagnosis.diagnose(panda, records[kind], bounds)
    assert found.verdict.alarm
    assert 0.9 <= found.verdict.time < 1.4
    assert found.verdict.joint == joint
    assert found.verdict.kind in named
    if kind == "weak":
        assert found.verdict.loss == pytest.approx(1 - numbers["gain"], abs=min(0.1, found.verdict.uncertainty))
        assert "gives" in found.describe()[0]


def test_a_notebook_shows_both(panda, bounds, records):
    check_card(bounds, False)
    check_card(hf.diagnosis.diagnose(panda, records["locked"], bounds), True)


def test_a_push_is_nobodys_fault(panda, bounds, healthy):
    """Residuals of a force at the tool, put into a healthy record by its torques."""
    log = healthy[0]
    pushed = log.tau.copy()
    pushed[1500:] -= np.einsum("tij,i->tj", panda.jacobian(log.q[1500:])[:, :3], [0.0, 35.0, -20.0])
    found = hf.diagnosis.diagnose(panda, dataclasses.replace(log, tau=pushed), bounds)
    assert found.verdict.kind == "contact"
    assert found.verdict.joint is None


def test_pushes_on_links_are_nobodys_fault(panda, bounds):
    """Of forces in MuJoCo on the elbow and the wrist no joint is blamed; several records at once are those one by one."""
    pushes = [
        [hf.diagnosis.ExternalForce(panda.joint_names[k], (9.0, 12.0, 25.0), 0.8, end=1.2, point=(0, 0, 0.1))]
        for k in (4, 5, 6)
    ]
    logs = hf.diagnosis.simulate_logs(panda, 1.2, seeds=range(3), external_forces=pushes)
    alone = hf.diagnosis.simulate_log(panda, 1.2, seed=2, external_forces=pushes[2])
    for name in ("q", "tau", "x"):
        assert getattr(logs[2], name) == pytest.approx(getattr(alone, name), abs=1e-9, nan_ok=True)
    for log in logs:
        said = hf.diagnosis.diagnose(panda, log, bounds).verdict
        assert said.time > 0.8
        assert (said.kind, said.joint) == ("contact", None)
    with pytest.raises(InputError, match="external_forces has entries for 1 logs and there are 2 seeds; give one for each"):
        hf.diagnosis.simulate_logs(panda, 1.0, seeds=[1, 2], external_forces=[[]])


def test_a_push_that_one_joint_alone_feels(panda, bounds, healthy):
    """Along its motion no fault of a joint that follows explains it; against its motion it cannot be told from friction."""
    log = healthy[0]
    way = np.sign(log.q[700, 0] - log.q[600, 0])
    for sense, joint in ((1, None), (-1, "panda_joint1")):
        tau = log.tau.copy()
        tau[600:, 0] -= sense * way * 5.0
        said = hf.diagnosis.diagnose(panda, dataclasses.replace(log, tau=tau), bounds).verdict
        assert 0.6 < said.time < 0.7
        assert said.joint == joint
        assert "contact" in said.candidates


def test_a_joint_that_is_let_go_is_blamed_despite_a_push(panda, bounds):
    """The force explains the torques of the first 20 ms better than one joint, but not where the joint is after 100 ms more."""
    log = hf.diagnosis.simulate_log(panda, 1.2, seed=77, faults=[FaultEvent("limp", "panda_joint4", 0.9)])
    tau = log.tau.copy()
    tau[900:] -= np.einsum("tij,i->tj", panda.jacobian(log.q[900:])[:, :3], [0.0, 20.0, -10.0])
    log = dataclasses.replace(log, tau=tau)
    monitor = hf.diagnosis.Monitor(panda, bounds)
    kinds = [monitor.step(*row).kind for row in zip(log.q, log.q_ref, log.tau, strict=True)]
    assert kinds.index("contact") < kinds.index("limp")
    said = hf.diagnosis.diagnose(panda, log, bounds).verdict
    assert (said.joint, said.kind) == ("panda_joint4", "limp") == (monitor.verdict.joint, monitor.verdict.kind)


def named(torque, residual, *, behind=1e-3, coulomb=0.5):
    """What is said of a joint that moves at 0.3 rad/s while its servo gives a torque, and that much is not explained."""
    kinds = FaultClassifier(0, coulomb=coulomb, bounds=(2.0, 0.01), largest=1.3, noise=2e-5, torques=True)
    for k, (given, r) in enumerate(zip(torque.tolist(), residual.tolist(), strict=True)):
        kinds.add_cycle(3e-4 * k - behind, 3e-4 * k, 1.0, (r, given, 0.0))
    return kinds.classify("rad", ())["kind"]


def test_what_follows_against_its_motor_is_pushed():
    """A motor that gives nothing lets its joint go, which needs no torque then: it can lose all that it gives, and no more."""
    same, grows = np.full(100, 4.0), 4.0 + 1e-2 * np.arange(100.0) ** 2
    assert named(-same, same + 0.6) == "contact"
    assert named(-same, same) == "limp"  # it moves as if by nothing
    assert named(-same, same + 0.2) == "limp"  # masses and friction are not known better
    assert named(-grows, grows) == "limp"
    assert named(-same, same + 0.6, behind=0.02) == "limp"
    assert named(-same, same + 0.6, coulomb=2.0) == "limp"  # not what it needs to move as it does
    assert named(-16 / grows, 16 / grows + 0.6) == "contact"
    wave = 13 + 4 * np.sin(2 * np.pi / 25 * np.arange(100))
    assert named(wave, -2 * same) == "friction"


def test_nothing_seen_is_not_called_well(panda, bounds, healthy):
    still = dataclasses.replace(healthy[0], q=healthy[0].q.copy(), q_ref=healthy[0].q_ref.copy(), x=None, quat=None)
    still.q_ref[:, 2] = still.q[:, 2] = 0.1
    said = hf.diagnosis.diagnose(panda, still, dataclasses.replace(bounds, torque=np.full(7, np.inf))).describe()
    assert said[0] == "No fault was detected in 2.499 s."
    assert "These joints did not move enough for a diagnosis: panda_joint3." in said
    assert "Not monitored: torques, the measured tool pose." in said
    assert not any("healthy" in line or "fine" in line for line in said)


@pytest.mark.parametrize("seen", [True, False], ids=["pose", "no pose"])
def test_a_loop_says_what_a_record_says(seen, panda, bounds, records):
    monitor = hf.diagnosis.Monitor(panda, bounds)
    for kind in ("locked", "weak", "sensor_freeze", "slipping_clutch")[: 4 if seen else 2]:
        log = records[kind] if seen else dataclasses.replace(records[kind], x=None, quat=None)
        whole = monitor.run(log).verdict
        monitor.reset()
        there = np.flatnonzero(np.isfinite(log.x).all(axis=1)) if seen else []
        poses = dict(zip(there, map(pose_from_quaternion, log.x[there], log.quat[there]), strict=True)) if seen else {}
        rows = enumerate(zip(log.q, log.q_ref, log.tau, strict=True))
        told = [monitor.step(*row, pose=poses.get(k)) for k, row in rows]
        first = next(v for v in told if v.alarm)
        assert first.time == pytest.approx(whole.time, abs=1e-9)
        assert (first.joint, first.kind) == (None, "unknown")
        assert (told[-1].joint, told[-1].kind, told[-1].candidates) == (whole.joint, whole.kind, whole.candidates)
        assert told[-1].loss == pytest.approx(whole.loss, nan_ok=True)
        assert told[-1].evidence == whole.evidence
    monitor.reset()
    assert not monitor.step(log.q[0], log.q_ref[0], log.tau[0]).alarm
    assert not monitor.step(log.q[0] * np.nan, log.q_ref[0], log.tau[0], pose=np.full((4, 4), np.nan)).alarm


def test_a_pose_that_comes_late_and_numbers_that_do_not_come(panda, bounds, records, healthy):
    """Late poses name the sensor that timely ones name; gaps of every length are nobody's fault, and said after 50 ms."""
    log, late = records["sensor_drift"], 9
    poses = {k + late: pose_from_quaternion(log.x[k], log.quat[k]) for k in np.flatnonzero(np.isfinite(log.x).all(axis=1))}
    monitor = hf.diagnosis.Monitor(panda, bounds, sensors=hf.diagnosis.Sensors(latency=0.009))
    rows = enumerate(zip(log.q, log.q_ref, log.tau, strict=True))
    told = [monitor.step(*row, pose=poses.get(k)) for k, row in rows]
    whole = monitor.run(log).verdict
    assert (told[-1].joint, told[-1].kind) == (whole.joint, whole.kind) == ("panda_joint6", "sensor")
    assert whole.time <= told[-1].time + 1e-9 <= whole.time + 0.010
    log, monitor = healthy[1], hf.diagnosis.Monitor(panda, bounds)
    for gap in (1, 10, 40, 60, 400):
        monitor.reset()
        for k, row in enumerate(zip(log.q, log.q_ref, log.tau, strict=True)):
            missing = 1000 <= k < 1000 + gap
            monitor.step(row[0] * np.nan if missing else row[0], *row[1:])
            assert monitor.stale == (("joints",) if missing and k - 1000 >= 50 else ())
        assert not monitor.verdict.alarm
    with pytest.raises(InputError, match="latency is -1 s; it must be 0 to 1 s"):
        hf.diagnosis.Sensors(latency=-1)


def test_gaps_in_a_record_are_nobodys_fault(panda, bounds):
    """Filters begin anew after long ones, the answer says that nothing was looked at then, and a lock after them is noticed.

    So says the loop, whose residual after them is the same; rows that are not there are as rows of NaN.
    """
    fault = [FaultEvent("locked", "panda_joint4", 11.8)]
    log = hf.diagnosis.simulate_log(panda, 12.0, seed=1, faults=fault, pose=False)
    missing, long = np.zeros(len(log.t), dtype=bool), ((0.70, 0.76), (0.9, 1.4), (1.5, 11.5))
    for start, end in ((0.5, 0.52), *long):
        missing[round(1000 * start) : round(1000 * end)] = True
    holes = {name: np.where(missing[:, None], np.nan, getattr(log, name)) for name in ("q", "tau")}
    given = {name: getattr(log, name) for name in ("t", "q_ref", "q", "tau")}
    monitor = hf.diagnosis.Monitor(panda, bounds)
    for row in zip(holes["q"], log.q_ref, holes["tau"], strict=True):
        told = monitor.step(*row)
    for record in (Log(**{**given, **holes}), Log(**{name: value[~missing] for name, value in given.items()})):
        found = hf.diagnosis.diagnose(panda, record, bounds)
        assert (found.verdict.joint, found.verdict.time) == ("panda_joint4", pytest.approx(11.8, abs=0.05))
        assert found.signals.torque[-1] == pytest.approx(monitor._residual, abs=1e-9)
        assert (told.time, told.joint, told.kind) == (
            pytest.approx(found.verdict.time),
            found.verdict.joint,
            found.verdict.kind,
        )
        assert np.ravel(found.gaps) == pytest.approx(np.ravel(long), abs=2e-3)
        assert "Nothing was checked for 10.56 s, because there the log has no joint values." in found.describe()


def test_joint_sensors_alone_are_heard_in_slow_motion(panda, healthy, records):
    """Without torques: a lock is seen while every reference is slow, and nothing is counted within 0.1 s of fast motion."""
    logs = [dataclasses.replace(log, tau=None, x=None, quat=None) for log in healthy]
    alone = hf.diagnosis.calibrate(panda, logs)
    assert alone.factor == 2.5
    log = dataclasses.replace(records["locked"], tau=None, x=None, quat=None)
    monitor = hf.diagnosis.Monitor(panda, alone)
    found = monitor.run(log).verdict
    assert (found.joint, found.kind) == ("panda_joint4", "locked")
    told = [monitor.step(*row) for row in zip(log.q, log.q_ref, strict=True)]
    assert (told[-1].time, told[-1].joint) == (pytest.approx(found.time), found.joint)
    hasty = log.q_ref.copy()
    hasty[800::90, 6] += 2e-3  # 2 rad/s for a sample, every 90 ms
    assert not monitor.run(dataclasses.replace(log, q_ref=hasty)).verdict.alarm
    with pytest.raises(InputError, match="neither torques nor slow motion"):
        hf.diagnosis.calibrate(panda, [dataclasses.replace(log, q_ref=log.q_ref + 0.03 * np.sin(60 * log.t[:, None]))])


def test_a_motion_is_looked_at_beforehand(panda, bounds, records):
    """What is predicted is what happens: the delay within a factor 2, on a robot whose masses are off."""
    log, i = records["locked"], 3
    seen = hf.diagnosis.predict_detection(panda, log.q_ref, bounds=bounds)
    assert seen.unseen == ()
    assert set(seen.alike) == {"panda_joint1", "panda_joint5", "panda_joint7"}
    assert np.isfinite(seen.delays[:, i]).all()
    inertia = panda.inertia_diagonal(log.q_ref[::100]).max(axis=0) + 0.1  # the rotors of rehearse
    gains = {"stiffness": (20 * np.pi) ** 2 * inertia, "damping": 40 * np.pi * inertia}
    predicted = hf.diagnosis.expected_delays(bounds, log.q_ref, **gains, onset=0.9)[i]
    measured = hf.diagnosis.diagnose(panda, log, bounds).verdict.time - 0.9
    assert predicted / 2 < measured < 2 * predicted


def test_false_alarms_are_counted_and_bounded(bounds, healthy):
    hours = sum(log.duration for log in healthy) / 3600
    rate, limit = bounds.false_alarms()
    assert rate == bounds.alarms / hours
    assert limit >= rate
    none = dataclasses.replace(bounds, alarms=0, hours=10.0).false_alarms()
    assert none == (0, pytest.approx(-np.log(0.05) / 10))  # Poisson: exp(-limit hours) = 5 %
    assert dataclasses.replace(bounds, alarms=None).false_alarms() is None
    some = dataclasses.replace(bounds, alarms=3, hours=2.0).false_alarms()[1]
    terms = np.cumprod(np.r_[1.0, 2 * some / np.arange(1, 4)])
    assert np.exp(-2 * some) * terms.sum() == pytest.approx(0.05)


def test_masses_of_a_robot_are_found_from_its_records(panda):
    """What rehearse drew, of the links that gravity shows; and tighter bounds, with which another motion does not alarm."""
    logs = [hf.diagnosis.simulate_log(panda, 5.0, seed=20 + k, robot=3, pose=False) for k in range(3)]
    given = {"coulomb": np.full(7, 0.5), "viscous": np.full(7, 0.3)}
    fit = hf.diagnosis.calibrate(panda, logs[:2], **given, fit=True)
    true = 1 + np.random.default_rng([1, 3]).uniform(-0.2, 0.2, 7)
    assert fit.scales[[2, 3, 4]] == pytest.approx(true[[2, 3, 4]], abs=0.08)
    plain = hf.diagnosis.calibrate(panda, logs[:2], **given)
    assert (fit.torque[1:6] < plain.torque[1:6]).all()
    assert fit.torque[1] < 0.75 * plain.torque[1]
    assert not hf.diagnosis.diagnose(panda, logs[2], dataclasses.replace(fit, tracking=plain.tracking)).verdict.alarm
    assert fit.coulomb == pytest.approx(0.5, abs=1e-3)
    torque = fit.body(panda).gravity_torque(np.zeros(7))
    links = [dataclasses.replace(x, mass=x.mass * s) for x, s in zip(panda.links, fit.scales, strict=True)]
    assert torque == pytest.approx(dataclasses.replace(panda, links=tuple(links)).gravity_torque(np.zeros(7)))


def test_bounds_and_records_come_back_from_files(panda, bounds, healthy, tmp_path):
    known = hf.diagnosis.load(bounds.to_json(tmp_path / "bounds.json"))
    assert all(np.array_equal(getattr(known, name), value) for name, value in vars(bounds).items())
    log = Log(**{f.name: getattr(healthy[0], f.name)[:200] for f in dataclasses.fields(Log)})
    for name, digits in (("log.npz", 1e-6), ("log.csv", 1e-8), ("log.parquet", 0)):
        if name == "log.parquet":
            pytest.importorskip("pyarrow")
        again = Log.load(log.save(tmp_path / name))
        for field in dataclasses.fields(Log):
            assert getattr(again, field.name) == pytest.approx(getattr(log, field.name), rel=digits, abs=digits, nan_ok=True)
    (tmp_path / "bounds.json").write_text("{}", encoding="utf-8")
    with pytest.raises(InputError, match="it has no digest"):
        hf.diagnosis.load(tmp_path / "bounds.json")


def test_a_late_pose_from_parquet_is_in_time(panda, bounds, healthy, tmp_path):
    """A record of a database, whose tool was measured 9 ms before it was written: without saying so it looks like a sensor."""
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    log, late = healthy[0], 9
    columns = {"t": log.t, "note": ["a"] * len(log.t)}
    for name in ("q_ref", "q", "tau", "x", "quat"):
        values = getattr(log, name)
        if name in ("x", "quat"):
            values = np.concatenate([np.full((late, values.shape[1]), np.nan), values[:-late]])
        columns |= {f"{name}_{k + 1}": column for k, column in enumerate(values.T)}
    parquet.write_table(pyarrow.table(columns), tmp_path / "log.parquet")
    timely = Log.load(tmp_path / "log.parquet", latency=0.009)
    assert np.array_equal(timely.q, log.q)
    assert np.array_equal(timely.x[:-late], log.x[:-late], equal_nan=True)
    assert not hf.diagnosis.diagnose(panda, timely, bounds).verdict.alarm
    assert hf.diagnosis.diagnose(panda, Log.load(tmp_path / "log.parquet"), bounds).verdict.kind == "sensor"
    with pytest.raises(InputError, match="latency is 3 s; it must be 0 or more"):
        Log.load(tmp_path / "log.parquet", latency=3.0)
    with pytest.raises(InputError, match="it is not a readable Parquet file"):
        Log.load((tmp_path / "log.csv").rename(tmp_path / "x.parquet") if log.save(tmp_path / "log.csv") else "")


def test_what_does_not_go_together_is_refused(panda, bounds, healthy):
    with pytest.raises(InputError, match="the thresholds are not of"):
        hf.diagnosis.Monitor(hf.arms.load("planar-3r"), bounds)
    slow = dataclasses.replace(healthy[0], t=healthy[0].t * 2)
    with pytest.raises(InputError, match="the log has 500 samples a second and the thresholds have 1000"):
        hf.diagnosis.diagnose(panda, slow, bounds)
    with pytest.raises(InputError, match=r"factor is 0\.5; it must"):
        hf.diagnosis.calibrate(panda, healthy[:1], factor=0.5)
    with pytest.raises(InputError, match="'panda_joint1' never departs from its reference"):
        hf.diagnosis.calibrate(panda, [dataclasses.replace(healthy[0], q_ref=healthy[0].q)])
