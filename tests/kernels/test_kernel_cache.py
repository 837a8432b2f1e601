"""Compiled kernels on disk."""

from __future__ import annotations

import os
import stat

import casadi as ca
import numpy as np
import pytest

from holdfast.kernels import Kernel, cache
from holdfast.kernels.llvm import machine_code


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("HOLDFAST_CACHE", str(tmp_path / "here"))
    return tmp_path / "here" / "kernels"


@pytest.fixture
def compilations(monkeypatch):
    """Names of the kernels compiled during the test."""
    names: list[str] = []
    compile_program = machine_code.compile_program

    def counting(program, *level):
        names.append(program.name)
        return compile_program(program, *level)

    monkeypatch.setattr(machine_code, "compile_program", counting)
    return names


def build(constant=3.0, name="cached"):
    x = ca.SX.sym("x", 2)
    return Kernel(name, [x], [ca.sin(x) * constant + x[0] * x[1]], backend="llvm")


def files(folder):
    return sorted(p for p in folder.iterdir())


X = np.linspace(-1, 1, 50).reshape(25, 2)


def test_the_second_build_loads_and_computes_the_same_bits(folder, compilations, monkeypatch):
    first = build()(X)
    assert len(files(folder)) == 1

    def never(program, *level):
        raise AssertionError("compiled again")

    monkeypatch.setattr(machine_code, "compile_program", never)
    np.testing.assert_array_equal(build(name="another name, the same computation")(X), first)
    assert compilations == ["cached"]


def test_another_computation_is_another_entry(folder, compilations):
    first = build(3.0)(X)
    second = build(np.nextafter(3.0, 4.0))(X)
    assert len(compilations) == len(files(folder)) == 2
    assert not np.array_equal(first, second)  # the last bit of a constant counts


def test_the_casadi_backend_stores_nothing(folder):
    x = ca.SX.sym("x")
    Kernel("plain", [x], [x * x], backend="casadi")(2.0)
    assert not folder.exists()


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: b"",
        lambda data: data[:20],
        lambda data: data[:-1],
        lambda data: data + b"x",
        lambda data: data[:100] + bytes([data[100] ^ 1]) + data[101:],
        lambda data: bytes([data[0] ^ 128]) + data[1:],
    ],
    ids=["empty", "short", "cut", "longer", "one bit of the body", "one bit of the checksum"],
)
def test_a_damaged_file_is_compiled_anew(damage, folder, compilations):
    first = build()(X)
    (file,) = files(folder)
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    np.testing.assert_array_equal(build()(X), first)
    assert len(compilations) == 2
    assert len(files(folder)) == 1
    np.testing.assert_array_equal(build()(X), first)
    assert len(compilations) == 2  # repaired


def test_the_folder_is_private(folder):
    build()
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    assert all(stat.S_IMODE(p.stat().st_mode) & 0o077 == 0 for p in files(folder))


def test_off(tmp_path, compilations, monkeypatch):
    monkeypatch.setenv("HOLDFAST_CACHE", "off")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    first = build()(X)
    np.testing.assert_array_equal(build()(X), first)
    assert len(compilations) == 2
    assert cache.cache_folder() is None
    assert list(tmp_path.iterdir()) == []


def test_the_users_cache_folder_is_the_default(tmp_path, monkeypatch):
    monkeypatch.delenv("HOLDFAST_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache.cache_folder() == tmp_path / "holdfast" / "kernels"


def test_a_folder_that_cannot_be_made_costs_only_time(tmp_path, compilations, monkeypatch):
    blocker = tmp_path / "file"
    blocker.write_text("not a folder")
    monkeypatch.setenv("HOLDFAST_CACHE", str(blocker / "below"))
    assert cache.cache_folder() is None
    np.testing.assert_allclose(build()(X)[:, 0], np.sin(X[:, 0]) * 3 + X[:, 0] * X[:, 1], rtol=1e-14)
    assert compilations == ["cached"]


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="users have no numbers here")
def test_a_folder_of_somebody_else_is_not_used(folder, compilations, monkeypatch):
    build()
    me = os.getuid()
    monkeypatch.setattr(os, "getuid", lambda: me + 1)
    assert cache.cache_folder() is None
    build()
    assert len(compilations) == 2


@pytest.mark.parametrize("step", ["mkstemp", "replace"])
def test_a_full_disk_costs_only_time_and_leaves_nothing(step, folder, compilations, monkeypatch):
    def full(*args, **kwargs):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(cache.tempfile if step == "mkstemp" else cache.os, step, full)
    first = build()(X)
    assert files(folder) == []
    monkeypatch.undo()
    np.testing.assert_allclose(first[:, 1], np.sin(X[:, 1]) * 3 + X[:, 0] * X[:, 1], rtol=1e-14)


def test_keys_name_the_width_and_the_machine(monkeypatch):
    assert cache.cache_key("a", 8) != cache.cache_key("a", 16)
    assert cache.cache_key("a", 8) != cache.cache_key("b", 8)
    before = cache.cache_key("a", 8)
    monkeypatch.setattr(cache, "_machine_digest", lambda: "another processor")
    assert cache.cache_key("a", 8) != before


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes here")
def test_a_pipe_or_a_link_in_place_of_a_file_is_not_read(folder, compilations, tmp_path):
    first = build()(X)
    (file,) = files(folder)
    elsewhere = tmp_path / "elsewhere"
    file.rename(elsewhere)
    os.mkfifo(file)
    np.testing.assert_array_equal(build()(X), first)  # nor waited for
    file.unlink()
    file.symlink_to(elsewhere)
    np.testing.assert_array_equal(build()(X), first)
    assert len(compilations) == 3


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="no owners here")
def test_what_others_may_write_is_not_read(folder, compilations):
    build()
    (file,) = files(folder)
    file.chmod(0o622)
    build()
    assert len(compilations) == 2
    folder.chmod(0o777)
    assert cache.cache_folder() is None
    build()
    assert len(compilations) == 3


def test_nothing_in_a_file_is_executed_but_a_kernel_of_this_machine(folder, compilations):
    """A stored kernel is bytes behind a checksum; its name is bound to processor, versions and translation."""
    build()
    (file,) = files(folder)
    assert file.read_bytes().startswith(b"holdfast kernel 1\n")
    assert file.name == cache.cache_key(build().program.digest, 1, machine_code.detect_processor().machine.lanes)


def test_the_folder_has_a_bound(folder, monkeypatch):
    """What was not used for longest goes; reading a kernel counts as using it."""
    made = []
    for k in range(3):
        build(k + 1.5)
        (new,) = (p for p in files(folder) if p not in made)
        made.append(new)
        os.utime(new, (k + 1, k + 1))
    build(1.5)  # used again
    monkeypatch.setattr(cache, "_MAX_FOLDER_BYTES", int(3.5 * made[0].stat().st_size))
    build(4.5)
    kept = files(folder)
    assert len(kept) == 3
    assert made[0] in kept
    assert made[1] not in kept


def test_a_home_that_is_not_there(monkeypatch, compilations):
    monkeypatch.delenv("HOLDFAST_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", "/proc/nowhere")
    build()
    assert cache.cache_folder() is None
