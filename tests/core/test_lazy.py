"""Packages that import on demand: every name is what the package says, whatever was imported before."""

from __future__ import annotations

import ast
import inspect
import json
import pkgutil
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import holdfast

ROOT = Path(holdfast.__file__).parent
STUBS = sorted(ROOT.rglob("__init__.pyi"))
PACKAGES = [".".join(("holdfast", *stub.parent.relative_to(ROOT).parts)) for stub in STUBS]
MODULES = {module.name for module in pkgutil.walk_packages(holdfast.__path__, "holdfast.")}
EXPORTED_MODULES = [  # of each package, the names that are modules
    f"{package}.{name}"
    for package, stub in zip(PACKAGES, STUBS, strict=True)
    for home, name in re.findall(r"^from ([\w.]+) import (?:\(\s*)?(\w+) as", stub.read_text(), re.MULTILINE)
    if f"{home}.{name}" in MODULES
]
EXTRAS = (
    "teleop",
    "interface.studio",
    "response.faults.learning.vector",
    "response.faults.learning.wrapper",
    "kernels.frameworks.jax",
    "kernels.frameworks.torch",
)  # need, or may need, what is not installed

CHECK = """
import inspect, json, sys
from importlib import import_module
orders, packages, modules = json.loads(sys.argv[1])
for name in orders:
    import_module(name)
for package in packages:
    made = sys.modules[package] if package in sys.modules else import_module(package)
    for name in made.__all__:
        value = getattr(made, name)
        if inspect.ismodule(value) != (f"{package}.{name}" in modules):
            print(package, name, value)
"""


@pytest.mark.parametrize(("package", "stub"), list(zip(PACKAGES, STUBS, strict=True)), ids=PACKAGES)
def test_what_is_imported_is_what_type_checkers_see(package, stub):
    module = import_module(package)
    body = ast.parse(stub.read_text()).body
    lines = [line for line in body if isinstance(line, ast.ImportFrom)]
    named = [(line.module, a) for line in lines for a in line.names if a.name != "*"]
    assert all(a.asname == a.name for _, a in named)
    expected = {a.name: home for home, a in named}
    expected |= {
        name: line.module for line in lines if line.names[0].name == "*" for name in import_module(line.module).__all__
    }
    assert set(expected) == set(module.__all__)
    assert [ast.unparse(line) for line in body if line not in lines] == (["__version__: str"] if package == "holdfast" else [])
    for name, home in expected.items():
        value = getattr(module, name)
        assert inspect.ismodule(value) == (f"{home}.{name}" in MODULES)
        assert value is (import_module(f"{home}.{name}") if inspect.ismodule(value) else getattr(import_module(home), name))


@pytest.mark.parametrize("run", range(3))
def test_a_function_is_no_module_in_any_order_of_imports(run, rng):
    names = [m.name for m in pkgutil.walk_packages(holdfast.__path__, "holdfast.") if "__main__" not in m.name]
    names = [n for n in names if not n.removeprefix("holdfast.").startswith(EXTRAS)]
    chosen = [str(n) for n in rng.permutation(names)[: len(names) if run == 0 else 12]]
    orders = [chosen, [str(p) for p in rng.permutation([n for n in PACKAGES if n in names])], EXPORTED_MODULES]
    done = subprocess.run([sys.executable, "-c", CHECK, json.dumps(orders)], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("", ""), chosen


def test_what_there_is_not():
    with pytest.raises(AttributeError, match="module 'holdfast' has no attribute 'asess'"):
        _ = holdfast.asess
    with pytest.raises(ImportError, match="cannot import name 'asess' from 'holdfast'"):
        exec("from holdfast import asess")


def test_modules_of_the_package_are_there_without_an_import():
    code = "import holdfast as hf; print(hf.equilibria.orbit.__name__, hf.core.errors.ArmError is hf.ArmError, "
    code += "'assess' in dir(hf))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "orbit True True\n"
