"""Export of a control law as a C99 file for a robot's own controller, which needs only ``math.h``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Protocol

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws.c_functions import fill_template, write_c_comment
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
    text_of = partial(fill_template, "holdfast.control.laws", "c", words=_template_values(law, name, function))
    includes = f'#include "{name}.h"\n\n#include <math.h>\n'
    # Without an answer, the law sets the rates to 0: zero rates stop an arm, whereas NaN would reach its drives.
    return {
        f"{name}.c": f"{file_comment}\n{includes}\n{law.computed_in_c()}\n{text_of('law.c')}",
        f"{name}.h": f"{file_comment}\n{text_of('law.h')}",
        f"{name}_example.c": text_of("law_example.c"),
        f"{name}_test.c": text_of("law_test.c"),
    }


def _template_values(law: _Law, name: str, function: ca.Function) -> dict[str, str]:
    """Return the values of the template placeholders."""
    n, m, extra_outputs = law.arm.n, law.task.m, function.name_out()[1:]
    arguments = [f"const double q[{n}]", f"const double v[{m}]", f"double rates[{n}]"]
    test_cases = _sample_cases(law, function)
    return {
        "NAME": name,
        "GUARD": name.upper(),
        "COUNT": str(n),
        "BELOW_COUNT": str(n - 1),
        "ABOVE_COUNT": str(n + 1),
        "TASK_ROWS": str(m),
        "TASK_NAME": law.task.name,
        "TASK_FRAME": law.task.frame,
        "VERSION": holdfast_version(),
        "FINGERPRINT": law.arm.fingerprint,
        "JOINT_NAMES": ", ".join(map(quote_c_string, law.arm.joint_names)),
        "SIGNATURE": f"int {name}({', '.join(arguments + [f'double *{output}' for output in extra_outputs])})",
        "DECLARED_OUTPUTS": "".join(f"    double out_{output} = 0;\n" for output in extra_outputs),
        "COPIED_OUTPUTS": "".join(f"    if ({output}) *{output} = fine ? out_{output} : 0;\n" for output in extra_outputs),
        "ALL_OUTPUTS": ", ".join(["rates", *(f"&out_{output}" for output in extra_outputs)]),
        "RATES_ONLY": ", ".join(["rates", *("0" for _ in extra_outputs)]),
        "START": format_numbers(law.arm.states.get("home", np.mean(sampling_limits(law.arm), axis=0))),
        "TWIST": format_numbers([0.01] + [0.0] * (m - 1)),
        "TOLERANCE": f"{RATE_TOLERANCE:g}",
        "CASE_COUNT": str(len(test_cases)),
        "CASE_ROWS": ",\n".join(
            f"    {{{{{format_numbers(q)}}},\n     {{{format_numbers(v)}}},\n     {{{format_numbers(rates)}}}}}"
            for q, v, rates in test_cases
        ),
    }


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
