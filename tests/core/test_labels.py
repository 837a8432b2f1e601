"""Labels: what is written reads back, and what cannot be written says so."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from holdfast.core import labels
from holdfast.core.errors import InputError

NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
WORDS = st.from_regex(r"[A-Za-z_][A-Za-z0-9_.-]*", fullmatch=True).filter(lambda x: not labels.is_number(x))
VALUES = st.one_of(NUMBERS, WORDS, st.lists(NUMBERS, min_size=2, max_size=7).map(tuple))
NAMES = st.from_regex(r"[a-z]+(-[a-z]+)*", fullmatch=True)
KEYS = st.from_regex(r"[a-z]+(_[a-z]+)*", fullmatch=True).filter(lambda x: not labels.is_number(x))


@given(VALUES)
def test_a_value_reads_back_to_the_bit(value):
    text = labels.write_value(value)
    assert "+" not in text
    assert ":" not in text
    found = labels.parse_value(text)
    assert repr(found) == repr(value)


@given(NAMES, st.dictionaries(KEYS, VALUES, max_size=4))
def test_a_label_reads_back(name, settings):
    read, alone, by_key = labels.split_label(labels.write_label(name, settings))
    assert read == name
    if len(settings) == 1:
        by_key = {next(iter(settings)): alone}
    assert {key: repr(labels.parse_value(text)) for key, text in by_key.items()} == {
        key: repr(value) for key, value in settings.items()
    }


@pytest.mark.parametrize(
    ("label", "parts"),
    [
        ("pseudoinverse", ("pseudoinverse", None, {})),
        ("damped:0.1", ("damped", "0.1", {})),
        (" weighted : 1, 2 ,3 ", ("weighted", "1, 2 ,3", {})),
        ("a:b=1,c=2", ("a", None, {"b": "1", "c": "2"})),
        ("a:b-c=1", ("a", None, {"b_c": "1"})),
        ("a:b=0,0,1,c=word", ("a", None, {"b": "0,0,1", "c": "word"})),
        ("a:", ("a", "", {})),
    ],
)
def test_the_parts_of_a_label(label, parts):
    assert labels.split_label(label) == parts


def test_settings_as_usual_are_left_out_and_a_later_one_has_its_key():
    assert labels.write_label("a", {"b": None, "c": None}) == "a"
    assert labels.write_label("a", {"b": 0.5, "c": None}) == "a:0.5"
    assert labels.write_label("a", {"b": None, "c_d": [0.0, -1e22]}) == "a:c-d=-0,-1e22".replace("-0,", "0,")


@pytest.mark.parametrize(
    ("label", "words"),
    [
        ("damped:1e+3", "a value holds no '+'; write 1e3 for 1e+3"),
        ("a:1,b=2", "'1' has no name; write a:key=value,key=value"),
        ("a:b=1,b=2", "gives b twice; give it once"),
        ("a:b-c=1,b_c=2", "gives b_c twice; give it once"),
    ],
)
def test_what_cannot_be_read(label, words):
    with pytest.raises(InputError) as error:
        labels.split_label(label)
    assert words in str(error.value)


@pytest.mark.parametrize("value", [np.eye(2), np.inf, float("nan"), len, "two words", "1e3", "a+b", [], True])
def test_what_cannot_be_written(value):
    with pytest.raises(InputError, match="cannot be written in a label, which holds numbers, a list of numbers, or a word"):
        labels.write_label("a", {"b": value})
