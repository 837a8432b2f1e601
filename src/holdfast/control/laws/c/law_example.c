/*
 * Control loop around NAME, in which an arm without dynamics follows the rates for one second.
 * cc -std=c99 NAME.c NAME_example.c -lm -o NAME_example
 */
#include "NAME.h"

#include <stdio.h>

/* Joint names in the order of your driver. Take them from the driver, not from NAME_joints. */
static const char *const driver[] = {JOINT_NAMES};

int main(void) {
    double q[COUNT] = {START}; /* rad, m; read it from the drives */
    double v[TASK_ROWS] = {TWIST}; /* TASK_NAME, TASK_FRAME frame, m/s and rad/s */
    double rates[COUNT];
    const double cycle = 0.01; /* s */
    int wrong = NAME_check_joints(driver, COUNT), k, i;
    if (wrong) {
        fprintf(stderr, "joint %d of the driver is not the arm's\n", wrong);
        return 2;
    }
    for (k = 0; k < 100; ++k) {
        if (NAME(q, v, RATES_ONLY)) {
            fprintf(stderr, "the law has no answer in cycle %d; the rates are 0\n", k);
            return 1;
        }
        for (i = 0; i < COUNT; ++i) q[i] += cycle * rates[i]; /* send the rates to the drives */
    }
    for (i = 0; i < COUNT; ++i) printf("%s %.9f\n", NAME_joints[i], q[i]);
    return 0;
}
