"""Mutate source lines one at a time and list the mutations that the tests do not detect.

``python -m tools.mutate diagnosis --count 20 --seed 1`` changes 20 random lines of the package ``diagnosis``, one at a time and
in a temporary copy of ``src``, and runs the tests of the package on each. The checkout itself is never changed.
"""

from __future__ import annotations

import argparse
import ast
import compileall
import os
import py_compile
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).parents[1]
# By package: the files to mutate, below src/holdfast, and the tests to run, below tests.
PACKAGES = {
    "assessment": (["studies/assessment/*"], ["studies/assessment"]),
    "collision": (["model/collision/**/*"], ["model/collision"]),
    "diagnosis": (
        [f"response/diagnosis/{name}" for name in ("bounds", "decision", "kinds", "plausibility", "signals")],
        ["response/diagnosis"],
    ),
    "probability": (["core/probability/*"], ["core/probability", "studies/assessment"]),
    "recovery": (["response/recovery/verification"], ["response/recovery"]),
    "verifier": (["certificates/verifier_parts/*"], ["certificates"]),
}
ARITHMETIC: dict[type, Any] = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.BitAnd: ast.BitOr}
COMPARISONS: dict[type, Any] = {
    ast.Lt: (ast.LtE, ast.Gt),
    ast.LtE: (ast.Lt, ast.GtE),
    ast.Gt: (ast.GtE, ast.Lt),
    ast.GtE: (ast.Gt, ast.LtE),
}
NO_TESTS = 5  # exit code of pytest
EXTREMES = {"min": "max", "minimum": "maximum", "argmin": "argmax", "max": "min", "maximum": "minimum", "argmax": "argmin"}


class Mutation(NamedTuple):
    """One changed expression of a file."""

    file: Path
    line: int
    change: str
    text: str  # the whole mutated file


def variants(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the mutated forms of one node of a syntax tree."""
    match node:
        case ast.BinOp(left, op, right) if type(op) in ARITHMETIC:
            yield ast.BinOp(left, ARITHMETIC[type(op)](), right)
            if isinstance(op, ast.Add | ast.Sub):
                yield from (left, right if isinstance(op, ast.Add) else ast.UnaryOp(ast.USub(), right))
        case ast.AugAssign(target, op, value) if type(op) in ARITHMETIC:
            yield ast.AugAssign(target, ARITHMETIC[type(op)](), value)
        case ast.Compare(left, [comparison, *others], rest) if type(comparison) in COMPARISONS:
            yield from (ast.Compare(left, [other(), *others], rest) for other in COMPARISONS[type(comparison)])
        case ast.Constant(int() | float() as value) if value and not isinstance(value, bool):
            yield from (ast.Constant(value * factor) for factor in (10, 100))
            yield from (ast.Constant(value / factor) for factor in (10, 100) if isinstance(value, float))
        case ast.BoolOp(op, values):
            yield ast.BoolOp(ast.Or() if isinstance(op, ast.And) else ast.And(), values)
        case ast.UnaryOp(ast.Not(), operand) | ast.Call(ast.Name("abs") | ast.Attribute(_, "abs"), [operand]):
            yield operand
        case ast.Name(name) if name in EXTREMES:
            yield ast.Name(EXTREMES[name])
        case ast.Attribute(value, name) if name in EXTREMES:
            yield ast.Attribute(value, EXTREMES[name])


def walk_code(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the nodes that compute: no annotations, no formatted texts, no constants in indices."""
    yield node
    for name, value in ast.iter_fields(node):
        if name not in ("annotation", "returns") and not (name == "slice" and isinstance(value, ast.Constant)):
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST) and not isinstance(child, ast.JoinedStr):
                    yield from walk_code(child)


def find_mutations(root: Path, file: Path) -> Iterator[Mutation]:
    """Yield every mutation of a file, which is given relative to ``root``."""
    source = (root / file).read_bytes()
    lines = source.splitlines(keepends=True)
    pairs: list[tuple[Any, ast.AST]] = [(node, variant) for node in walk_code(ast.parse(source)) for variant in variants(node)]
    for node, variant in pairs:
        begin = sum(map(len, lines[: node.lineno - 1])) + node.col_offset
        end = sum(map(len, lines[: node.end_lineno - 1])) + node.end_col_offset
        after = f"({ast.unparse(variant)})" if isinstance(node, ast.expr) else ast.unparse(variant)
        text = (source[:begin] + after.encode() + source[end:]).decode()
        yield Mutation(file, node.lineno, f"{ast.unparse(node)}  ->  {after}", text)


def choose_mutations(root: Path, files: list[Path], count: int, seed: int) -> list[Mutation]:
    """Choose mutations at random, at most one of each line."""
    lines: dict[tuple[Path, int], list[Mutation]] = {}
    for mutation in (mutation for file in sorted(files) for mutation in find_mutations(root, file)):
        lines.setdefault((mutation.file, mutation.line), []).append(mutation)
    draw = random.Random(seed)
    return [draw.choice(lines[line]) for line in draw.sample(sorted(lines), min(count, len(lines)))]


def find_failure(root: Path, source: Path, tests: list[str], time_limit: float) -> str | None:
    """Return the first test that fails with a copy of the sources, or the reason why no test could fail; None if all pass."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(source), str(root)])}
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests]
    process = subprocess.Popen(
        command, cwd=root, env=environment, start_new_session=True, stdout=subprocess.PIPE, text=True, errors="replace"
    )
    try:
        output, _ = process.communicate(timeout=time_limit)
    except subprocess.TimeoutExpired:
        return f"time limit of {time_limit:g} s"
    finally:  # also where the program itself is stopped
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
    failures = re.findall(r"^(?:FAILED|ERROR) (.+?)(?: - |$)", output, re.MULTILINE)
    if process.returncode in (0, NO_TESTS):
        return None
    return failures[0] if failures else f"exit code {process.returncode}"


def try_mutations(
    root: Path, mutations: list[Mutation], tests: list[str], time_limit: float
) -> Iterator[tuple[Mutation, str | None]]:
    """Yield each mutation and the test that detects the mutation, or None; without a mutation the tests must pass.

    The slow tests (``tests/slow.txt``) run on the mutations that the quick ones do not detect.
    """
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "src"
        shutil.copytree(root / "src", source, ignore=shutil.ignore_patterns("__pycache__"))
        # Compiled files are compared by content, because two mutations may have the same size and time.
        compileall.compile_dir(source, quiet=1, invalidation_mode=py_compile.PycInvalidationMode.CHECKED_HASH)

        def try_tests() -> str | None:
            failures = (find_failure(root, source, ["-m", marker, *tests], time_limit) for marker in ("not slow", "slow"))
            return next(filter(None, failures), None)

        if failure := try_tests():
            raise SystemExit(f"the tests fail without a mutation: {failure}")
        for mutation in mutations:
            mutated = Path(folder) / mutation.file
            original = mutated.read_bytes()
            mutated.write_text(mutation.text, encoding="utf-8")
            yield mutation, try_tests()
            mutated.write_bytes(original)


def main() -> None:
    """Mutate one package and print the survivors."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("package", choices=PACKAGES)
    parser.add_argument("--count", type=int, default=20, help="number of mutations")
    parser.add_argument("--seed", type=int, default=0, help="seed of the random choice")
    parser.add_argument(
        "--time-limit", type=float, default=120.0, help="seconds for the quick, and for the slow, tests of one mutation"
    )
    parser.add_argument("--tests", nargs="+", help="test files; the tests of the package by default")
    asked = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("stopped"))  # which removes the temporary copy
    patterns, names = PACKAGES[asked.package]
    files = [file.relative_to(ROOT) for pattern in patterns for file in ROOT.glob(f"src/holdfast/{pattern}.py")]
    tests = asked.tests or [f"tests/{name}" for name in names]
    mutations, survivors = choose_mutations(ROOT, files, asked.count, asked.seed), 0
    for mutation, failure in try_mutations(ROOT, mutations, tests, asked.time_limit):
        survivors += failure is None
        result = f"detected by {failure}" if failure else "SURVIVES"
        print(f"{mutation.file}:{mutation.line}: {mutation.change}  {result}", flush=True)
    print(f"{asked.package}, seed {asked.seed}: {survivors} of {len(mutations)} survived")


if __name__ == "__main__":
    main()
