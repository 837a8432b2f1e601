#ifndef GUARD_H
#define GUARD_H

#define GUARD_JOINTS COUNT
#define GUARD_RATE RATE_HZ
/* Latency of a tool pose, cycles. */
#define GUARD_LATE LATE_CYCLES
/* Version of holdfast, fingerprint of the arm (Arm.fingerprint in Python), and digest of the thresholds and sensors. */
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

/* Verdict; without an alarm, the other fields are meaningless. joint: faulty joint from 0, or -1 if there is none yet.
   loss: fraction of its torque that the motor lost, or -1 if the kind involves no loss.
   suspect: the only joint above its threshold if the kind is a contact, or -1. */
typedef struct {
    int alarm;
    double time;
    int joint;
    NAME_kind kind;
    double loss;
    int suspect;
} NAME_verdict;

/* Complete state of the monitor of one arm. r: residual torques; over_...: accumulated excess, s. */
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

/* Reset the monitor; call it before the first cycle. */
void NAME_init(NAME_state *state);

/* Clear the alarm and its accumulated excess while the arm keeps moving. */
void NAME_rearm(NAME_state *state);

/* Exclude a stopped joint from monitoring until NAME_init, clear the alarm, and restart the observer. */
void NAME_leave_out(NAME_state *state, int joint);

/* Skip a number of cycles without samples. */
void NAME_skip(NAME_state *state, long cycles);

/* Position of a joint by the measured tool pose, (4, 4) by rows, if the sensors of all other joints are right; rad or m.
   Metres and radians have equal weights. */
double NAME_joint_by_tool(const double q[COUNT], const double pose[16], int joint);

/* Process one control cycle, GUARD_RATE of them per second. *verdict may be revised for 2 s after an alarm.
   q, reference: measured and commanded joint positions, rad and m; a cycle with NaN is skipped.
   torque: commanded torques, N m and N, or NULL. pose: tool pose measured GUARD_LATE cycles ago, (4, 4) by rows, or NULL. */
void NAME_step(NAME_state *state, const double q[COUNT], const double reference[COUNT], const double *torque,
               const double *pose, NAME_verdict *verdict);

/* Signals without a value for 50 ms: 1 joints (or torques), 2 tool pose after its first sample, 3 both, 0 none. */
int NAME_stale(const NAME_state *state);

/* Name of a kind. */
const char *NAME_kind_name(NAME_kind kind);

#ifdef __cplusplus
}
#endif

#endif
