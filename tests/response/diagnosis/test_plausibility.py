"""Records that an arm cannot have made are refused by name; their sound twins pass; damaged bounds are refused."""

from __future__ import annotations

import dataclasses
import json
import os

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.presentation import call_presenter
from holdfast.response.diagnosis.observer import accumulate_excess
from holdfast.response.faults import Log
from sealing import write_sealed

LINK = """<link name="{0}"><inertial><origin xyz="0.02 0 0.15"/><mass value="{1}"/>
<inertia ixx="0.03" iyy="0.04" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>"""
JOINT = """<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/><origin xyz="{4}"/><axis xyz="{5}"/>
<limit lower="-2.6" upper="2.6" velocity="3" effort="60"/></joint>"""
CRANE = "\n".join(
    [
        '<robot name="crane"><link name="deck"/><link name="hook"/>',
        *(LINK.format(name, mass) for name, mass in (("post", 4), ("boom", 3), ("jib", 1.5))),
        JOINT.format("slew", "continuous", "deck", "post", "0 0 0.2", "0 0 1"),
        JOINT.format("luff", "revolute", "post", "boom", "0.05 0 0.3", "0 1 0"),
        JOINT.format("fold", "revolute", "boom", "jib", "0 0 0.5", "0 1 0"),
        JOINT.format("end", "fixed", "jib", "hook", "0 0 0.3", "0 0 1"),
        "</robot>",
    ]
)


@pytest.fixture(scope="module")
def crane(tmp_path_factory):
    file = tmp_path_factory.mktemp("crane") / "crane.urdf"
    file.write_text(CRANE, encoding="utf-8")
    return hf.Arm.from_urdf(file)


@pytest.fixture(scope="module")
def healthy(crane):
    """Two logs in which the slewing joint passes the half turn; masses and friction are 20 % off the model."""
    t = np.arange(2000) / 1000
    logs = []
    for seed in range(2):
        ramp = np.minimum(t, 0.5)
        angles = [
            np.pi - 0.2 + 0.3 * ramp * t,
            0.5 - 0.3 * np.cos((1.5 + 0.3 * seed) * t),
            0.8 - 0.4 * np.cos((1.2 + 0.2 * seed) * t),
        ]
        logs.append(hf.diagnosis.simulate_log(crane, motion=np.stack(angles, axis=1), seed=seed, pose=False))
    return logs


def changed(logs, **changes):
    return [dataclasses.replace(log, **{name: change(getattr(log, name)) for name, change in changes.items()}) for log in logs]


def calibrated(arm, logs):
    return hf.diagnosis.calibrate(arm, logs, coulomb=np.full(3, 0.5), viscous=np.full(3, 0.3))


def test_sound_records_are_calibrated_and_raise_no_alarm(crane, healthy):
    bounds = calibrated(crane, healthy)
    assert not hf.diagnosis.diagnose(crane, healthy[0], bounds).verdict.alarm


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"q": np.rad2deg}, r"q of 'slew' moves 5\d(\.\d)? times as far as its q_ref; q seems to be in degrees"),
        ({"q": np.deg2rad}, r"q of 'slew' moves 0\.01\d+ times .*; q_ref seems to be in degrees"),
        ({"q": lambda q: 1000 * q}, r"q of 'slew' moves [\d.e+]+ times .*; q seems to be in mm and q_ref in m"),
        ({"q": lambda q: q / 1000}, r"q of 'slew' moves [\d.e-]+ times .*; q_ref seems to be in mm and q in m"),
        ({"q": lambda q: q * [1, 1, -1]}, r"q of 'fold' moves -\S+ times as far as its q_ref; the two have opposite signs"),
        ({"tau": lambda tau: -tau}, r"tau of .*'luff'.* has the opposite sign"),
        ({"tau": lambda tau: tau * [1, -1, 1]}, r"tau of 'luff' has the opposite sign"),
        ({"tau": lambda tau: 1000 * tau}, r"tau of .*'luff'.* is [\d.e+]+ times the torque"),
        ({"tau": lambda tau: tau / 50}, r"tau of .*'luff'.* is 0\.0\d+ times the torque"),
        ({"tau": lambda tau: tau[:, [0, 2, 1]]}, r"explains the recorded torques only in the order slew, fold, luff"),
        ({"tau": np.zeros_like}, r"tau never changes while joints move"),
        ({"q": lambda q: np.column_stack([q[:, :2], np.full(len(q), 0.4)])}, r"q of 'fold' does not follow its q_ref"),
    ],
)
def test_units_signs_order_and_missing_signals_are_named(crane, healthy, changes, message):
    with pytest.raises(InputError, match=message):
        calibrated(crane, changed(healthy, **changes))


def test_swapped_joints_are_named(crane, healthy):
    t = healthy[0].t
    wanted = np.stack([0.3 * np.sin(2 * t), 0.5 + 0.3 * np.sin(3 * t), 0.8 + 0.3 * np.cos(5 * t)], axis=1)
    log = Log(t=t, q_ref=wanted, q=wanted[:, [0, 2, 1]] + 1e-4)
    with pytest.raises(InputError, match="q of 'luff' does not follow its q_ref; it follows that of 'fold'"):
        hf.diagnosis.calibrate(crane, [log])


def test_angles_that_are_cut_off_at_a_half_turn_are_joined(crane, healthy):
    wrapped = changed(healthy, q=lambda q: np.angle(np.exp(1j * q)), q_ref=lambda q: np.angle(np.exp(1j * q)))
    assert (np.abs(np.diff(wrapped[0].q[:, 0])) > 6).any()
    whole, joined = (calibrated(crane, logs) for logs in (healthy, wrapped))
    assert joined.torque == pytest.approx(whole.torque, rel=1e-6)
    assert joined.tracking == pytest.approx(whole.tracking, abs=1e-9)
    assert not hf.diagnosis.diagnose(crane, wrapped[1], whole).verdict.alarm
    gap = changed(wrapped, q=lambda q: np.where((np.arange(len(q)) % 300 < 8)[:, None], np.nan, q))
    assert not hf.diagnosis.diagnose(crane, gap[0], whole).verdict.alarm


def test_an_uneven_clock_is_even_where_only_its_stamps_are_and_resampled_where_the_samples_are(crane, healthy, rng):
    log = healthy[0]
    stamps = log.t + rng.uniform(-0.4, 0.4, len(log.t)) * 1e-3
    only_stamps = Log(t=stamps, q_ref=log.q_ref, q=log.q, tau=log.tau)
    assert only_stamps.rate == pytest.approx(1000, rel=1e-3)
    assert len(only_stamps.t) == len(log.t)
    assert np.array_equal(only_stamps.q, log.q)
    t = np.sort(np.arange(300) * 0.01 + rng.uniform(-0.004, 0.004, 300))
    sampled = np.stack([np.sin(2 * t), np.cos(3 * t)], axis=1)
    even = Log(t=t, q_ref=sampled, q=sampled)
    assert even.rate == pytest.approx(100, rel=5e-3)
    assert np.ptp(np.diff(even.t)) < 1e-9
    true = np.stack([np.sin(2 * even.t), np.cos(3 * even.t)], axis=1)
    assert np.abs(even.q - true).max() < 9 * 0.018**2 / 8 + 1e-12  # the error of a chord over the longest step
    assert np.abs(sampled - true).max() > 5e-3
    dropped = np.delete(np.arange(300) * 0.01, [100, 101, 200])
    again = Log(t=dropped, q_ref=np.zeros((297, 2)), q=np.zeros((297, 2)))
    assert len(again.t) == 300
    assert np.flatnonzero(np.isnan(again.q[:, 0])).tolist() == [100, 101, 200]


@pytest.mark.parametrize("speed", [0.1, 0.4])
def test_a_lock_is_detected_no_later_than_calibration_prints(crane, healthy, speed):
    bounds = dataclasses.replace(calibrated(crane, healthy), speed=np.full(3, 2 * speed))
    t = np.arange(100_000) * 1e-5
    for delay, tracking in zip(bounds.lock_delays(), bounds.tracking, strict=True):
        alarm = t[(accumulate_excess(speed * t / tracking, 1e-5) > 0.020).argmax()]
        assert delay == pytest.approx(alarm, abs=1e-4)


def damage(file, key, value):
    data = json.loads(file.read_text(encoding="utf-8"))
    data.pop("digest")
    if isinstance(data[key], list) and not isinstance(value, list):
        data[key][1] = value
    else:
        data[key] = value
    write_sealed(file, data)


@pytest.mark.parametrize("value", [float("nan"), -1, 0, 1e308, "x", [1.0], [], True, 10**400])
@pytest.mark.parametrize("key", ["torque", "change", "tracking", "scales", "rate", "position", "hours"])
def test_damaged_bounds_with_a_fitting_digest_are_refused(crane, healthy, tmp_path, key, value):
    file = dataclasses.replace(calibrated(crane, healthy), position=0.01, angle=0.01).to_json(tmp_path / "bounds.json")
    damage(file, key, value)
    with pytest.raises(InputError, match="bounds '"):
        hf.diagnosis.load(file)


def test_no_changed_bit_or_digit_of_bounds_is_accepted(crane, healthy, tmp_path, rng):
    bounds = calibrated(crane, healthy)
    file = bounds.to_json(tmp_path / "bounds.json")
    sound = file.read_bytes()
    digits = [k for k, byte in enumerate(sound) if 48 <= byte <= 57]
    for trial in range(int(os.environ.get("HOLDFAST_FLIPS", "400"))):
        data = bytearray(sound)
        if trial % 2:
            data[rng.integers(len(data))] ^= 1 << rng.integers(8)
        else:
            k = digits[rng.integers(len(digits))]
            data[k] = 48 + (data[k] - 48 + rng.integers(1, 10)) % 10
        file.write_bytes(data)
        with pytest.raises(InputError, match="bounds '"):
            hf.diagnosis.load(file)
    file.write_bytes(sound.partition(b',\n  "digest"')[0] + b"\n}\n")
    with pytest.raises(InputError, match="it has no digest"):
        hf.diagnosis.load(file)
    file.write_bytes(sound)
    assert np.array_equal(hf.diagnosis.load(file).torque, bounds.torque)


def test_a_fast_record_without_torques_is_printed_without_a_warning(crane, healthy):
    """No sample is slow enough for joint sensors alone, so there is no largest tracking error; warnings are errors here."""
    bounds = hf.diagnosis.calibrate(crane, changed(healthy, tau=lambda tau: None))
    t = np.arange(300) / 1000
    fast = np.stack([2.0 * t, 0.5 + t, 0.8 - t], axis=1)
    found = hf.diagnosis.diagnose(crane, Log(t=t, q_ref=fast, q=fast + 1e-4), bounds)
    assert not found.verdict.alarm
    assert call_presenter(found, "present").tables[0].texts().rows


@pytest.mark.parametrize("joints", [[0, 1, 2], [1]])
@pytest.mark.parametrize("signal", ["q_ref", "q", "tau"])
def test_a_joint_without_a_number_is_named(crane, healthy, signal, joints):
    bounds = calibrated(crane, healthy)
    empty = np.where(np.isin(np.arange(3), joints), np.nan, 1.0)
    logs = changed(healthy, **{signal: lambda values: values * empty})
    for attempt in (lambda: calibrated(crane, logs), lambda: hf.diagnosis.diagnose(crane, logs[0], bounds)):
        with pytest.raises(InputError, match=rf"{signal} of '{crane.joint_names[joints[0]]}' has no number"):
            attempt()


def test_joints_that_move_against_each_other_are_not_taken_for_one_another(crane):
    """Joint 3 nearly mirrors joint 1, correlation -0.95, so that swapped joints look like a joint of the other sign."""
    t = np.arange(3000) / 200
    q_ref = np.stack([0.3 * np.sin(t), 0.3 * np.sin(0.7 * t), -0.3 * np.sin(t) + 0.1 * np.sin(2.3 * t)], axis=1)
    assert -0.98 < np.corrcoef(q_ref.T)[0, 2] < -0.9
    lag = q_ref - 1e-3 * np.cos(t)[:, None]
    hf.diagnosis.calibrate(crane, [Log(t=t, q_ref=q_ref, q=lag)])
    with pytest.raises(InputError, match="q of 'slew' does not follow its q_ref; it follows that of 'fold'"):
        hf.diagnosis.calibrate(crane, [Log(t=t, q_ref=q_ref, q=lag[:, ::-1])])


def test_cut_off_angles_of_a_joint_whose_limits_pass_the_half_turn():
    """Joint 2 of this arm goes from 0.8 to 5.5 rad; a driver that cuts angles off at 180 degrees gives it negative ones."""
    arm = hf.arms.load("kinova-j2s6s200")
    t = np.arange(3000) / 200
    q_ref = 3.3 + 0.3 * np.sin(t)[:, None] * np.ones(arm.n)
    whole = Log(t=t, q_ref=q_ref, q=q_ref - 1e-3 * np.cos(t)[:, None])
    cut = changed([whole], **dict.fromkeys(("q_ref", "q"), lambda q: (q + np.pi) % (2 * np.pi) - np.pi))[0]
    assert (cut.q_ref[:, 1] < 0).any()
    bounds = [hf.diagnosis.calibrate(arm, [log]) for log in (whole, cut)]
    np.testing.assert_allclose(bounds[1].tracking, bounds[0].tracking, rtol=1e-9)
