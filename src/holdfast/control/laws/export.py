"""Export of a control law as a C99 file for a robot's own controller, which needs only ``math.h``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws.c_functions import write_c_comment
from holdfast.core.errors import InputError
from holdfast.core.files.output import write_files
from holdfast.core.progress import reports_progress
from holdfast.core.provenance import versions
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_json
from holdfast.kernels.program import SX
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task

TEST_CASES = 5
MAX_TRIES = 1000
MAX_CONDITION_NUMBER = 100.0  # of a test case, so that the last digit of another compiler's sine does not matter
RATE_TOLERANCE = 1e-9  # fraction of the largest rate

_C_KEYWORDS = """
auto break case char const continue default do double else enum extern float for goto if inline int long register restrict
return short signed sizeof static struct switch typedef union unsigned void volatile while main
"""


class _Law(Protocol):
    """The members of a :class:`holdfast.control.laws.Law` that its export uses."""

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
    """Paths of the files of an exported control law; unpacking yields source, header, example, and test.

    Attributes:
        law: The exported control law.
        source: Path of ``NAME.c``, the law.
        header: Path of ``NAME.h``, its header.
        example: Path of ``NAME_example.c``, a control loop.
        test: Path of ``NAME_test.c``, which returns 0 if the compiled function reproduces holdfast's rates for five
            configurations.
    """

    law: _Law
    source: Path
    header: Path
    example: Path
    test: Path

    def __iter__(self) -> Iterator[Path]:
        return iter((self.source, self.header, self.example, self.test))

    def describe(self) -> list[str]:
        """Return the paths of the written files."""
        source, *other_files = self
        names = ", ".join(file.name for file in other_files)
        return [f"{self.law.phrase()}, arm {self.law.arm.title}: wrote {source} and {names}"]

    def to_dict(self) -> dict[str, Any]:
        """Return the arm, the law, its task, and the files."""
        files = zip(("source", "header", "example", "test"), map(str, self), strict=True)
        return {**self.law.arm.entry(), "law": self.law.slug, "task": self.law.task.name, **dict(files)}


def check_name(name: str) -> str:
    """Return the name if it is a valid name of a C function.

    Raises:
        InputError: The name is not valid in C, or is a keyword of C.
    """
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]{0,62}", name) or name in _C_KEYWORDS.split():
        raise InputError(f"'{name}' cannot name a C function; use letters, digits and underscores, a letter first")
    return name


@cached_json
def make_c_files(law: _Law, name: str) -> dict[str, str]:
    """Return the texts of ``NAME.c``, ``NAME.h``, ``NAME_example.c``, and ``NAME_test.c``, by the name of the file.

    :meth:`holdfast.control.laws.Law.export_c` documents their contents.
    """
    check_name(name)
    q, v = kinematics.joint_symbols(law.arm), ca.SX.sym("v", law.task.m)
    outputs = law.outputs(q, v)
    function = ca.Function(
        f"{name}_law",
        [q, v],
        [ca.densify(expression) for expression in outputs.values()],
        ["q", "v"],
        list(outputs),
        {"cse": True},
    )
    file_comment = _describe_c_function(law, name, list(outputs)[1:])
    return {
        f"{name}.c": f'{file_comment}\n#include "{name}.h"\n\n#include <math.h>\n\n{_source_text(law, name, function)}',
        f"{name}.h": f"{file_comment}\n{_header_text(law, name, function)}",
        f"{name}_example.c": _example_text(law, name, function),
        f"{name}_test.c": _test_text(law, name, function),
    }


def _c_signature(law: _Law, name: str, function: ca.Function) -> str:
    arguments = [f"const double q[{law.arm.n}]", f"const double v[{law.task.m}]", f"double rates[{law.arm.n}]"]
    return f"int {name}({', '.join(arguments + [f'double *{output}' for output in function.name_out()[1:]])})"


def _source_text(law: _Law, name: str, function: ca.Function) -> str:
    n, m, extra_outputs = law.arm.n, law.task.m, function.name_out()[1:]
    copies = "".join(f"    if ({output}) *{output} = fine ? out_{output} : 0;\n" for output in extra_outputs)
    declared = "".join(f"    double out_{output} = 0;\n" for output in extra_outputs)
    names = ", ".join(quote_c_string(output) for output in law.arm.joint_names)
    # Zero rates stop an arm, whereas NaN would reach its drives.
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

{_c_signature(law, name, function)} {{
{declared}    int fine = 1, k;
    for (k = 0; k < {n}; ++k) fine = fine && q[k] - q[k] == 0;
    for (k = 0; k < {m}; ++k) fine = fine && v[k] - v[k] == 0;
    if (fine) {{
        computed(q, v, rates{"".join(f", &out_{output}" for output in extra_outputs)});
        for (k = 0; k < {n}; ++k) fine = fine && rates[k] - rates[k] == 0;
    }}
    for (k = 0; k < {n} && !fine; ++k) rates[k] = 0;
{copies}    return fine ? 0 : 1;
}}
"""


def _header_text(law: _Law, name: str, function: ca.Function) -> str:
    guard = f"{name.upper()}_H"
    return f"""#ifndef {guard}
#define {guard}

#define {name.upper()}_JOINTS {law.arm.n}
#define {name.upper()}_ROWS {law.task.m}
/* Version of holdfast, and fingerprint of the arm ("fingerprint" in 'holdfast describe --json', Arm.fingerprint in Python). */
#define {name.upper()}_HOLDFAST "{holdfast_version()}"
#define {name.upper()}_ARM "{law.arm.fingerprint}"

#ifdef __cplusplus
extern "C" {{
#endif

/* The joints in the order of q and rates. */
extern const char *const {name}_joints[{law.arm.n}];

/* Returns 0 if a driver has these joints in this order, else the position (from 1) of the first joint that differs. */
int {name}_check_joints(const char *const names[], int count);

{_c_signature(law, name, function)};

#ifdef __cplusplus
}}
#endif

#endif
"""


def _example_text(law: _Law, name: str, function: ca.Function) -> str:
    n, m = law.arm.n, law.task.m
    start = law.arm.states.get("home", np.mean(sampling_limits(law.arm), axis=0))
    names = ", ".join(quote_c_string(joint_name) for joint_name in law.arm.joint_names)
    null_arguments = ", 0" * (function.n_out() - 1)
    return f"""/*
 * Control loop around {name}, in which an arm without dynamics follows the rates for one second.
 * cc -std=c99 {name}.c {name}_example.c -lm -o {name}_example
 */
#include "{name}.h"

#include <stdio.h>

/* Joint names in the order of your driver. Take them from the driver, not from {name}_joints. */
static const char *const driver[] = {{{names}}};

int main(void) {{
    double q[{n}] = {{{format_numbers(start)}}}; /* rad, m; read it from the drives */
    double v[{m}] = {{{format_numbers([0.01] + [0.0] * (m - 1))}}}; /* {law.task.name}, {law.task.frame} frame, m/s and rad/s */
    double rates[{n}];
    const double cycle = 0.01; /* s */
    int wrong = {name}_check_joints(driver, {n}), k, i;
    if (wrong) {{
        fprintf(stderr, "joint %d of the driver is not the arm's\\n", wrong);
        return 2;
    }}
    for (k = 0; k < 100; ++k) {{
        if ({name}(q, v, rates{null_arguments})) {{
            fprintf(stderr, "the law has no answer in cycle %d; the rates are 0\\n", k);
            return 1;
        }}
        for (i = 0; i < {n}; ++i) q[i] += cycle * rates[i]; /* send the rates to the drives */
    }}
    for (i = 0; i < {n}; ++i) printf("%s %.9f\\n", {name}_joints[i], q[i]);
    return 0;
}}
"""


def _test_text(law: _Law, name: str, function: ca.Function) -> str:
    n, m = law.arm.n, law.task.m
    test_cases = _sample_cases(law, function)
    null_arguments = ", 0" * (function.n_out() - 1)
    rows = ",\n".join(
        f"    {{{{{format_numbers(q)}}},\n     {{{format_numbers(v)}}},\n     {{{format_numbers(rates)}}}}}"
        for q, v, rates in test_cases
    )
    return f"""/*
 * Test of {name}: returns 0 if it computes the same rates here as holdfast {holdfast_version()} did when it wrote this file.
 * cc -std=c99 {name}.c {name}_test.c -lm -o {name}_test
 */
#include "{name}.h"

#include <math.h>
#include <stdio.h>

static const struct {{ double q[{n}], v[{m}], rates[{n}]; }} cases[{len(test_cases)}] = {{
{rows}}};

int main(void) {{
    double rates[{n}], q[{n}], size, off;
    volatile double zero = 0;
    int bad = 0, k, i;
    for (k = 0; k < {len(test_cases)}; ++k) {{
        int code = {name}(cases[k].q, cases[k].v, rates{null_arguments});
        for (size = off = 0, i = 0; i < {n}; ++i) {{
            size = fmax(size, fabs(cases[k].rates[i]));
            off = fmax(off, fabs(rates[i] - cases[k].rates[i]));
        }}
        if (code || !(off <= {RATE_TOLERANCE:g} * size)) {{
            printf("case %d: returned %d, the relative error of the rates is %g\\n", k + 1, code, off / size);
            bad = 1;
        }}
    }}
    for (i = 0; i < {n}; ++i) q[i] = zero / zero;
    if ({name}(q, cases[0].v, rates{null_arguments}) != 1 || rates[0] != 0) {{
        printf("NaN in q does not return 1 and zero rates; do not compile with -ffast-math\\n");
        bad = 1;
    }}
    if ({name}_check_joints({name}_joints, {n}) != 0 || {name}_check_joints({name}_joints, {n - 1}) != {n}) {{
        printf("{name}_check_joints accepts wrong joints or rejects the right ones\\n");
        bad = 1;
    }}
    puts(bad ? "failed" : "passed");
    return bad;
}}
"""


def _sample_cases(law: _Law, function: ca.Function) -> list[tuple[FloatArray, FloatArray, FloatArray]]:
    """Return sampled configurations away from singularities, sampled commands, and the rates that holdfast computes."""
    generator, test_cases = np.random.default_rng(0), []
    jacobian = ca.Function("jacobian", [q := kinematics.joint_symbols(law.arm)], [law.jacobian(q)])
    lower, upper = sampling_limits(law.arm)
    for _ in range(MAX_TRIES):
        configuration, v = generator.uniform(lower, upper), generator.normal(size=law.task.m)
        rates = np.asarray(function(configuration, v)[0] if function.n_out() > 1 else function(configuration, v)).ravel()
        if np.linalg.cond(np.asarray(jacobian(configuration))) < MAX_CONDITION_NUMBER and np.isfinite(rates).all():
            test_cases.append((configuration, v, rates))
        if len(test_cases) == TEST_CASES:
            return test_cases
    if test_cases:
        return test_cases
    raise InputError(
        f"'{law.arm.name}' is close to singular for task '{law.task.name}' everywhere, so its law cannot be tested; choose "
        "another task"
    )


def holdfast_version() -> str:
    """Return the version of holdfast."""
    return versions("holdfast")["holdfast"]


def format_numbers(values: ArrayLike) -> str:
    """Return numbers in C notation with all their digits."""
    return ", ".join(repr(float(value) + 0.0) for value in np.asarray(values))


def quote_c_string(text: str) -> str:
    """Return a C string literal, with octal escapes for bytes that are not plain ASCII."""
    escaped = "".join(
        chr(byte) if 32 <= byte < 127 and byte not in b'"\\?' else f"\\{byte:03o}" for byte in text.encode(errors="replace")
    )
    return f'"{escaped}"'


@reports_progress("writing down the law")
def write_law_files(law: _Law, folder: str | Path, name: str) -> ExportedLaw:
    """Write the four files of a law and return their paths.

    Raises:
        StoreError: The files cannot be written.
    """
    source, header, example, test = write_files(folder, make_c_files(law, name))
    return ExportedLaw(law=law, source=source, header=header, example=example, test=test)


def _describe_c_function(law: _Law, name: str, extra_outputs: list[str]) -> str:
    units = ", ".join(f"{joint.name} [{joint.unit}]" for joint in law.arm.joints)
    lines = [
        f"{name}: {law.phrase()}, for the arm {law.arm.title}.",
        f"Made by holdfast {holdfast_version()} for the arm {law.arm.fingerprint}; C99, needs only math.h.",
        "",
        f"q      joint positions: {units}",
        f"v      velocity of the task's rows ({law.task.name}, {law.task.frame} frame), m/s and rad/s",
        "rates  joint rates in the order of q, per second",
        *([f"{', '.join(extra_outputs)}: further outputs of the law; each may be NULL"] if extra_outputs else []),
        "",
        "Returns 0; or 1 and zero rates if an input is not finite or the law has no answer (the arm is exactly singular).",
        "The function applies no gain, speed limit, or joint limits. Compile without -ffast-math.",
    ]
    return write_c_comment(lines)
