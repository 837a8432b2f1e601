"""The counters of ``tools/house`` on packages made here, each seen to fail; ``make lint`` counts what there is."""

from __future__ import annotations

import subprocess
import sys
import tomllib

import pytest
from tools.house import inner, picture, prose, ratchet, rules, words
from tools.house.imports import circles, graph, read


@pytest.fixture
def package(tmp_path):
    """``package({"a/b.py": text})``: what is read of a package ``toy`` of these files."""

    def make(texts):
        folder = tmp_path / "toy"
        for name, text in {"__init__.py": "", **texts}.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
            if path.parent != folder:
                (path.parent / "__init__.py").touch()
        return read(folder, "toy")

    return make


@pytest.mark.parametrize(
    "text",
    [
        "from toy.b import y",
        "import toy.b",
        "from toy import b",
        "from . import b",
        "from .b import y",
        "def f():\n    from toy.b import y",
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from toy.b import y",
        "try:\n    import toy.b\nexcept ImportError:\n    pass",
    ],
)
def test_a_circle_is_found_however_it_is_imported(package, text):
    files = package({"a.py": text, "b.py": "from toy.a import x", "c.py": "import toy.a, os"})
    assert circles(graph(files)) == [["toy.a", "toy.b"]]
    assert rules.in_circles(files) == {"toy.a -> toy.b": 1, "toy.b -> toy.a": 1}


@pytest.mark.parametrize(
    "offered",
    [
        {"p/__init__.py": "from toy.p.b import y"},
        {"p/__init__.py": "from .b import y"},
        {"p/__init__.py": "def __getattr__(name): ...", "p/__init__.pyi": "from .b import y as y"},
        {"p/__init__.py": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from toy.p.b import y"},
    ],
)
def test_a_circle_is_found_through_the_package_that_offers_a_name(package, offered):
    files = package({**offered, "a.py": "from toy.p import y", "p/b.py": "import toy.a\ny = 1", "p/c.py": "import toy.a"})
    assert circles(graph(files)) == [["toy.a", "toy.p.b"]]


def test_a_chain_is_no_circle(package):
    files = package({"a.py": "from toy.p.b import y", "p/b.py": "from toy.c import z", "c.py": "import math"})
    assert circles(graph(files)) == []


def test_circles_are_the_classes_of_mutual_reach(rng):
    for _ in range(50):
        n = int(rng.integers(2, 9))
        edge = (rng.random((n, n)) < 0.25) & (rng.random() >= 0.1)
        reach = edge.copy()
        for k in range(n):  # Warshall
            reach |= reach[:, [k]] & reach[[k], :]
        expected = {tuple(str(j) for j in range(n) if j == i or (reach[i, j] and reach[j, i])) for i in range(n)}
        found = circles({str(i): {str(j) for j in range(n) if edge[i, j] and i != j} for i in range(n)})
        assert {tuple(group) for group in found} == {group for group in expected if len(group) > 1}


def test_shadowed_names(package):
    files = package(
        {
            "cut.py": "def cut(): ...",
            "Knife.py": "if True:\n    class Knife: ...",
            "p/__init__.py": "from toy.p.rest import whole, p\nfrom toy.p import part",
            "p/whole.py": "def other(): ...",
            "p/rest.py": "whole: int = 1\np = 2",
            "p/part.py": "from toy.cut import cut as part",
            "q/__init__.py": "",
            "q/__init__.pyi": "from .b import c as c",
            "q/c.py": "",
            "q/b.py": "c = 1",
        }
    )
    assert sorted(rules.shadowed(files)) == ["toy.Knife", "toy.cut", "toy.p", "toy.p.whole", "toy.q.c"]


def test_arguments_by_position(package):
    first = "from toy.a import f, g, Law, Plain, Made, Mine, Kept\n"
    body = """
from dataclasses import dataclass, field, KW_ONLY
def f(a, b, c, d=1, *, e=2): ...
def g(a, b, c, *, d=1): ...
def not_public(a, b, c, d): ...
class Law:
    def __init__(self, a, b, c, d): ...
    def looped(self, a, b, c, d): ...
class Plain:
    def few(self, a, b, c): ...
    def many(self, a, b, c, d): ...
    def _own(self, a, b, c, d): ...
    @classmethod
    def made(cls, a, b, c, d): ...
    @staticmethod
    def still(a, b, c): ...
@dataclass(frozen=True)
class Made:
    a: int
    b: int
    c: int
@dataclass(frozen=True)
class Mine(Made):
    d: int = 1
    e: int = field(default=0, init=False)
    _: KW_ONLY
    f: int = 2
@dataclass(kw_only=True)
class Kept:
    a: int
    b: int
    c: int
    d: int
"""
    names = '__all__ = ["f", "g", "Law", "Plain", "Made", "Mine", "Kept"]'
    files = package({"__init__.py": first + names, "p/__init__.py": "from toy.a import f\n__all__ = ['f']", "a.py": body})
    found = {"toy.Law": 4, "toy.Mine": 4, "toy.Plain.made": 4, "toy.Plain.many": 4, "toy.f": 4}
    assert rules.positional(files) == found
    stub = "".join(f"from toy.a import {name} as {name}\n" for name in ("f", "Law", "Plain", "Mine", "not_public"))
    files = package({"__init__.py": "", "__init__.pyi": stub, "a.py": body})
    assert rules.positional(files) == found | {"toy.not_public": 4}


def test_long_files_and_full_folders(package):
    files = package({f"p/m{k}.py": "x = 1\n" * (385 + k) for k in range(1, 17)} | {"q.py": "x = 1\n"})
    assert rules.long_files(files) == {"toy.p.m16": 1}
    assert rules.full_folders(files) == {"toy.p": 17}


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("Where the hand is, not what is done by hand or handed on.", {"hand": 1}),
        ("From where does the Hand\n    still come to a target?", {"hand": 1}),
        ("A joint that stands; it stands for itself", {"stand": 1}),
        ("Points of rest; the rest of it starts at rest", {"rest": 1}),
        ("A turning joint goes limp. The turning point.", {"turning joint": 1}),
        ("It arrived with joints to spare on its way home", {"to spare": 1, "way home": 1}),
        ("Refuse what is no confidence; there is none", {}),
        ("a stopped search goes on where it was. What goes on?", {"go on": 1}),
        ("The end effector converges to the target at a revolute joint that is locked.", {}),
    ],
)
def test_retired_words(text, found):
    assert words.count(iter([("docs", False, text)])) == {f"{word}, docs": number for word, number in found.items()}


@pytest.mark.parametrize(
    ("text", "pattern"),
    [
        ("It prints what remains.", "'what' as a noun"),
        ("The page says it.", "talking programs"),
        ("Nobody checks.", "nameless agents"),
        ("A table beside the plot.", "literal translations"),
        ("One; two.", "semicolons"),
        ("One: two.", "colons"),
        ("It ends. Of two arms one is better.", "phrases in front"),
        ("Both are looked at again.", "'look at' for 'check'"),
    ],
)
def test_a_pattern_of_foreign_prose_is_counted_in_running_text_only(text, pattern):
    assert prose.measure_prose(text).hits == {**dict.fromkeys(prose.PATTERNS, 0), pattern: 1}
    hidden = f"# {text}\n\n```sh\n{text}\n```\n\n| {text} |\n\n`{text}`\n"
    assert not prose.measure_prose(hidden).hits.total()


def test_excesses_of_foreign_prose_are_what_must_be_rewritten():
    good = "The arm keeps its dexterity because one joint is redundant. " * 30
    assert prose.find_excesses({"good.md": good}) == {}
    bad = good + "Nobody moves; it says so. " * 5
    assert prose.find_excesses({"bad.md": bad}) == {
        "bad.md": 15 - int(15 * 325 / 1000),
        "all pages, talking programs": 5,
        "all pages, nameless agents": 5,
        "all pages, semicolons": 5,
    }
    assert prose.find_excesses({"long.md": ("word " * 41 + "end. ") * 10}) == {
        "all pages, long sentences": 10,
        "all pages, missing connectives": 1,
    }


def test_retired_words_in_names_and_on_experiments():
    names = [("names", False, text) for text in ("hand_at_end", "shared", "share")]
    prose = [("docs", False, "A study."), ("page", True, "This study")]
    assert words.count(iter(names + prose)) == {"hand, names": 1, "share, names": 1, "study, page": 1}


def test_everything_that_is_read_is_looked_at(tmp_path):
    source = tmp_path / "src" / "holdfast"
    for name, text in {
        "src/holdfast/__init__.py": '"""A hand."""\nx = 1\n"""Of x: a hand."""\nraise ValueError(f"no hand {x} hand")',
        "src/holdfast/interface/cli/__init__.py": 'def f():\n    """The hand."""\n    return {"hand": 1}',
        "src/holdfast/teleop/serve/texts/en.yaml": "hint: your hand, this study",
        "README.md": "The hand",
        "docs/guide/a.md": "The hand",
        "docs/_build/a.md": "The hand",
        "docs/examples/a.py": "# The hand",
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    (source / "teleop" / "a.py").write_text('"""Of a study."""')
    expected = {"hand, docstrings": 2, "hand, messages": 2, "hand, cli": 1, "hand, names": 1, "hand, docs": 3}
    found = words.count(words.texts(tmp_path, read(source, "holdfast")))
    assert found == expected | {"study, page": 1, "study, docstrings": 1}


def test_what_is_new_and_what_has_gone():
    count = ratchet.Count({"rule": {"a": 1, "b": 3, "c": 1}}, {"src": 900}, [])
    lists = ratchet.Lists({"rule": {"b": 2, "c": 2, "d": 1}}, {"src": 800}, {"src": 100})
    assert lists.broken(count) == [
        "rule: new: a",
        "rule: new: b, 3 instead of 2",
        "rule: gone, but still listed: c, 1 instead of 2",
        "rule: gone, but still listed: d",
        "lines of src: 900, at most 800",
    ]
    assert ratchet.Lists({"rule": count.sins["rule"]}, {"src": 1401}, {}).broken(count) == [
        "lines of src: 900, and the limit is still 1401"
    ]


def test_tightening_never_adds(tmp_path):
    count = ratchet.Count({"rule": {"a": 1, "b": 3, "c": 1}, "other": {"x": 1}}, {"src": 910}, [])
    lists = ratchet.Lists({"rule": {"b": 2, "c": 2, "d": 1}, "other": {"x": 1, "y": 1}}, {"src": 2000}, {"src": 100})
    tight = lists.tightened(count)
    assert tight == ratchet.Lists({"rule": {"b": 2, "c": 1}, "other": {"x": 1}}, {"src": 1000}, {"src": 100})
    tight.save(tmp_path / "lists.yaml")
    assert ratchet.Lists.load(tmp_path / "lists.yaml") == tight


def test_every_package_that_computes_is_in_the_contract():
    tools = tomllib.loads((ratchet.ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]
    contracts = {contract["id"]: contract for contract in tools["importlinter"]["contracts"]}
    wings = contracts["wings"]["layers"]
    assert set(contracts["drawing"]["source_modules"]) == {f"holdfast.{wing}" for wing in wings} - {
        "holdfast.__main__",
        "holdfast.interface",
    }
    some = {"kernels", "certificates"}  # their contracts order some of their modules
    assert all(contract["exhaustive"] for name, contract in contracts.items() if name not in {"drawing", *some})


def test_the_command_line():
    run = [sys.executable, "-m", "tools.house", "--tightn"]
    done = subprocess.run(run, capture_output=True, text=True, cwd=ratchet.ROOT)
    assert done.returncode == 2
    assert "--tighten" in done.stdout


def test_arrows_that_others_imply_or_that_point_up_are_left_out():
    imports = {"x.a.f": {"x.b.g", "x.c.h"}, "x.b.g": {"x.c.h"}, "x.c.h": {"x.a.f"}, "x": {"x.a.f"}}
    assert picture.arrows(imports, ["a", "b", "c"]) == {("a", "b"), ("b", "c")}


OFFERED = {
    "__init__.py": "",
    "__init__.pyi": "from holdfast import plain as plain\nfrom holdfast.p import thing as thing",
    "plain.py": "x = 1",
    "hidden.py": "x = 1",
    "p/__init__.pyi": "from holdfast.p.part import thing as thing",
    "p/part.py": "thing = other = 1",
    "p/q/__init__.pyi": "from holdfast.p.q.part import far as far",
    "p/q/part.py": "far = 1",
}


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("import holdfast as hf\nhf.thing.part, hf.plain.x, hf.p.thing, hf.p.q.far, hf.__version__", []),
        ("from holdfast import p, plain\np.thing, plain.x", []),
        ("from holdfast.plain import x\nfrom holdfast.p.q import far\nimport holdfast.p.q", []),
        ("import os.path\nfrom other.holdfast import x\nos.path.p", []),
        ("from holdfast.p.part import thing, other", ["holdfast.p.part"]),
        ("from holdfast.p import other", ["holdfast.p.other"]),
        ("from holdfast.p import part as q", ["holdfast.p.part"]),
        ("from holdfast import hidden", ["holdfast.hidden"]),
        ("import holdfast.p.part", ["holdfast.p.part"]),
        ("def f():\n    import holdfast as hf\n    hf.p.part.thing", ["holdfast.p.part"]),
        ("from holdfast import p\np.q.part.far", ["holdfast.p.q.part"]),
        ("from holdfast.plain import _y", ["holdfast.plain._y"]),
        ('run("from holdfast.hidden import x")', ["holdfast.hidden"]),
    ],
)
def test_inner_names(tmp_path, text, found):
    for name, inside in OFFERED.items():
        path = tmp_path / "src/holdfast" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(inside)
        (path.parent / "__init__.py").touch()
    shown = "```yaml\nholdfast: [\n```\n```python\n# src/holdfast/p/new.py\nimport holdfast.hidden\n```\n"
    page = f"```{{run}}\n:about: It.\n{text}\n```\n\n{shown}"
    files = {"papers/a.py": text, "docs/a.md": page, "docs/_build/a.md": page, "benchmarks/side_by_side.py": text}
    for name, content in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(content)
    expected = [f"{where}: {name}" for where in ("docs/a.md", "papers/a.py") for name in found]
    assert list(inner.inner_names(tmp_path, read(tmp_path / "src/holdfast", "holdfast"))) == expected


def test_a_page_goes_on_with_what_it_imported_before(tmp_path):
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs/a.md").write_text("```{run}\nimport holdfast as hf\n```\n```python\nhf.hidden.x\n```\n")
    (tmp_path / "src").mkdir()
    for name in ("__init__.py", "hidden.py"):
        (tmp_path / "src" / name).write_text("x = 1")
    assert list(inner.inner_names(tmp_path, read(tmp_path / "src", "holdfast"))) == ["docs/a.md: holdfast.hidden"]
