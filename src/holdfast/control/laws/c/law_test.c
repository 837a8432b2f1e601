/*
 * Test of NAME: returns 0 if it computes the same rates here as holdfast VERSION did when it wrote this file.
 * cc -std=c99 NAME.c NAME_test.c -lm -o NAME_test
 */
#include "NAME.h"

#include <math.h>
#include <stdio.h>

static const struct { double q[COUNT], v[TASK_ROWS], rates[COUNT]; } cases[CASE_COUNT] = {
CASE_ROWS};

int main(void) {
    double rates[COUNT], q[COUNT], size, off;
    volatile double zero = 0;
    int bad = 0, k, i;
    for (k = 0; k < CASE_COUNT; ++k) {
        int code = NAME(cases[k].q, cases[k].v, RATES_ONLY);
        for (size = off = 0, i = 0; i < COUNT; ++i) {
            size = fmax(size, fabs(cases[k].rates[i]));
            off = fmax(off, fabs(rates[i] - cases[k].rates[i]));
        }
        if (code || !(off <= TOLERANCE * size)) {
            printf("case %d: returned %d, the relative error of the rates is %g\n", k + 1, code, off / size);
            bad = 1;
        }
    }
    for (i = 0; i < COUNT; ++i) q[i] = zero / zero;
    if (NAME(q, cases[0].v, RATES_ONLY) != 1 || rates[0] != 0) {
        printf("NaN in q does not return 1 and zero rates; do not compile with -ffast-math\n");
        bad = 1;
    }
    if (NAME_check_joints(NAME_joints, COUNT) != 0 || NAME_check_joints(NAME_joints, BELOW_COUNT) != COUNT) {
        printf("NAME_check_joints accepts wrong joints or rejects the right ones\n");
        bad = 1;
    }
    puts(bad ? "failed" : "passed");
    return bad;
}
