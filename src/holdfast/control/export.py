"""A control law as a C99 file that needs nothing but ``math.h``, for a robot's own controller."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm import kinematics
from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.control.c_functions import commented
from holdfast.errors import InputError
from holdfast.files.output import put
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled_data
from holdfast.notice import says
from holdfast.provenance import versions
from holdfast.result import Result

Array = NDArray[np.float64]
CASES, TRIES = 5, 1000
WELL_CONDITIONED = 100.0  # then a sine that differs in its last digit does not matter
TOLERANCE = 1e-9  # of the largest rate

_KEYWORDS = """
auto break case char const continue default do double else enum extern float for goto if inline int long register restrict
return short signed sizeof static struct switch typedef union unsigned void volatile while main
"""


class _Law(Protocol):
    """What is written down of a :class:`holdfast.control.Law`."""

    arm: Arm
    task: Task

    @property
    def slug(self) -> str: ...
    def jacobian(self, q: SX) -> SX: ...
    def outputs(self, q: SX, v: SX) -> dict[str, SX]: ...
    def computed_in_c(self) -> str: ...
    def phrase(self) -> str: ...


@dataclass(frozen=True, kw_only=True)
class ExportedLaw(Result):
    """The files of a law, which it may be unpacked into.

    Attributes:
        law: The law.
        source: ``NAME.c``.
        header: ``NAME.h``.
        example: ``NAME_example.c``, a control loop.
        test: ``NAME_test.c``, which returns 0 if the compiled function gives what holdfast computed for five configurations.
    """

    law: _Law
    source: Path
    header: Path
    example: Path
    test: Path

    def __iter__(self) -> Iterator[Path]:
        return iter((self.source, self.header, self.example, self.test))

    def describe(self) -> list[str]:
        """What was written where."""
        source, *others = self
        names = ", ".join(file.name for file in others)
        return [f"{self.law.phrase()}, arm {self.law.arm.title}: wrote {source} and {names}"]

    def to_dict(self) -> dict[str, Any]:
        """The arm, the law, its task and the files."""
        files = zip(("source", "header", "example", "test"), map(str, self), strict=True)
        return {**self.law.arm.entry(), "law": self.law.slug, "task": self.law.task.name, **dict(files)}


def check_name(name: str) -> str:
    """The name, if it can be that of a C function.

    Raises:
        InputError: It cannot be.
    """
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]{0,62}", name) or name in _KEYWORDS.split():
        raise InputError(f"'{name}' cannot name a C function; use letters, digits and underscores, a letter first")
    return name


@recalled_data
def c_files(law: _Law, name: str) -> dict[str, str]:
    """Text of ``NAME.c``, ``NAME.h``, ``NAME_example.c`` and ``NAME_test.c``; see :meth:`holdfast.control.Law.export_c`."""
    check_name(name)
    q, v = kinematics.joint_symbols(law.arm), ca.SX.sym("v", law.task.m)
    told = law.outputs(q, v)
    function = ca.Function(f"{name}_law", [q, v], [ca.densify(x) for x in told.values()], ["q", "v"], list(told), {"cse": True})
    about = _about(law, name, list(told)[1:])
    return {
        f"{name}.c": f'{about}\n#include "{name}.h"\n\n#include <math.h>\n\n{_source(law, name, function)}',
        f"{name}.h": f"{about}\n{_header(law, name, function)}",
        f"{name}_example.c": _example(law, name, function),
        f"{name}_test.c": _test(law, name, function),
    }


def _signature(law: _Law, name: str, function: ca.Function) -> str:
    arguments = [f"const double q[{law.arm.n}]", f"const double v[{law.task.m}]", f"double rates[{law.arm.n}]"]
    return f"int {name}({', '.join(arguments + [f'double *{x}' for x in function.name_out()[1:]])})"


def _source(law: _Law, name: str, function: ca.Function) -> str:
    n, m, others = law.arm.n, law.task.m, function.name_out()[1:]
    copies = "".join(f"    if ({x}) *{x} = fine ? out_{x} : 0;\n" for x in others)
    declared = "".join(f"    double out_{x} = 0;\n" for x in others)
    names = ", ".join(quoted(x) for x in law.arm.joint_names)
    # Zero rates stop an arm; NaN would go on to its drives.
    return f"""{law.computed_in_c()}
const char *const {name}_joints[{n}] = {{{names}}};

int {name}_check_joints(const char *const names[], int count) {{
    int k, i;
    for (k = 0; k < {n}; ++k) {{
        if (k >= count || !names[k]) return k + 1;
        for (i = 0; names[k][i] && names[k][i] == {name}_joints[k][i]; ++i) {{}}
        if (names[k][i] != {name}_joints[k][i]) return k + 1;
    }}
    return count > {n} ? {n + 1} : 0;
}}

{_signature(law, name, function)} {{
{declared}    int fine = 1, k;
    for (k = 0; k < {n}; ++k) fine = fine && q[k] - q[k] == 0;
    for (k = 0; k < {m}; ++k) fine = fine && v[k] - v[k] == 0;
    if (fine) {{
        computed(q, v, rates{"".join(f", &out_{x}" for x in others)});
        for (k = 0; k < {n}; ++k) fine = fine && rates[k] - rates[k] == 0;
    }}
    for (k = 0; k < {n} && !fine; ++k) rates[k] = 0;
{copies}    return fine ? 0 : 1;
}}
"""


def _header(law: _Law, name: str, function: ca.Function) -> str:
    guard = f"{name.upper()}_H"
    return f"""#ifndef {guard}
#define {guard}

#define {name.upper()}_JOINTS {law.arm.n}
#define {name.upper()}_ROWS {law.task.m}
/* What made this file, and of which arm: Arm.fingerprint in Python, "fingerprint" in 'holdfast describe --json'. */
#define {name.upper()}_HOLDFAST "{version()}"
#define {name.upper()}_ARM "{law.arm.fingerprint}"

#ifdef __cplusplus
extern "C" {{
#endif

/* The joints in the order of q and rates. */
extern const char *const {name}_joints[{law.arm.n}];

/* 0 if the joints of a driver are these, in this order; else the place, from 1, of the first that is not. */
int {name}_check_joints(const char *const names[], int count);

{_signature(law, name, function)};

#ifdef __cplusplus
}}
#endif

#endif
"""


def _example(law: _Law, name: str, function: ca.Function) -> str:
    n, m = law.arm.n, law.task.m
    start = law.arm.states.get("home", np.mean(finite_limits(law.arm), axis=0))
    names = ", ".join(quoted(x) for x in law.arm.joint_names)
    nulls = ", 0" * (function.n_out() - 1)
    return f"""/*
 * A control loop around {name}: an arm without dynamics follows the rates for one second.
 * cc -std=c99 {name}.c {name}_example.c -lm -o {name}_example
 */
#include "{name}.h"

#include <stdio.h>

/* The joints as your driver orders them: fill this from the driver, not from {name}_joints. */
static const char *const driver[] = {{{names}}};

int main(void) {{
    double q[{n}] = {{{numbers(start)}}}; /* rad, m; read it from the drives */
    double v[{m}] = {{{numbers([0.01] + [0.0] * (m - 1))}}}; /* {law.task.name}, {law.task.frame} frame, m/s and rad/s */
    double rates[{n}];
    const double cycle = 0.01; /* s */
    int wrong = {name}_check_joints(driver, {n}), k, i;
    if (wrong) {{
        fprintf(stderr, "joint %d of the driver is not the arm's\\n", wrong);
        return 2;
    }}
    for (k = 0; k < 100; ++k) {{
        if ({name}(q, v, rates{nulls})) {{
            fprintf(stderr, "no answer in cycle %d: the arm is still\\n", k);
            return 1;
        }}
        for (i = 0; i < {n}; ++i) q[i] += cycle * rates[i]; /* send the rates to the drives */
    }}
    for (i = 0; i < {n}; ++i) printf("%s %.9f\\n", {name}_joints[i], q[i]);
    return 0;
}}
"""


def _test(law: _Law, name: str, function: ca.Function) -> str:
    n, m = law.arm.n, law.task.m
    cases = _cases(law, function)
    nulls = ", 0" * (function.n_out() - 1)
    rows = ",\n".join(f"    {{{{{numbers(q)}}},\n     {{{numbers(v)}}},\n     {{{numbers(rates)}}}}}" for q, v, rates in cases)
    return f"""/*
 * Does {name} compute here what holdfast {version()} computed where it was written? Returns 0 if so.
 * cc -std=c99 {name}.c {name}_test.c -lm -o {name}_test
 */
#include "{name}.h"

#include <math.h>
#include <stdio.h>

static const struct {{ double q[{n}], v[{m}], rates[{n}]; }} cases[{len(cases)}] = {{
{rows}}};

int main(void) {{
    double rates[{n}], q[{n}], size, off;
    volatile double zero = 0;
    int bad = 0, k, i;
    for (k = 0; k < {len(cases)}; ++k) {{
        int code = {name}(cases[k].q, cases[k].v, rates{nulls});
        for (size = off = 0, i = 0; i < {n}; ++i) {{
            size = fmax(size, fabs(cases[k].rates[i]));
            off = fmax(off, fabs(rates[i] - cases[k].rates[i]));
        }}
        if (code || !(off <= {TOLERANCE:g} * size)) {{
            printf("case %d: returned %d, rates differ by %g of their size\\n", k + 1, code, off / size);
            bad = 1;
        }}
    }}
    for (i = 0; i < {n}; ++i) q[i] = zero / zero;
    if ({name}(q, cases[0].v, rates{nulls}) != 1 || rates[0] != 0) {{
        printf("NaN in q must return 1 and zero rates; was this compiled with -ffast-math?\\n");
        bad = 1;
    }}
    if ({name}_check_joints({name}_joints, {n}) != 0 || {name}_check_joints({name}_joints, {n - 1}) != {n}) {{
        printf("the check of the joints is broken\\n");
        bad = 1;
    }}
    puts(bad ? "failed" : "passed");
    return bad;
}}
"""


def _cases(law: _Law, function: ca.Function) -> list[tuple[Array, Array, Array]]:
    """Configurations away from singular ones, commands, and the rates that holdfast gives them."""
    rng, found = np.random.default_rng(0), []
    jacobian = ca.Function("jacobian", [q := kinematics.joint_symbols(law.arm)], [law.jacobian(q)])
    low, high = finite_limits(law.arm)
    for _ in range(TRIES):
        at, v = rng.uniform(low, high), rng.normal(size=law.task.m)
        rates = np.asarray(function(at, v)[0] if function.n_out() > 1 else function(at, v)).ravel()
        if np.linalg.cond(np.asarray(jacobian(at))) < WELL_CONDITIONED and np.isfinite(rates).all():
            found.append((at, v, rates))
        if len(found) == CASES:
            return found
    if found:
        return found
    raise InputError(
        f"'{law.arm.name}' is close to singular for task '{law.task.name}' everywhere, so its law cannot be tested; choose "
        "another task"
    )


def version() -> str:
    """That of holdfast."""
    return versions("holdfast")["holdfast"]


def numbers(values: ArrayLike) -> str:
    """Numbers as C writes them, with every digit."""
    return ", ".join(repr(float(x) + 0.0) for x in np.asarray(values))


def quoted(text: str) -> str:
    """A C string; bytes that are not plain ASCII in octal."""
    plain = "".join(chr(b) if 32 <= b < 127 and b not in b'"\\?' else f"\\{b:03o}" for b in text.encode(errors="replace"))
    return f'"{plain}"'


@says("writing down the law")
def write(law: _Law, folder: str | Path, name: str) -> ExportedLaw:
    """Write all four files.

    Raises:
        StoreError: They cannot be written.
    """
    source, header, example, test = put(folder, c_files(law, name))
    return ExportedLaw(law=law, source=source, header=header, example=example, test=test)


def _about(law: _Law, name: str, others: list[str]) -> str:
    units = ", ".join(f"{j.name} [{j.unit}]" for j in law.arm.joints)
    lines = [
        f"{name}: {law.phrase()}, for the arm {law.arm.title}.",
        f"Made by holdfast {version()} of the arm {law.arm.fingerprint}; C99, needs only math.h.",
        "",
        f"q      joint positions: {units}",
        f"v      velocity of the task's rows ({law.task.name}, {law.task.frame} frame), m/s and rad/s",
        "rates  joint rates in the order of q, per second",
        *([f"{', '.join(others)}: what else the law computes; each may be NULL"] if others else []),
        "",
        "Returns 0; or 1 and zero rates where an input is not finite or the law has no answer (the arm is exactly singular).",
        "Gain, speed limit and joint limits are not in it. Compile without -ffast-math.",
    ]
    return commented(lines)
