#ifndef GUARD_H
#define GUARD_H

#define GUARD_JOINTS COUNT
#define GUARD_RATE RATE_HZ
/* Cycles by which a pose comes after it was taken. */
#define GUARD_LATE LATE_CYCLES
/* What made this file, of which arm (Arm.fingerprint in Python), and a digest of the bounds and the sensors. */
#define GUARD_HOLDFAST "VERSION"
#define GUARD_ARM "FINGERPRINT"
#define GUARD_PARAMETERS "DIGEST"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    GUARD_UNKNOWN, GUARD_LOCKED, GUARD_STANDSTILL, GUARD_LIMP, GUARD_WEAK, GUARD_FRICTION, GUARD_SLUGGISH, GUARD_SENSOR,
    GUARD_CONTACT
} NAME_kind;

/* What is known: without an alarm the rest means nothing. joint: from 0, -1 if none is to blame or it is not known yet.
   loss: fraction of its torque that the motor lost, -1 where that is not the question.
   suspect: the joint that alone was above its bound, where the kind is a contact; -1 otherwise. */
typedef struct {
    int alarm;
    double time;
    int joint;
    NAME_kind kind;
    double loss;
    int suspect;
} NAME_verdict;

/* One for each arm that is watched; nothing else is kept anywhere. r: residual torques, over_...: seconds of excess. */
typedef struct {
    double v[COUNT], r[COUNT], level[COUNT];
    double over_z[COUNT], over_y[COUNT], over_w;
    long cycle, fast, seen, seen_at, count, poses, some, missed, known;
    int begun, anew, referred, alarmed, torques, tool, suspect, joint, told, out[COUNT];
    double past[GUARD_LATE + 1][COUNT], felt[COUNT];
    double q[COUNT], reference[COUNT], p[COUNT], gravity[COUNT], torque[COUNT], low[COUNT], last[5][6];
    double size[COUNT], residual[COUNT], left[COUNT], gap;
    double lowest, highest, wanted_low, wanted_high, asked, least, behind, rr, rt, rs, tt, ss, ts, push;
    NAME_verdict verdict;
} NAME_state;

extern const char *const NAME_joints[COUNT];

/* Before the first cycle, and to forget everything. */
void NAME_init(NAME_state *state);

/* Forget the alarm and what led to it, while the arm goes on. */
void NAME_rearm(NAME_state *state);

/* Watch on without a joint that was stopped, until NAME_init: the alarm is forgotten, and what follows the motion begins anew. */
void NAME_leave_out(NAME_state *state, int joint);

/* So many cycles went by without a sample, as if each had been passed over. */
void NAME_skip(NAME_state *state, long cycles);

/* Where a joint is by the tool's measured pose, (4, 4) row by row, if all others are where their sensors say; rad or m.
   Metres and radians weigh alike. */
double NAME_joint_by_tool(const double q[COUNT], const double pose[16], int joint);

/* One control cycle, GUARD_RATE of them a second. What is known then is in *verdict, and may be revised for 2 s after an alarm.
   q, reference: measured and commanded joint values, rad and m; a cycle with NaN is passed over.
   torque: commanded torques, N m and N, or NULL. pose: the tool's, measured GUARD_LATE cycles ago, (4, 4) by rows, or NULL. */
void NAME_step(NAME_state *state, const double q[COUNT], const double reference[COUNT], const double *torque,
               const double *pose, NAME_verdict *verdict);

/* What has told no number for 50 ms: 1 joints (or torques), 2 the tool once it has been seen, 3 both, 0 nothing. */
int NAME_stale(const NAME_state *state);

/* A word for each kind. */
const char *NAME_kind_name(NAME_kind kind);

#ifdef __cplusplus
}
#endif

#endif
