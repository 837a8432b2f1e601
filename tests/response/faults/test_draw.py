"""Draws of faults against a reference written from the definition of Philox's words, and what is refused."""

from __future__ import annotations

import hashlib
import json
import math

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError, StoreError

JOINTS = ("a", "b", "c", "d")
MODEL = hf.faults.FaultModel(
    [
        hf.faults.locked(onset=(0.3, 1.5), probability=0.5),
        hf.faults.weak(["b", "d"], weights=[3, 1], gain=(0.2, 0.7), onset={"exponential": 4.0}),
        hf.faults.sensor_bias(bias={"loguniform": [1e-3, 1e-1]}, rate_per_hour=600, duration=(1, 2), together=2),
    ],
    seed=2**64 + 7,
)


def reference(seed, episode, entry):
    """Philox4x64-10 from Salmon et al. 2011, in whole numbers of Python: eight uniform numbers."""
    multiply, weyl, mask = (0xD2E7470EE14C6C93, 0xCA5A826395121157), (0x9E3779B97F4A7C15, 0xBB67AE8584CAA73B), 2**64 - 1
    found = []
    for counter in (1, 2):  # NumPy counts up before it makes four words
        x, key = [counter, 0, 0, 0], [seed % 2**64, (65536 * episode + entry) % 2**64]
        for _ in range(10):
            high = [(m * v) >> 64 for m, v in zip(multiply, x[::2], strict=True)]
            low = [(m * v) & mask for m, v in zip(multiply, x[::2], strict=True)]
            x = [high[1] ^ x[1] ^ key[0], low[1], high[0] ^ x[3] ^ key[1], low[0]]
            key = [(k + w) & mask for k, w in zip(key, weyl, strict=True)]
        found += [(word >> 11) * 2.0**-53 for word in x]
    return found


def expected(episode, horizon):
    """Events of MODEL, written out by hand for its three entries."""
    events = []
    u = reference(7, episode, 0)
    if u[0] < 0.5:
        joint = JOINTS[int(4 * u[1])]
        events.append({"kind": "locked", "joint": joint, "onset": round(0.3 + 1.2 * u[2], 6), "end": None, "at": "here"})
    u = reference(7, episode, 1)
    onset, gain = round(-4 * math.log1p(-u[2]), 6), round(0.2 + 0.5 * u[3], 9)
    events.append({"kind": "weak", "joint": "b" if u[1] < 0.75 else "d", "onset": onset, "end": None, "gain": gain})
    u = reference(7, episode, 2)
    if (onset := -6 * math.log1p(-u[2])) <= horizon:
        onset = round(onset, 6)
        end, bias = round(onset + 1 + u[5], 6), round((-1 if u[4] < 0.5 else 1) * 1e-3 * 100 ** u[3], 9)
        first = JOINTS[int(4 * u[1])]
        second = [joint for joint in JOINTS if joint != first][int(3 * u[6])]
        events += [{"kind": "sensor_bias", "joint": j, "onset": onset, "end": end, "bias": bias} for j in (first, second)]
    return sorted(events, key=lambda event: (event["onset"], event["joint"], event["kind"]))


def test_draws_are_those_of_the_reference():
    some = {0: 0, 1: 0}
    for episode in [*range(40), 2**47]:
        want = expected(episode, 5.0)
        events = MODEL.draw(JOINTS, episode=episode, horizon=5.0)
        assert [event.to_stored() for event in events] == want
        text = json.dumps(want, sort_keys=True, separators=(",", ":"))
        assert events.id == hashlib.sha256(text.encode()).hexdigest()
        some[len(want) > 2] += 1
    assert min(some.values()) > 3


def test_draws_stay_what_they_were():
    """Written down from the reference: what a machine or a version of NumPy changes, changes these."""
    assert [event.sentence() for event in MODEL.draw(JOINTS, episode=3, horizon=5.0)] == [
        "c: locked from 0.7722 s on",
        "b: weak from 4.304 s on (gain 0.5603)",
    ]
    assert MODEL.draw(JOINTS, episode=3, horizon=5.0).id == "994b4a7f3a58997cbdd06887378f2252aeadbd8f0d1412c6d9472fafe06f2bc4"
    assert hf.faults.FaultEvents().id == hashlib.sha256(b"[]").hexdigest()


def test_an_entry_changes_no_other():
    more = hf.faults.FaultModel([*MODEL.entries, hf.faults.limp("c", onset=9.0)], MODEL.seed)
    for episode in range(5):
        before, after = MODEL.draw(JOINTS, episode=episode), more.draw(JOINTS, episode=episode)
        assert set(before) == {event for event in after if event.kind != "limp"}


def test_a_fault_that_comes_and_goes_has_exponential_dwell_times():
    faults = hf.faults.FaultModel([hf.faults.command_dropout("a", onset=1.0, on=0.2, off=0.6)], seed=5)
    spans = np.array([(e.onset, e.end) for e in faults.draw(JOINTS, horizon=1600.0)])
    lengths, gaps = spans[:-1, 1] - spans[:-1, 0], spans[1:, 0] - spans[:-1, 1]
    assert spans[0, 0] == 1.0
    assert spans[-1, 1] <= 1600.0
    assert (gaps > 0).all()
    for mean, times in ((0.2, lengths), (0.6, gaps)):  # mean and deviation of an exponential law are alike
        error = 5 * mean / np.sqrt(len(times))
        assert abs(times.mean() - mean) < error
        assert abs(times.std() - mean) < 2 * error
    short = faults.draw(JOINTS, horizon=3.0)
    assert [e.onset for e in short] == spans[: len(short), 0].tolist()


def test_a_batch_holds_the_first_fault_of_each_joint():
    faults = hf.faults.FaultModel(
        [hf.faults.friction("b", viscous=2.0, onset=3.0), hf.faults.weak("b", gain=0.5, onset=1.0), hf.faults.limp("d")]
    )
    batch = faults.batch(JOINTS, episodes=2, first=4)
    assert batch.kind.tolist() == [[-1, hf.faults.KINDS.index("weak"), -1, hf.faults.KINDS.index("limp")]] * 2
    assert batch.onset[0].tolist() == [np.inf, 1.0, np.inf, 0.0]
    assert batch.parameter[1, 1, 0] == 0.5
    assert np.isnan(batch.parameter).sum() == batch.parameter.size - 2
    assert batch.left_out == 2
    late = hf.faults.FaultModel([faults.entries[0]]).batch(JOINTS, episodes=1)
    assert late.parameter[0, 1].tolist()[1:2] == [2.0]  # viscous is the second number of its kind


def test_a_file_gives_the_model_back(tmp_path):
    entries = [
        *MODEL.entries,
        hf.faults.reduced_range("a", travel=0.1, on=1.0, off=2.0),
        hf.faults.locked("c", at={"choice": [0.1, 0.2]}, duration=3),
    ]
    model = hf.faults.FaultModel(entries, seed=3)
    path = model.save(tmp_path / "faults.yaml")
    assert hf.faults.load(path) == model
    path.write_text("faults: [{kind: limp, on: 1, off: 1e-1, duration: 3}]", encoding="utf-8")  # YAML: true and false
    assert hf.faults.load(path).entries == (hf.faults.limp(on=1, off=0.1, duration=3),)
    with pytest.raises(StoreError, match="cannot write"):
        model.save(tmp_path / "no" / "faults.yaml")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{kind: stuck}", r"faults\[0\]: kind 'stuck' is not known; use locked, "),
        ("{kind: weak, gian: 0.3}", "the key 'gian' is not known"),
        ("{kind: weak, gain: 1.2}", "gain of 'weak' is 1.2; it must be between 0 and 1"),
        ("{kind: weak, gain: {exponential: 0.5}}", "gain of 'weak' is from 0 to inf; it must be between"),
        ("{kind: weak}", "'weak' must have gain or ceiling"),
        ("{kind: weak, gain: 0.5, ceiling: 0.5}", "'weak' must have gain or ceiling"),
        ("{kind: limp, gain: 0.5}", "'limp' has no parameter 'gain'; it takes no parameter"),
        ("{kind: limp, onset: {uniform: [2, 1]}}", "onset of 'limp' is from 2 to 1; give the lower end first"),
        ("{kind: limp, onset: {normal: [2, 1]}}", "onset of 'limp' has the keys normal; it must be a number"),
        ("{kind: limp, onset: -1}", "onset of 'limp' is -1; it must be 0 or more"),
        ("{kind: limp, onset: 1, rate_per_hour: 2}", "both onset and rate_per_hour"),
        ("{kind: sensor_bias, bias: -0.1}", "it must be 0 or more; its sign is random"),
        ("{kind: limp, joints: [a, a]}", "name each once"),
        ("{kind: limp, joints: [a, b], weights: [1]}", "has 1 weights; give one for each of its joints"),
        ("{kind: limp, joints: [a], together: 2}", "together of 'limp' is 2"),
        ("{kind: limp, probability: 2}", "probability of 'limp' is 2.0; it must be between 0 and 1"),
        ("{kind: limp, on: 2}", "only one of on and off"),
    ],
)
def test_a_file_that_is_wrong_says_where(text, words, tmp_path):
    path = tmp_path / "faults.yaml"
    path.write_text(f"faults: [{text}]", encoding="utf-8")
    with pytest.raises(InputError, match=words) as error:
        hf.faults.load(path)
    assert str(error.value).startswith(f"faults file '{path}': ")


def test_what_a_draw_refuses():
    with pytest.raises(InputError, match="'limp' names joint 'x'; the joints are a, b, c, d"):
        hf.faults.FaultModel([hf.faults.limp("x")]).draw(JOINTS)
    with pytest.raises(InputError, match="is intermittent without an end"):
        hf.faults.FaultModel([hf.faults.limp("a", on=1, off=1)]).draw(JOINTS)
    with pytest.raises(InputError, match="together of 'limp' is 5, and there are 4 joints"):
        hf.faults.FaultModel([hf.faults.limp(together=5)]).draw(JOINTS)
    with pytest.raises(InputError, match="episode is -1"):
        MODEL.draw(JOINTS, episode=-1)
    with pytest.raises(InputError, match="it must be a sequence, each a Fault"):
        hf.faults.FaultModel(["locked"])
