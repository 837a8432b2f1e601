"""YAML that people write: everything that PyYAML trips over is one sentence, and nothing blows up."""

from __future__ import annotations

import pytest
import yaml

from holdfast import InputError
from holdfast.core.files.yaml import parse_yaml

TRIPS = {
    "a day that is none": "a: 2026-02-30",
    "an hour that is none": "a: 2026-02-03T25:61:61Z",
    "no whole number": "a: !!int x",
    "no digits": "a: !!int ''",
    "no number": "a: !!float x",
    "no flag": "a: !!bool x",
    "no time": "a: !!timestamp x",
    "no list of pairs": "a: !!pairs [x]",
    "too many digits": f"a: {'9' * 5000}",
    "too many hexadecimal digits": f"a: 0x{'f' * 5000}",
    "too many digits in base 60": "a: " + ":".join(["59"] * 3000),
    "beyond 2^63": f"a: {2**63 + 1}",
    "below -2^63": f"a: {-(2**63) - 1}",
    "half of a surrogate pair": 'a: "\\ud800"',
    "a key that is a list": "? [1, 2]\n: 3",
    "a key that is a block": "? {a: 1}\n: 3",
    "an alias of nothing": "a: *b",
    "merged with a number": "<<: 1",
    "an object": "a: !!python/object/apply:os.system [ls]",
    "a sign that no text has": "a: \x01",
    "two documents": "a: 1\n---\nb: 2",
}


@pytest.mark.parametrize("case", TRIPS)
def test_what_trips_the_parser_is_a_sentence(case):
    with pytest.raises(InputError) as caught:
        parse_yaml(TRIPS[case], "; see the manual")
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 500


@pytest.mark.parametrize(
    "text",
    [
        f"a: [{2**63}, {-(2**63)}, 0xff, 1_000, 1:30]\n",
        "a: [1, {b: c}, 2.5]\n",
        "a: 1\nb: &x {c: 2}\nd: *x\ne: {<<: *x, f: 3}\n",
        "",
        "- 1\n- no\n",
        "word",
    ],
)
def test_sound_yaml_is_as_pyyaml_reads_it(text):
    assert parse_yaml(text) == yaml.safe_load(text)


@pytest.mark.parametrize(
    ("text", "line"),
    [("a: 1\nb: 2\na: 3", 3), ("x:\n- {a: 1, a: 3}", 2), ("x: {a: 1}\n'x': 2", 2), ("<<: {}\n<<: {}", 2)],
)
def test_a_key_given_twice(text, line):
    with pytest.raises(InputError, match=f"line {line}: the key '.*' is given twice"):
        parse_yaml(text)


@pytest.mark.parametrize("opening", ["[", "{a: ", "- ", "? ", "{a: ["])
@pytest.mark.parametrize("depth", [60, 1000, 100_000])
def test_deep_blocks(opening, depth):
    closing = {"[": "]", "{a: ": "}", "{a: [": "]}"}.get(opening, "")
    with pytest.raises(InputError):
        parse_yaml(opening * depth + "1" + closing * depth)


def test_aliases_do_not_blow_up():
    doubled = "\n".join(f"a{k}: &a{k} [*a{k - 1}, *a{k - 1}]" for k in range(1, 40))
    merged = "\n".join(f"a{k}: &a{k} {{<<: [*a{k - 1}, *a{k - 1}], b{k}: 1}}" for k in range(1, 40))
    for text in (f"a0: &a0 [1, 2]\n{doubled}", f"a0: &a0 {{x: 1}}\n{merged}", "a: &a [*a]", "a: &a {b: *a}"):
        with pytest.raises(InputError, match=r"use fewer aliases|levels deep"):
            parse_yaml(text)


def test_many_keys_are_read_in_a_moment():
    """The check for keys given twice took the square of their number: three minutes for 30,000."""
    found = parse_yaml("".join(f"k{k}: 1\n" for k in range(10_000)))
    assert len(found) == 10_000
