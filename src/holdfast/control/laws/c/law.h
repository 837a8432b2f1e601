#ifndef GUARD_H
#define GUARD_H

#define GUARD_JOINTS COUNT
#define GUARD_ROWS TASK_ROWS
/* Version of holdfast, and fingerprint of the arm ("fingerprint" in 'holdfast describe --json', Arm.fingerprint in Python). */
#define GUARD_HOLDFAST "VERSION"
#define GUARD_ARM "FINGERPRINT"

#ifdef __cplusplus
extern "C" {
#endif

/* The joints in the order of q and rates. */
extern const char *const NAME_joints[COUNT];

/* Returns 0 if a driver has these joints in this order, else the position (from 1) of the first joint that differs. */
int NAME_check_joints(const char *const names[], int count);

SIGNATURE;

#ifdef __cplusplus
}
#endif

#endif
