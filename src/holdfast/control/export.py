"""A control law as a C99 file that needs nothing but ``math.h``, for a robot's own controller."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import casadi as ca

from holdfast.arm import kinematics
from holdfast.errors import InputError, StoreError
from holdfast.whole_file import replaced

if TYPE_CHECKING:
    from holdfast.control.law import Law

_KEYWORDS = """
auto break case char const continue default do double else enum extern float for goto if inline int long register restrict
return short signed sizeof static struct switch typedef union unsigned void volatile while main
"""


def check_name(name: str) -> str:
    """The name of a C function.

    Raises:
        InputError: It is none.
    """
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]{0,62}", name) or name in _KEYWORDS.split():
        raise InputError(f"'{name}' cannot name a C function; use letters, digits and underscores, a letter first")
    return name


def c_source(law: Law, name: str) -> tuple[str, str]:
    """Text of ``NAME.c`` and ``NAME.h``; see :meth:`holdfast.control.Law.export_c`."""
    check_name(name)
    n, m = law.arm.n, law.task.m
    q, v = kinematics.joint_symbols(law.arm), ca.SX.sym("v", m)
    told = law.outputs(q, v)
    results = [ca.densify(x) for x in told.values()]
    inner = ca.Function(f"{name}_law", [q, v], results, ["q", "v"], list(told), {"cse": True})
    generator = ca.CodeGenerator(f"{name}.c", {"with_export": False, "casadi_int": "int"})
    generator.add(inner)
    others = list(told)[1:]
    arguments = ", ".join(
        [f"const double q[{n}]", f"const double v[{m}]", f"double rates[{n}]"] + [f"double *{x}" for x in others]
    )
    signature = f"int {name}({arguments})"
    guard = f"{name.upper()}_H"
    header = f"{_about(law, name, others)}\n#ifndef {guard}\n#define {guard}\n\n{signature};\n\n#endif\n"
    copies = "".join(f"    if ({x}) *{x} = fine ? out_{x} : 0;\n" for x in others)
    # Zero rates stop an arm; NaN would go on to its drives.
    body = f"""
{signature} {{
    const double *arg[{max(inner.sz_arg(), 2)}] = {{q, v}};
    double *res[{max(inner.sz_res(), len(told))}] = {{rates{"".join(f", &out_{x}" for x in others)}}};
    int fine = 1, k;
    for (k = 0; k < {n}; ++k) fine = fine && q[k] - q[k] == 0;
    for (k = 0; k < {m}; ++k) fine = fine && v[k] - v[k] == 0;
    if (fine) {{
        {inner.name()}(arg, res, iw, w, 0);
        for (k = 0; k < {n}; ++k) fine = fine && rates[k] - rates[k] == 0;
    }}
    for (k = 0; k < {n} && !fine; ++k) rates[k] = 0;
{copies}    return fine ? 0 : 1;
}}
"""
    declared = f"    int iw[{max(inner.sz_iw(), 1)}];\n    double w[{max(inner.sz_w(), 1)}];\n"
    declared += "".join(f"    double out_{x} = 0;\n" for x in others)
    body = body.replace("{\n", "{\n" + declared, 1)
    return f'{_about(law, name, others)}\n#include "{name}.h"\n\n{generator.dump()}{body}', header


def write(law: Law, folder: str | Path, name: str) -> tuple[Path, Path]:
    """Write both files.

    Raises:
        StoreError: They cannot be written.
    """
    source, header = c_source(law, name)
    target = Path(folder)
    files = target / f"{name}.c", target / f"{name}.h"
    try:
        target.mkdir(parents=True, exist_ok=True)
        for file, text in zip(files, (source, header), strict=True):
            replaced(file, text)
    except OSError as error:
        raise StoreError(
            f"cannot write '{name}.c' into '{target}': {error.strerror or error}; choose another folder"
        ) from error
    return files


def _about(law: Law, name: str, others: list[str]) -> str:
    units = ", ".join(f"{j.name} [{j.unit}]" for j in law.arm.joints)
    lines = [
        f"{name}: {law.phrase()}, for the arm '{law.arm.name}'. Made by holdfast; C99, needs only math.h.",
        "",
        f"q      joint positions: {units}",
        f"v      velocity of the task's rows ({law.task.name}, {law.task.frame} frame), m/s and rad/s",
        "rates  joint rates in the order of q, per second",
        *([f"{', '.join(others)}: what else the law computes; each may be NULL"] if others else []),
        "",
        "Returns 0; or 1 and zero rates where an input is not finite or the law has no answer (the arm is exactly singular).",
        "Gain, speed limit and joint limits are not in it. Compile without -ffast-math.",
    ]
    safe = [x.replace("*/", "* /").encode("ascii", "replace").decode().replace("\n", " ") for x in lines]
    return "/*\n" + "\n".join(f" * {x}".rstrip() for x in safe) + "\n */"
