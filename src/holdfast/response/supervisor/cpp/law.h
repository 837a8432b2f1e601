#ifndef GUARD_LAW_H
#define GUARD_LAW_H

#ifdef __cplusplus
extern "C" {
#endif

/* The law without the joints whose mask is 0 (1 for the others). q: rad and m; v: velocity of the task's TASK_ROWS rows, m/s and
   rad/s. Returns 0; or 1 and zero rates where an input is not finite or the law has no answer. */
int NAME_law(const double q[COUNT], const double v[TASK_ROWS], const double mask[COUNT], double rates[COUNT]);

#ifdef __cplusplus
}
#endif

#endif
