"""``tools/mutate.py`` on a toy module with one test, and the mutations of single expressions."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from tools.mutate import choose_mutations, find_mutations, try_mutations, variants

TOY = """
def largest_step(steps):
    if not steps:
        return 3 + 4
    return max(steps)
"""
TEST = "import toy\n\ndef test_largest_step():\n    assert toy.largest_step([1, 5, 2]) == 5\n"


@pytest.fixture
def toy(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")  # each run of the tests starts in a third of the time
    (tmp_path / "src").mkdir()
    (tmp_path / "src/toy.py").write_text(TOY)
    (tmp_path / "test_toy.py").write_text(TEST)
    return tmp_path


def test_a_mutation_in_a_dead_branch_survives_and_others_do_not(toy):
    mutations = choose_mutations(toy, [Path("src/toy.py")], 10, seed=3)
    failures = dict(try_mutations(toy, mutations, ["test_toy.py"], 60.0))
    name = "test_toy.py::test_largest_step"
    assert {mutation.line: failure for mutation, failure in failures.items()} == {3: name, 4: None, 5: name}
    assert (toy / "src/toy.py").read_text() == TOY


def test_tests_that_fail_without_a_mutation_are_refused(toy):
    (toy / "test_toy.py").write_text(TEST.replace("== 5", "== 6"))
    with pytest.raises(SystemExit, match="without a mutation"):
        list(try_mutations(toy, [], ["test_toy.py"], 60.0))


def test_every_mutated_file_can_be_parsed_and_differs():
    root = Path(__file__).parents[2]
    for mutation in find_mutations(root, Path("src/holdfast/response/diagnosis/decision.py")):
        assert ast.dump(ast.parse(mutation.text)) != ast.dump(ast.parse((root / mutation.file).read_bytes())), mutation


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("a + b", {"a - b", "a", "b"}),
        ("a - b", {"a + b", "a", "-b"}),
        ("a * b", {"a / b"}),
        ("a < b", {"a <= b", "a > b"}),
        ("2", {"20", "200"}),
        ("0.5", {"5.0", "50.0", "0.05", "0.005"}),
        ("a and b", {"a or b"}),
        ("not a", {"a"}),
        ("abs(a)", {"a"}),
        ("a < b < c", {"a <= b < c", "a > b < c"}),
        ("0", set()),
        ("True", set()),
    ],
)
def test_variants_of_an_expression(before, after):
    assert {ast.unparse(node) for node in variants(ast.parse(before, mode="eval").body)} == after


def test_extremes_are_exchanged(tmp_path):
    (tmp_path / "one.py").write_text("x = np.minimum(a, min(b))")
    texts = {mutation.text for mutation in find_mutations(tmp_path, Path("one.py"))}
    assert texts == {"x = (np.maximum)(a, min(b))", "x = np.minimum(a, (max)(b))"}
