/*
 * Reads a log from standard input, one cycle per line (COUNT measured positions, COUNT references, COUNT torques), and prints
 * the verdict of the monitor. A controller calls NAME_step in its control cycle.
 * cc -std=c99 NAME.c NAME_example.c -lm -o NAME_example
 */
#include "NAME.h"

#include <stdio.h>

int main(void) {
    static NAME_state state; /* one per arm */
    double cycle[3 * COUNT];
    NAME_verdict verdict = {0, 0, -1, GUARD_UNKNOWN, -1, -1};
    int k, known = 0;
    NAME_init(&state);
    for (;;) {
        for (k = 0; k < 3 * COUNT && scanf("%lf", cycle + k) == 1;) ++k;
        if (k < 3 * COUNT) break;
        NAME_step(&state, cycle, cycle + COUNT, cycle + 2 * COUNT, 0, &verdict);
        if (verdict.alarm && !known) printf("alarm at %.3f s\n", verdict.time);
        known = verdict.alarm;
    }
    if (!known) puts("no fault detected, which does not prove that there is none");
    else if (verdict.joint < 0) printf("no joint is known: %s\n", NAME_kind_name(verdict.kind));
    else printf("%s: %s\n", NAME_joints[verdict.joint], NAME_kind_name(verdict.kind));
    return known ? 3 : 0;
}
