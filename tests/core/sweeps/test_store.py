"""The results folder: commit, resume, and one sentence for everything that can be wrong with a folder or a disk."""

from __future__ import annotations

import errno
import json
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import xarray as xr
import zarr

from holdfast.core.errors import StoreError
from holdfast.core.files.digest import seal_document
from holdfast.core.sweeps import Column, Store

COLUMNS = [
    Column("x", "float64", (("axis", 2),), units="m", about="where"),
    Column("count", "int16", (), units="1", about="how many"),
    Column("status", "uint8"),
]
PLAN = {"kind": "test", "seed": 3, "nested": {"a": [1, 2]}}
ROWS, CHUNK = 23, 5  # four chunks of five rows, one of three


def rows(start, stop):
    k = np.arange(start, stop)
    return {"x": np.stack([k / 7, -k], 1), "count": k.astype(np.int16), "status": np.zeros(stop - start, np.uint8)}


def make(folder, **changes) -> Store:
    return Store.create(folder, **{"plan": PLAN, "columns": COLUMNS, "rows": ROWS, "chunk": CHUNK, **changes})


def fill(folder, chunks=None) -> Store:
    opened = make(folder)
    with opened.lock_for_writing():
        for k in opened.missing_chunks if chunks is None else chunks:
            opened.commit_chunk(k, rows(*opened.chunks[k]))
    return opened


def snapshot(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def read_unsealed(file: Path):
    """As tests/sealing.py, which the programs of this file cannot import."""
    return {key: value for key, value in json.loads(file.read_text()).items() if key != "digest"}


def write_sealed(file: Path, data):
    file.write_text(seal_document(data))


def sentence(error) -> str:
    message = str(error.value)
    assert "\n" not in message
    assert len(message) < 400
    return message


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "run"


# ---- writing and going on ------------------------------------------------------------------------------------------


def test_rows_come_back_with_names_units_and_fill_values(folder):
    s = fill(folder, [0, 4])
    assert s.chunks == [(0, 5), (5, 10), (10, 15), (15, 20), (20, 23)]
    assert (s.committed_chunks, s.missing_chunks, s.is_complete) == ([0, 4], [1, 2, 3], False)
    data = Store.open(folder).dataset()
    expected = rows(0, ROWS)
    for name in expected:
        for a, b in ((0, 5), (20, 23)):
            assert data[name].values[a:b].tobytes() == expected[name][a:b].tobytes()
    assert np.isnan(data["x"].values[5:20]).all()
    assert (data["count"].values[5:20] == -1).all()
    assert (data["status"].values[5:20] == 255).all()
    assert data["x"].attrs["units"] == "m"
    assert data["x"].attrs["long_name"] == "where"
    assert data["x"].dims == ("row", "axis")
    assert json.loads(data.attrs["plan"]) == PLAN


def test_going_on_computes_only_what_is_missing(folder):
    fill(folder, [1, 3])
    again = make(folder)
    assert again.missing_chunks == [0, 2, 4]
    fill(folder)
    s = Store.open(folder)
    assert s.is_complete
    assert s.missing_chunks == []
    for name, values in rows(0, ROWS).items():
        np.testing.assert_array_equal(s.dataset()[name].values, values)


@pytest.mark.parametrize("version", [1, 2, 3])
def test_a_run_in_an_earlier_format_is_refused_with_the_way_to_convert_it(folder, version):
    fill(folder, [0, 1])
    file = folder / "run.json"
    write_sealed(file, read_unsealed(file) | {"version": version})
    before = snapshot(folder)
    for ask in (lambda: make(folder), lambda: Store.open(folder)):
        with pytest.raises(StoreError, match=r"holdfast\.studies\.convert_folder converts earlier formats") as error:
            ask()
        assert f"format {version}" in sentence(error)
    assert snapshot(folder) == before


def test_the_plan_is_what_json_makes_of_it(folder):
    make(folder, plan={"pair": (1, 2), "x": 0.1})
    assert Store.open(folder).plan == {"pair": [1, 2], "x": 0.1}
    make(folder, plan={"pair": [1, 2], "x": 0.1})


@pytest.mark.parametrize("count", [1, 5, 6])
def test_sizes_at_the_edges(count, folder):
    s = make(folder, rows=count)
    with s.lock_for_writing():
        for k in s.missing_chunks:
            s.commit_chunk(k, rows(*s.chunks[k]))
    np.testing.assert_array_equal(Store.open(folder).dataset()["count"].values, np.arange(count))


def test_notes_are_kept_and_do_not_define_the_run(folder):
    s = fill(folder)
    s.add_notes(seconds=1.5, versions={"numpy": np.__version__})
    s.add_notes(machine="here")
    assert make(folder).notes == {"seconds": 1.5, "versions": {"numpy": np.__version__}, "machine": "here"}


def test_a_missing_parent_and_an_empty_folder_are_fine(tmp_path):
    make(tmp_path / "a" / "b" / "run")
    (tmp_path / "empty").mkdir()
    make(tmp_path / "empty")


# ---- what a stop leaves behind -------------------------------------------------------------------------------------


def test_a_chunk_written_but_not_committed_is_computed_again(folder):
    s = fill(folder, [0])
    group = zarr.open_group(folder / "samples.zarr", mode="r+")
    group["x"][5:8] = 99.0  # a crash in the middle of chunk 2
    (folder / ".run-left-over").write_text("{")
    assert Store.open(folder).missing_chunks == [1, 2, 3, 4]
    fill(folder)
    np.testing.assert_array_equal(Store.open(folder).dataset()["x"].values, rows(0, ROWS)["x"])
    assert s.path == folder


SLOW = """
import os, sys, time
import numpy as np
from contextlib import suppress
from pathlib import Path
from types import ModuleType
sys.path.insert(0, sys.argv[2])
import test_store as t
s = t.make(Path(sys.argv[1]))
with s.lock_for_writing():
    for k in s.missing_chunks:
        s.commit_chunk(k, t.rows(*s.chunks[k]))
        print(k, flush=True)
        time.sleep(0.02 if len(sys.argv) < 4 else 60)
"""


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
def test_a_killed_writer_leaves_a_folder_that_goes_on(how, folder):
    command = [sys.executable, "-c", SLOW, str(folder), str(Path(__file__).parent)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "0\n"
        assert process.stdout.readline() == "1\n"
        process.send_signal(how)
        process.wait(20)
    left = Store.open(folder)
    assert set(left.committed_chunks) >= {0, 1}
    fill(folder)
    for name, values in rows(0, ROWS).items():
        np.testing.assert_array_equal(Store.open(folder).dataset()[name].values, values)


def test_a_stop_while_the_folder_is_being_made_does_not_make_it_foreign(folder, monkeypatch):
    """Between the arrays and run.json: the same command must be able to begin again."""

    def stop(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(Store, "_write_run_file", stop)
    with pytest.raises(KeyboardInterrupt):
        make(folder)
    monkeypatch.undo()
    fill(folder)
    assert Store.open(folder).is_complete


def test_an_interrupt_during_the_commit_leaves_no_rubbish(folder, monkeypatch):
    fill(folder, [0])
    before = set(snapshot(folder))

    def stop(*_):
        raise KeyboardInterrupt

    s = Store.open(folder)
    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", stop)
        with pytest.raises(KeyboardInterrupt):
            s.add_notes(a=1)
    assert set(snapshot(folder)) == before
    assert Store.open(folder).committed_chunks == [0]


# ---- folders that are not ours -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"plan": {**PLAN, "seed": 4}}, ["its seed is 3, but 4 was requested"]),
        ({"plan": {k: v for k, v in PLAN.items() if k != "seed"}}, ["its seed is 3, but null was requested"]),
        ({"plan": {**PLAN, "more": True}}, ["its more is null, but true was requested"]),
        ({"plan": {**PLAN, "nested": {"a": [1, 3]}}}, ["its nested is"]),
        ({"plan": {**PLAN, "nested": "x" * 500}}, ["...", "its nested is"]),
        ({"rows": 24}, ["23 rows in chunks of 5", "24 in chunks of 5"]),
        ({"chunk": 6}, ["23 in chunks of 6"]),
    ],
)
def test_another_plan_is_refused_with_the_difference(change, words, folder):
    fill(folder, [0])
    before = snapshot(folder)
    with pytest.raises(StoreError) as caught:
        make(folder, **change)
    message = sentence(caught)
    assert all(w in message for w in [str(folder), "holds another run", *words]), message
    assert snapshot(folder) == before


def test_a_program_killed_while_it_wrote_the_first_file_does_not_make_the_folder_foreign(folder):
    folder.mkdir(exist_ok=True)
    (folder / ".holdfast-4711-0badcafe.tmp").write_text('{"format": "hold')
    make(folder)
    assert Store.open(folder).plan == PLAN


def test_a_foreign_folder_is_refused_and_left_alone(folder):
    folder.mkdir()
    (folder / "thesis.tex").write_text("years of work")
    with pytest.raises(StoreError, match="is not empty and is not a holdfast run") as caught:
        make(folder)
    assert str(folder) in sentence(caught)
    assert snapshot(folder) == {"thesis.tex": b"years of work"}
    with pytest.raises(StoreError, match=r"it has no run\.json"):
        Store.open(folder)


DAMAGED = {
    "empty": lambda text: "",
    "cut": lambda text: text[: len(text) // 2],
    "not JSON": lambda text: "seconds: 3",
    "binary": lambda text: b"\xff\xfe\x00\x01",
    "a list": lambda text: "[1, 2]",
    "a number": lambda text: "3",
    "other format": lambda text: text.replace("holdfast-run", "someone-else"),
    "other version": lambda text: seal_document({**{k: v for k, v in json.loads(text).items() if k != "digest"}, "version": 5}),
    "nested too deep": lambda text: "[" * 100_000,
}


@pytest.mark.parametrize("how", DAMAGED)
def test_a_damaged_run_file_is_a_sentence(how, folder):
    fill(folder, [0])
    file = folder / "run.json"
    content = DAMAGED[how](file.read_text())
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    before = snapshot(folder)
    for ask in (lambda: Store.open(folder), lambda: make(folder)):
        with pytest.raises(StoreError) as caught:
            ask()
        message = sentence(caught)
        assert str(folder) in message
        if how == "other version":
            assert "format 5" in message
            assert "reads format 4" in message
    assert snapshot(folder) == before


@pytest.mark.parametrize("key", ["plan", "rows", "chunk", "notes"])
def test_a_run_file_without_a_key_is_damaged(key, folder):
    fill(folder, [0])
    file = folder / "run.json"
    run = read_unsealed(file)
    del run[key]
    write_sealed(file, run)
    for ask in (lambda: Store.open(folder), lambda: make(folder)):
        with pytest.raises(StoreError, match=f"damaged.*{key}|{key}.*damaged"):
            ask()


@pytest.mark.parametrize(
    "change",
    [{"columns": "all"}, {"rows": "many"}, {"rows": -1}, {"chunk": 0}, {"plan": []}, {"notes": None}],
)
def test_a_run_file_with_nonsense_is_damaged(change, folder):
    fill(folder, [0])
    file = folder / "run.json"
    write_sealed(file, {**read_unsealed(file), **change})
    with pytest.raises(StoreError, match="damaged"):
        Store.open(folder)


def remove(path: Path) -> None:
    for p in sorted(path.rglob("*"), reverse=True):
        p.unlink() if p.is_file() else p.rmdir()
    path.rmdir()


LOST = {
    "all arrays": lambda f: remove(f / "samples.zarr"),
    "an array": lambda f: remove(f / "samples.zarr" / "x"),
    "metadata of an array": lambda f: (f / "samples.zarr" / "x" / "zarr.json").unlink(),
    "metadata of the group": lambda f: (f / "samples.zarr" / "zarr.json").unlink(),
    "bad metadata of an array": lambda f: (f / "samples.zarr" / "x" / "zarr.json").write_text("{"),
    "bad metadata of the group": lambda f: (f / "samples.zarr" / "zarr.json").write_text("{"),
}


@pytest.mark.parametrize("what", LOST)
def test_going_on_in_a_folder_with_lost_arrays_is_a_sentence(what, folder):
    fill(folder, [0])
    LOST[what](folder)
    with pytest.raises(StoreError) as caught:
        fill(folder)
    message = sentence(caught)
    assert str(folder) in message
    assert "damaged" in message


@pytest.mark.parametrize("what", [w for w in LOST if not w.startswith(("an array", "metadata of an"))])
def test_reading_lost_arrays_is_a_sentence(what, folder):
    fill(folder)
    LOST[what](folder)
    with pytest.raises(StoreError, match="damaged") as caught:
        Store.open(folder).dataset()
    sentence(caught)


@pytest.mark.parametrize("change", [{"shape": [1]}, {"data_type": "int32", "fill_value": 0}])
def test_an_array_of_another_shape_or_type_is_a_sentence(change, folder):
    fill(folder)
    file = folder / "samples.zarr" / "x" / "zarr.json"
    file.write_text(json.dumps(json.loads(file.read_text()) | change))
    store = Store.open(folder)
    with pytest.raises(StoreError, match="damaged") as caught:
        store.read_chunk(0, ["x"])
    sentence(caught)


def test_a_cut_chunk_is_a_sentence(folder):
    fill(folder)
    chunk = next(p for p in (folder / "samples.zarr" / "x" / "c").rglob("*") if p.is_file())
    chunk.write_bytes(chunk.read_bytes()[:5])
    store = Store.open(folder)
    with pytest.raises(StoreError, match="damaged") as caught:
        [store.read_chunk(k, ["x"]) for k in store.committed_chunks]
    sentence(caught)


def test_xarray_reads_it_without_us(folder):
    fill(folder)
    with xr.open_zarr(folder / "samples.zarr", consolidated=False, chunks=None) as data:
        np.testing.assert_array_equal(data["x"].values, rows(0, ROWS)["x"])


# ---- disks and other programs --------------------------------------------------------------------------------------


def test_unwritable_places(tmp_path):
    file = tmp_path / "file"
    file.write_text("mine")
    for place in (file, file / "below", "/proc/holdfast", "/dev/null/x"):
        with pytest.raises(StoreError) as caught:
            make(place)
        assert str(place) in sentence(caught)
    assert file.read_text() == "mine"
    for place in (file, file / "below", tmp_path / "nowhere"):
        with pytest.raises(StoreError, match="not a holdfast run"):
            Store.open(place)


def full(*_, **__):
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_a_full_disk_while_committing(folder, monkeypatch):
    s = fill(folder, [0])
    files = set(snapshot(folder))
    with monkeypatch.context() as patch, s.lock_for_writing():
        patch.setattr(os, "replace", full)
        with pytest.raises(StoreError, match=r"chunk 2 .*No space left on device.*make room") as caught:
            s.commit_chunk(1, rows(5, 10))
        sentence(caught)
    assert {f for f in snapshot(folder) if "samples" not in f} == {f for f in files if "samples" not in f}
    assert Store.open(folder).committed_chunks == [0]
    fill(folder)
    np.testing.assert_array_equal(Store.open(folder).dataset()["x"].values, rows(0, ROWS)["x"])


def test_a_full_disk_while_writing_rows(folder, monkeypatch):
    s = fill(folder, [0])
    with monkeypatch.context() as patch, s.lock_for_writing():
        patch.setattr(zarr.Array, "__setitem__", full)
        with pytest.raises(StoreError, match=r"chunk 2 .*No space left"):
            s.commit_chunk(1, rows(5, 10))
    assert Store.open(folder).committed_chunks == [0]
    assert fill(folder).is_complete


def test_a_full_disk_while_noting_or_beginning(folder, tmp_path, monkeypatch):
    s = fill(folder)
    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        with pytest.raises(StoreError, match="No space left"):
            s.add_notes(seconds=1)
        with pytest.raises(StoreError, match="No space left"):
            make(tmp_path / "new")
    assert Store.open(folder).is_complete
    make(tmp_path / "new")


def test_two_writers_at_once(folder):
    first, second = make(folder), make(folder)
    with first.lock_for_writing():
        with pytest.raises(StoreError, match=f"another program is writing to '{folder}'"), second.lock_for_writing():
            pass
        first.commit_chunk(0, rows(0, 5))
    with second.lock_for_writing():
        assert second.committed_chunks == [0]  # what the first one did is seen


def test_a_writer_in_another_program_is_noticed_and_its_lock_dies_with_it(folder):
    command = [sys.executable, "-c", SLOW, str(folder), str(Path(__file__).parent), "hold"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "0\n"
        with pytest.raises(StoreError, match=r"another program is writing"):
            fill(folder)
        process.kill()
        process.wait(20)
    assert fill(folder).is_complete


class Msvcrt(ModuleType):
    """The locks of Windows: on a byte of a file, until the handle that locked it is closed."""

    LK_NBLCK = 2

    def __init__(self) -> None:
        super().__init__("msvcrt")
        self.holders: dict[int, tuple[int, int]] = {}

    def locking(self, handle: int, mode: int, count: int) -> None:
        assert (mode, count) == (self.LK_NBLCK, 1)
        state = os.fstat(handle)
        for other, file in self.holders.items():
            now = None
            with suppress(OSError):  # closed: its lock is gone
                now = os.fstat(other)
            if other != handle and now is not None and file == (state.st_dev, state.st_ino) == (now.st_dev, now.st_ino):
                raise PermissionError(errno.EACCES, "Permission denied")
        self.holders[handle] = (state.st_dev, state.st_ino)


def test_two_writers_at_once_on_windows(folder, monkeypatch):
    windows = Msvcrt()
    monkeypatch.setitem(sys.modules, "fcntl", None)
    monkeypatch.setitem(sys.modules, "msvcrt", windows)
    first, second = make(folder), make(folder)
    with first.lock_for_writing():
        assert len(windows.holders) == 1
        with pytest.raises(StoreError, match=f"another program is writing to '{folder}'"), second.lock_for_writing():
            pass
        first.commit_chunk(0, rows(0, 5))
    with second.lock_for_writing():
        assert second.committed_chunks == [0]


def test_an_error_inside_gives_the_lock_back(folder):
    s = make(folder)
    with pytest.raises(ZeroDivisionError), s.lock_for_writing():
        1 / 0  # noqa: B018
    with s.lock_for_writing():
        pass


def test_thousands_of_chunks_stay_cheap(folder):
    s = make(folder, rows=20_000, chunk=1)
    begin = time.perf_counter()
    assert len(s.chunks) == len(s.missing_chunks) == 20_000
    assert time.perf_counter() - begin < 1
