"""The rules that can be counted, each a function from the files of the package to its sins and how many there are of each."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator

from tools.house.imports import File, circles, graph, home

POSITIONAL = 3  # what a public function acts on, and then names
LONGEST = 400  # lines of a file
FULLEST = 15  # files of a folder
# What takes numbers of one kind in an order that everybody knows.
ORDERED = {"holdfast.DH", "holdfast.Region.box", "holdfast.kinematics.paths.arc"}
LOOPED = {"Law", "Objective", "Kernel", "Loop"}  # a loop calls their methods; an Index is an Objective


def in_circles(files: dict[str, File]) -> dict[str, int]:
    """The imports within circles of files: taking one away never makes another."""
    imports = graph(files)
    groups = [set(group) for group in circles(imports)]
    return {f"{name} -> {target}": 1 for group in groups for name in sorted(group) for target in sorted(imports[name] & group)}


def shadowed(files: dict[str, File]) -> dict[str, int]:
    """The modules with the name of something that they define, or that they or their package offer."""
    found = {}
    for module, file in files.items():
        package, _, name = module.rpartition(".")
        around = files[package].offers.get(name, (package, name)) if package in files else (package, name)
        own = file.package and file.offers.get(name, (module, name)) != (module, name)
        if name in file.defines or own or around not in ((package, name), (module, name)):
            found[module] = 1
    return found


def long_files(files: dict[str, File]) -> dict[str, int]:
    """The files of more than 400 lines."""
    return {name: 1 for name, file in files.items() if file.lines > LONGEST}


def full_folders(files: dict[str, File]) -> dict[str, int]:
    """The folders of more than 15 files, and how many these are."""
    folders = Counter(name if file.package else name.rpartition(".")[0] for name, file in files.items())
    return {name: number for name, number in sorted(folders.items()) if number > FULLEST}


def positional(files: dict[str, File]) -> dict[str, int]:
    """The public functions, constructors and methods that take more than three arguments by position, and how many."""
    found, seen = {}, set()
    for public, module, node in published(files):
        if isinstance(node, ast.FunctionDef) and (module, node.name) not in seen:
            found[public] = _positions(node)
        elif isinstance(node, ast.ClassDef) and (module, node.name) not in seen:
            bases = {base.name for _, base in _lineage(files, module, node)}
            found[public] = _constructor(files, module, node)
            for method in node.body:
                if isinstance(method, ast.FunctionDef) and not method.name.startswith("_") and not bases & LOOPED:
                    static = any(ast.unparse(each) == "staticmethod" for each in method.decorator_list)
                    found[f"{public}.{method.name}"] = _positions(method) - (not static)
        seen.add((module, getattr(node, "name", "")))
    return {name: number for name, number in sorted(found.items()) if number > POSITIONAL and name not in ORDERED}


def published(files: dict[str, File]) -> Iterator[tuple[str, str, ast.stmt]]:
    """Each public name with its module and definition: the shortest name of what several packages offer comes first."""
    for package in sorted((name for name, file in files.items() if file.package), key=lambda name: (name.count("."), name)):
        for name in files[package].public:
            module = home(files, package, name)
            if module is not None and name in files[module].defines:
                yield f"{package}.{name}", module, files[module].defines[name]


def _positions(function: ast.FunctionDef) -> int:
    return len(function.args.posonlyargs) + len(function.args.args)


def _lineage(files: dict[str, File], module: str, node: ast.ClassDef) -> list[tuple[str, ast.ClassDef]]:
    """A class and those that it derives from, with their modules, the last first."""
    found = []
    for base in node.bases:
        name = ast.unparse(base).split("[")[0]
        place = module if name in files[module].defines else home(files, *files[module].offers.get(name, ("", None)))
        above = files[place].defines.get(name) if place else None
        if isinstance(above, ast.ClassDef):
            found += _lineage(files, place, above)
    return [*found, (module, node)]


def _constructor(files: dict[str, File], module: str, node: ast.ClassDef) -> int:
    """How many arguments of the constructor may be given by position."""
    fields: list[str] = []
    for _, each in _lineage(files, module, node):
        for line in each.body:
            if isinstance(line, ast.FunctionDef) and line.name == "__init__":
                fields = [argument.arg for argument in [*line.args.posonlyargs, *line.args.args][1:]]
        made = next((ast.unparse(mark) for mark in each.decorator_list if ast.unparse(mark).startswith("dataclass")), "")
        if made and "kw_only=True" not in made:
            for line in each.body:
                if isinstance(line, ast.AnnAssign) and "KW_ONLY" in ast.unparse(line.annotation):
                    break
                if isinstance(line, ast.AnnAssign) and _is_field(line) and ast.unparse(line.target) not in fields:
                    fields.append(ast.unparse(line.target))
    return len(fields)


def _is_field(line: ast.AnnAssign) -> bool:
    value = ast.unparse(line.value) if line.value else ""
    kept_out = "init=False" in value or "kw_only=True" in value
    return not kept_out and not ast.unparse(line.annotation).startswith("ClassVar")
