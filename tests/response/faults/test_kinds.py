"""The registry of the kinds of faults."""

from __future__ import annotations

import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.registry import read_exports
from holdfast.response.faults import kind
from holdfast.response.faults.kind import FaultKind, FaultParameter, fault_kinds, find_kind

CODES = {  # arrays of batches and of learning environments contain these codes, so they must not change
    "locked": 0,
    "limp": 1,
    "weak": 2,
    "friction": 3,
    "reduced_range": 4,
    "reduced_speed": 5,
    "sensor_bias": 6,
    "sensor_drift": 7,
    "sensor_freeze": 8,
    "sensor_noise": 9,
    "command_dropout": 10,
    "slipping_clutch": 11,
}


def kinds_with(name):
    return {known.name for known in fault_kinds().values() if known.name in CODES and getattr(known, name)}


def test_every_exported_constructor_is_a_kind_with_its_code():
    exports = read_exports("response.faults")
    exported = {
        name for module, names in exports.items() if module.startswith("holdfast.response.faults.kinds.") for name in names
    }
    assert exported == set(hf.faults.KINDS)
    assert {name: hf.faults.KINDS.index(name) for name in CODES} == CODES
    assert [known.code for known in fault_kinds().values()] == list(range(len(hf.faults.KINDS)))


def test_the_properties_of_the_kinds():
    sensors = {"sensor_bias", "sensor_drift", "sensor_freeze", "sensor_noise"}
    assert kinds_with("is_sensor") == sensors
    assert kinds_with("holds_joint") == {"locked", "slipping_clutch"}
    assert kinds_with("needs_brake") == {"locked", "slipping_clutch", "limp", *sensors}
    assert kinds_with("needs_torques") == {"limp", "weak", "friction"}
    assert kinds_with("changes_model") == set(CODES) - sensors - {"command_dropout"}
    assert kinds_with("updates_each_step") == {"reduced_speed", "command_dropout"}
    assert kinds_with("draws_noise") == {"sensor_noise"}


def test_an_unknown_kind_is_an_error():
    with pytest.raises(InputError, match="kind 'stuck' is not known; use locked, limp, weak"):
        find_kind("stuck")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"code": 3}, "weak 2, limp 3, friction 3.*each number from 0 to .* must occur once"),
        ({"parameters": ((FaultParameter("a"), FaultParameter("b"), FaultParameter("c")),)}, "'limp' has 3 parameters"),
    ],
)
def test_a_kind_that_cannot_be_registered_is_an_error(monkeypatch, change, message):
    limp = find_kind("limp")
    wrong = type("WrongKind", (FaultKind,), {"name": "limp", "code": 1} | change)()
    monkeypatch.setitem(kind._registered, "limp", wrong)
    fault_kinds.cache_clear()
    try:
        with pytest.raises(InputError, match=message):
            fault_kinds()
    finally:
        monkeypatch.undo()
        fault_kinds.cache_clear()
    assert find_kind("limp") is limp
