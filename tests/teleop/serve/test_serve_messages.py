"""Messages: what is well formed is read, all else is refused with a sentence, and the page has the same definitions."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from tools.typescript_messages import format_messages

import holdfast as hf
from holdfast.teleop.serve import messages

GOOD = {
    "hello": {"format": 1, "session": None, "code": "P07", "kind": "person", "fresh": "f" * 24},
    "answers": {"seq": 1, "form": "consent", "answers": {"agree": True, "age": 31, "hand": "left"}},
    "begin": {"seq": 2, "kind": "training", "position": 0},
    "cycles": {"seq": 3, "first": 0, "time": [0, 0.2], "velocity": [[0.0, 0.05], [0, 0]], "q": [[1, 2, 3.5], [1, 2, 3]]},
    "end": {"seq": 4, "end": "broken-off", "q": [1.0, 2.0, 3.0]},
    "rate": {"seq": 5, "rating": 3, "answers": {}},
    "event": {"seq": 6, "kind": "dropped-frames", "data": {"count": 3}},
}
# Nothing of this is right anywhere in a message; text, because some of it is not JSON.
JUNK = [
    "NaN", "-Infinity", "1e999", "[]", "{}", "[[[]]]", "null", '"\\ud800"', '"' + "x" * 5000 + '"', "1" * 400, "tru", "1.5e",
    "[" * 3000 + "]" * 3000, '{"a": {"b": 1}}', "[1, [2]]", '"\x00"', "-1e300", '["1"]', "[null]", "[true]",
]  # fmt: skip


def malformed(rng, count):
    """Messages of which none is right: a value, a key or a piece of the text of a right one is spoilt."""
    kinds = list(GOOD)
    while count > 0:
        kind = kinds[rng.integers(len(kinds))]
        content = {"type": kind, **GOOD[kind]}
        names = list(content)
        name = names[rng.integers(len(names))]
        junk = JUNK[rng.integers(len(JUNK))]
        match rng.integers(6):
            case 0:
                if junk == "null" and kind == "hello":
                    continue
                if junk == "{}" and name in ("answers", "data"):
                    continue
                text = json.dumps(content | {name: "@"}).replace('"@"', junk)
            case 1:
                text = json.dumps(content | {"more": 1})
            case 2:
                if name == "fresh":  # may be left out
                    continue
                del content[name]
                text = json.dumps(content)
            case 3:
                whole = json.dumps(content)
                text = whole[: rng.integers(len(whole))]
            case 4:
                text = rng.bytes(rng.integers(1, 200))
            case _:
                text = json.dumps([content] * int(rng.integers(0, 3)))
        yield text
        count -= 1


@pytest.mark.parametrize("kind", GOOD)
def test_good_messages_are_read(kind):
    message = messages.parse_message(json.dumps({"type": kind, **GOOD[kind]}))
    assert message.model_dump(exclude={"type"}) == GOOD[kind]


def test_malformed_messages_are_refused_with_a_sentence(rng):
    for text in malformed(rng, int(os.environ.get("HOLDFAST_FUZZ", "1000"))):
        with pytest.raises(hf.InputError) as raised:
            messages.parse_message(text)
        said = str(raised.value)
        assert said.startswith("the message is malformed")
        assert len(said) < 500
        said.encode()  # what was sent and is no text does not come back


@pytest.mark.parametrize(
    ("kind", "change"),
    [
        ("cycles", {"time": [0.0]}),
        ("cycles", {"time": [0.0] * 257, "velocity": [[0.0]] * 257, "q": [[0.0]] * 257}),
        ("cycles", {"time": [], "velocity": [], "q": []}),
        ("cycles", {"time": [-1.0, 0.0]}),
        ("cycles", {"velocity": [[True, 0.0], [0.0, 0.0]]}),
        ("cycles", {"q": [[1e10, 0, 0], [0, 0, 0]]}),
        ("end", {"end": "still"}),
        ("end", {"q": [0.0] * 33}),
        ("begin", {"seq": 0}),
        ("begin", {"seq": 1.5}),
        ("begin", {"seq": True}),
        ("begin", {"seq": "1"}),
        ("begin", {"kind": "pilot"}),
        ("answers", {"answers": {f"k{k}": 1 for k in range(101)}}),
        ("answers", {"answers": {"": 1}}),
        ("answers", {"form": "../x"}),
        ("answers", {"form": "a.b"}),
        ("event", {"data": {"a": [1]}}),
        ("hello", {"session": "short"}),
        ("hello", {"code": "Ann Smith"}),
        ("hello", {"code": "x" * 41}),
    ],
)
def test_what_is_out_of_bounds_is_refused(kind, change):
    with pytest.raises(hf.InputError, match="malformed"):
        messages.parse_message(json.dumps({"type": kind, **GOOD[kind], **change}))


def test_the_largest_message_passes_the_size_limit():
    n = np.random.default_rng(0).normal(0, 1, (256, 19)) * -1.2345678901234567e-5
    cycles = {"first": 10**6, "time": n[:, 0] ** 2, "velocity": n[:, :3], "q": n[:, 3:]}
    text = json.dumps(
        {"type": "cycles", "seq": 10**9} | {k: v.tolist() if hasattr(v, "tolist") else v for k, v in cycles.items()},
        separators=(",", ":"),
    )
    assert len(messages.parse_message(text).time) == 256
    assert len(text) < messages.MOST_BYTES


def test_the_page_has_the_same_definitions():
    """``python -m tools.typescript_messages`` writes the file."""
    page = Path(__file__).parents[3] / "page" / "src" / "messages.ts"
    assert page.read_text(encoding="utf-8") == format_messages()
