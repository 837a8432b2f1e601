"""What a search remembers: the same bits, cut lines, other searches, refusals."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast.designs.memory import FILE, Memory

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
    first = Memory(tmp_path / "new" / "run", PLAN)
    assert first.part("screen 1", lambda: made) is made
    again = Memory(tmp_path / "new" / "run", PLAN)
    found = again.part("screen 1", lambda: pytest.fail("it is remembered"))
    for name, values in made.items():
        assert found[name].dtype == values.dtype
        assert found[name].shape == values.shape
        assert found[name].tobytes() == values.tobytes() or np.isnan(values).any()
        np.testing.assert_array_equal(found[name], values)


@pytest.mark.parametrize("lost", [1, 7, 40])
def test_a_line_cut_short_is_made_again(tmp_path: Path, rng: np.random.Generator, lost: int) -> None:
    made = parts(rng)
    memory = Memory(tmp_path, PLAN)
    for k in range(3):
        memory.part(f"screen {k}", lambda: made)
    file = tmp_path / FILE
    file.write_bytes(file.read_bytes()[:-lost])
    asked = []
    again = Memory(tmp_path, PLAN)
    for k in range(3):
        again.part(f"screen {k}", lambda k=k: asked.append(k) or made)
    assert asked == [2]
    whole = Memory(tmp_path, PLAN)
    for k in range(3):
        whole.part(f"screen {k}", lambda: pytest.fail("it is remembered"))


def test_refusals(tmp_path: Path) -> None:
    Memory(tmp_path / "run", PLAN)
    with pytest.raises(hf.StoreError, match="holds another search: its seed is 3, asked for is 4; give another folder"):
        Memory(tmp_path / "run", {**PLAN, "seed": 4})
    (tmp_path / "run" / FILE).write_text("{]\n")
    with pytest.raises(hf.StoreError, match="is damaged; remove it and start the search again"):
        Memory(tmp_path / "run", PLAN)
    for part in (
        *('["int64", [1], [1' + "0" * 30 + "]]", '["float64", [1], [1' + "0" * 400 + "]]", '["float32", [1], [1e308]]'),
        *('["a", [1], ["x"]]', '["O", [1], [{}]]', '["S2000000000", [1], ["x"]]', "[" * 100_000 + "]" * 100_000),
    ):
        line = json.dumps({"search": PLAN}) + '\n{"part": "one", "arrays": {"x": ' + part + "}}\n"
        (tmp_path / "run" / FILE).write_text(line)
        with pytest.raises(hf.StoreError, match="is damaged; remove it and start the search again"):
            Memory(tmp_path / "run", PLAN)
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "thesis.txt").write_text("do not touch")
    with pytest.raises(hf.StoreError, match="holds no search of designs; give a new or empty folder"):
        Memory(tmp_path / "other", PLAN)
    with pytest.raises(hf.StoreError, match="cannot write to"):
        Memory(tmp_path / "other" / "thesis.txt" / "run", PLAN)
