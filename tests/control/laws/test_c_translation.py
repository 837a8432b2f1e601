"""C with loops in JavaScript, run by Node, against a C compiler and against the compiled laws."""

from __future__ import annotations

import ctypes
import shutil
import subprocess

import casadi as ca
import numpy as np
import pytest

import holdfast as hf
import javascript as browser
from holdfast.control.laws.c_translation import translate_c_to_javascript
from holdfast.core.errors import KernelError
from holdfast.model.arm import kinematics

LARGEST_TEXT_BYTES = 12_000

FORMS = """
/* Every form
 * of the translation. */
enum { SIZE = 3, WIDE = SIZE + 1 };
static const unsigned char order[SIZE][2] = {{0, 1}, {2, 1}, {2, 0}};

typedef struct {
    double total, values[SIZE], table[SIZE][WIDE];
} store;

typedef struct {
    double x, y;
} pair;

static double larger(double a, double b) {
    return a > b ? a : b;
}

static pair shifted(pair a, double by, int times) {
    pair out;
    out.x = a.x - (-by) * times;
    out.y = -a.y;
    return out;
}

static pair origin(double y) {
    pair a;
    a.x = 0;
    a.y = y;
    return a;
}

static void add(store *restrict s, const double *input, double *one) {
    int k, i;
    for (k = 0; k < SIZE; ++k) {
        if (input[k] < -1) continue;
        s->values[k] += input[k] * input[k];
        for (i = 0; i < WIDE; ++i)
            s->table[k][i] -= i == 0 || input[k] != input[k] ? input[k] / 3.0 : larger(s->values[k], input[0]);
    }
    for (s->total = k = 0; k < SIZE && s->total <= 1e1; ++k)
        s->total += s->values[order[k][0]] = sqrt(fabs(s->values[order[k][1]])) + copysign(0.5, input[k]);
    *one = s->total - s->table[0][1] - (*one);
    *one *= 2;
}

static void call(const double *input, double *out) {
    store s = {0, {0}, {{0}}};
    double copy[SIZE], zeros[WIDE] = {0}, first = input[0], power = 1, low = -HUGE_VAL;
    pair pairs[2], best;
    int k, any = 0;
    for (int i = 0; i < SIZE; ++i) copy[i] = input[i];
    add(&s, copy, out);
    while (power < 9) power *= 2;
    best = shifted(origin(first), power, 2);
    pairs[0] = best;
    pairs[1] = shifted(best, first, 1);
    for (k = 0; k < 2; ++k) {
        const pair a = pairs[k];
        any |= a.y > 1;
        low = larger(low, a.y + zeros[k]);
        zeros[k + 1] -= a.x;
    }
    out[1] = any;
    out[2] = low;
    out[3] = zeros[2];
    if (best.x > 1)
        out[4] = s.table[2][3];
    else
        out[4] = s.values[1] * power;
}
"""


def run_in_c(folder, text, inputs, width):
    """What ``call`` makes of rows, by a C compiler that neither fuses nor reorders."""
    source, library = folder / "forms.c", folder / "forms.so"
    source.write_text(f"#include <math.h>\n{text}\nvoid run(const double *in, double *out) {{ call(in, out); }}\n")
    subprocess.run(
        ["cc", "-std=c99", "-O1", "-ffp-contract=off", "-shared", "-fPIC", str(source), "-o", str(library), "-lm"], check=True
    )
    function, out = ctypes.CDLL(str(library)).run, np.zeros((len(inputs), width))
    for x, y in zip(inputs, out, strict=True):
        function(*[part.ctypes.data_as(ctypes.c_void_p) for part in (x, y)])
    return out


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler (cc) on this machine")
def test_every_form_has_the_bits_of_compiled_c(rng, tmp_path):
    """Also in the second row and later ones, when the arrays that are kept are no longer new."""
    inputs = rng.normal(size=(200, 3)) * rng.choice([0.5, 3], (200, 1))
    inputs[::17, 1] = -0.0
    text = translate_c_to_javascript(FORMS)
    helper = "const copySign=(a,b)=>b<0||1/b<0?-Math.abs(a):Math.abs(a);"
    cleared = "const cleared=(x,y)=>{y.fill(0);call(x,y);};"
    found = browser.rows(f"{helper}\n{text}{cleared}", "cleared", inputs, 5)
    expected = run_in_c(tmp_path, FORMS, inputs, 5)
    assert len(np.unique(found[:, 1])) == 2
    np.testing.assert_array_equal(found.view(np.int64), expected.view(np.int64))


def in_function(statement, before=""):
    start = "static void f(const double *a, double b, int n) {\n    double x = 0, y[2];\n    int k = 0;\n"
    return f"{before}{start}    {statement}\n}}\n"


PAIR = "typedef struct {\n    double s, t;\n} pair;\n"


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("#define N 3\n", "#define N 3"),
        ("double x;\n", "double x;"),
        ("static int f(int k) {\n    switch (k) { case 1: return 2; }\n    return 0;\n}\n", "switch"),
        ("static float f(float k) {\n    return k;\n}\n", "float k"),
        ("static double f(double k[3]) {\n    return k[0];\n}\n", "double k[3]"),
        (PAIR + "static double f(pair p) {\n    p.s = 1;\n    return p.s;\n}\n", "p.member = "),
        (PAIR + "static pair f(double k) {\n    pair p, q;\n    q = p;\n    p.s = k;\n    return q;\n}\n", "p.member = "),
        (PAIR + "static void f(double k) {\n    pair p[2];\n    p[1].s = k;\n}\n", "].s="),
        ("typedef struct {\n    int s;\n} pair;\n", "typedef struct{int s;}"),
        ("typedef struct {\n    double s[2];\n} big;\nstatic void f(big b) {\n}\n", "big b"),
        (in_function("x = sin(b);"), "sin"),
        (in_function("x = (double)n;"), "double"),
        (in_function("x = 1 / n;"), "1/n"),
        (in_function("x = n / 2;"), "n/2"),
        (in_function("x = n / b;"), "n/"),
        (in_function("k = n % 2;"), "%"),
        (in_function("k = n << 2;"), "<<"),
        (in_function("k = n & 1;"), "&"),
        (in_function("k = !n;"), "!"),
        (in_function("k = ~n;"), "~"),
        (in_function("--k;"), "--"),
        (in_function("x = b - - b;"), "- -"),
        (in_function("x = *(a + 1);"), "*"),
        (in_function("f(a + 1, x, 1);"), "a"),
        (in_function("a = y;"), "a"),
        (in_function("double in = 0;"), "in"),
        (in_function("goto end;"), "goto"),
        (in_function("x = sizeof x;"), "sizeof"),
        (in_function("double z[2] = {1, 2};"), "double z[2]={1,2};"),
        (in_function("static int calls = 0;"), "static"),
        (in_function("f(&x, x, 1);"), "&"),
        (in_function('f("a", x, 1);'), '"'),
        (in_function("do ++k; while (k < 2);"), "do"),
    ],
)
def test_an_unknown_form_is_refused_by_name(text, form):
    with pytest.raises(KernelError) as refusal:
        translate_c_to_javascript(text)
    assert f"C has '{form}" in str(refusal.value)


@pytest.mark.parametrize(
    ("which", "task"),
    [("planar-3r", "planar"), ("panda", "position"), ("panda", "pose"), ("pa10-9dof", "pose"), ("ur5-rail", "position")],
)
def test_the_failure_tolerant_law_is_that_of_the_compiled_kernel(which, task, rng):
    law = hf.control.failure_tolerant(hf.arms.load(which), task)
    n, m = law.arm.n, law.task.m
    q, v = kinematics.joint_symbols(law.arm), ca.SX.sym("v", m)
    text = law.write_rates_in_javascript("law", q, v, [q, v])
    assert len(text) <= LARGEST_TEXT_BYTES
    rows = np.hstack([rng.uniform(-3, 3, (200, n)), rng.normal(size=(200, m)) * 10 ** rng.uniform(-3, 1, (200, 1))])
    rows[::20, n:] = 0
    rows[7, 0], rows[9, n], rows[11, n - 1] = np.nan, np.inf, -np.inf
    found, expected = browser.rows(text, "law", rows, n), law.velocity(rows[:, :n], rows[:, n:])
    assert np.isnan(found[[7, 9, 11]]).all()
    assert not found[::20].any()
    finite = np.isfinite(expected).all(axis=1)
    assert finite.sum() == 197
    size = np.abs(expected[finite]).max(axis=1, keepdims=True)
    assert (np.abs(found[finite] - expected[finite]) <= 1e-9 * size).all()


def test_inputs_of_a_law_may_be_other_symbols(rng):
    """A velocity of the tool in space for a planar task, for every kind of law."""
    arm = hf.arms.load("planar-3r")
    q, v = kinematics.joint_symbols(arm), ca.SX.sym("v", 3)
    rows = rng.normal(size=(50, 6))
    for law in (hf.control.failure_tolerant(arm, "planar"), hf.control.pseudoinverse(arm, "planar")):
        text = law.write_rates_in_javascript("law", q, ca.SX(ca.DM(law.task.rows[:, :3])) @ v, [q, v])
        expected = law.velocity(rows[:, :3], rows[:, 3:] @ law.task.rows[:, :3].T)
        np.testing.assert_allclose(browser.rows(text, "law", rows, 3), expected, rtol=1e-9, atol=1e-12)
