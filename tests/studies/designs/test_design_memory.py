"""What a search remembers: the same bits, cut lines, other searches, refusals."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.sweeps.journal import ChecksumLines
from holdfast.core.sweeps.memory import MEMORY_FILE, SearchMemory
from holdfast.studies import convert_folder

PLAN = {"arm": "abc", "seed": 3, "vary": ["a3=0..1m"]}


def parts(rng: np.random.Generator) -> dict[str, np.ndarray]:
    return {
        "value": rng.normal(size=(5, 3)) * 10.0 ** rng.integers(-300, 300, (5, 3)),
        "odd": np.array([np.nan, np.inf, -np.inf, -0.0, 5e-324]),
        "reached": rng.integers(0, 2, 7).astype(bool),
        "none": np.zeros((0, 4)),
    }


def test_parts_come_back_bit_for_bit(tmp_path: Path, rng: np.random.Generator) -> None:
    made = parts(rng)
    first = SearchMemory(tmp_path / "new" / "run", PLAN)
    assert first.recall_or_compute("screen 1", lambda: made) is made
    again = SearchMemory(tmp_path / "new" / "run", PLAN)
    found = again.recall_or_compute("screen 1", lambda: pytest.fail("it is remembered"))
    for name, values in made.items():
        assert found[name].dtype == values.dtype
        assert found[name].shape == values.shape
        assert found[name].tobytes() == values.tobytes() or np.isnan(values).any()
        np.testing.assert_array_equal(found[name], values)


@pytest.mark.parametrize("lost", [1, 7, 40])
def test_a_line_cut_short_is_made_again(tmp_path: Path, rng: np.random.Generator, lost: int) -> None:
    made = parts(rng)
    memory = SearchMemory(tmp_path, PLAN)
    for k in range(3):
        memory.recall_or_compute(f"screen {k}", lambda: made)
    file = tmp_path / MEMORY_FILE
    file.write_bytes(file.read_bytes()[:-lost])
    asked = []
    again = SearchMemory(tmp_path, PLAN)
    for k in range(3):
        again.recall_or_compute(f"screen {k}", lambda k=k: asked.append(k) or made)
    assert asked == [2]
    whole = SearchMemory(tmp_path, PLAN)
    for k in range(3):
        whole.recall_or_compute(f"screen {k}", lambda: pytest.fail("it is remembered"))


def test_a_part_that_is_not_as_it_was_is_made_again(tmp_path: Path, rng: np.random.Generator) -> None:
    made = {"value": rng.uniform(0.1, 0.9, 5)}
    SearchMemory(tmp_path, PLAN).recall_or_compute("one", lambda: made)
    first, second = (tmp_path / MEMORY_FILE).read_bytes().splitlines(keepends=True)
    at = second.index(b"0.") + 3
    (tmp_path / MEMORY_FILE).write_bytes(first + second[:at] + (b"1" if second[at:][:1] != b"1" else b"2") + second[at + 1 :])
    again = SearchMemory(tmp_path, PLAN)
    assert again.recall_or_compute("one", lambda: made) is made
    np.testing.assert_array_equal(
        SearchMemory(tmp_path, PLAN).recall_or_compute("one", lambda: pytest.fail("remembered"))["value"],
        made["value"],
    )


def test_a_search_of_holdfast_0_1_is_converted(tmp_path: Path, rng: np.random.Generator) -> None:
    lines = [{"search": PLAN}, {"part": "one", "arrays": {"x": ["float64", [2], [1.5, -0.25]]}}]
    (tmp_path / "search.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines) + '{"part": "tw')
    with pytest.raises(hf.StoreError, match="is not empty and holds no search"):
        SearchMemory(tmp_path, PLAN)
    assert convert_folder(tmp_path) == tmp_path
    made = parts(rng)
    for _ in range(2):
        memory = SearchMemory(tmp_path, PLAN)
        np.testing.assert_array_equal(memory.recall_or_compute("one", lambda: pytest.fail("remembered"))["x"], [1.5, -0.25])
        found = memory.recall_or_compute("two", lambda: made)
    np.testing.assert_array_equal(found["value"], made["value"])
    assert [file.name for file in tmp_path.iterdir()] == [MEMORY_FILE]


def test_refusals(tmp_path: Path) -> None:
    SearchMemory(tmp_path / "run", PLAN)
    with pytest.raises(hf.StoreError, match="holds another search: its seed is 3, but 4 was requested; give another folder"):
        SearchMemory(tmp_path / "run", {**PLAN, "seed": 4})
    (tmp_path / "run" / MEMORY_FILE).write_text("{]\n")
    with pytest.raises(hf.StoreError, match="is damaged; remove it and start the search again"):
        SearchMemory(tmp_path / "run", PLAN)
    for part in (
        *('["int64", [1], [1' + "0" * 30 + "]]", '["float64", [1], [1' + "0" * 400 + "]]", '["float32", [1], [1e308]]'),
        *('["a", [1], ["x"]]', '["O", [1], [{}]]', '["S2000000000", [1], ["x"]]', "[" * 100_000 + "]" * 100_000),
    ):
        (tmp_path / "run" / MEMORY_FILE).unlink()
        line = '{"part": "one", "arrays": {"x": ' + part + "}}"
        ChecksumLines(tmp_path / "run" / MEMORY_FILE).append(json.dumps({"search": PLAN}).encode(), line.encode())
        with pytest.raises(hf.StoreError, match="is damaged; remove it and start the search again"):
            SearchMemory(tmp_path / "run", PLAN)
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "thesis.txt").write_text("do not touch")
    with pytest.raises(hf.StoreError, match="holds no search; give a new or empty folder"):
        SearchMemory(tmp_path / "other", PLAN)
    with pytest.raises(hf.StoreError, match="cannot write to"):
        SearchMemory(tmp_path / "other" / "thesis.txt" / "run", PLAN)
