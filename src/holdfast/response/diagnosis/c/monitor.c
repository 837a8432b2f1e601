enum { N = COUNT, SMOOTHED = 5 };
static const double DT = CONST_DT;

/* The only joint above its threshold, on average over the cycles that isolate it; -1 if there is none. */
static int find_lone_joint(const NAME_state *s) {
    int k, lone = -1, above = 0;
    for (k = 0; k < N; ++k)
        if (s->size[k] > CONST_SPLIT) {
            lone = k;
            above += 1;
        }
    return above == 1 ? lone : -1;
}

static void answer(NAME_state *s, int joint, NAME_kind kind, double loss) {
    s->verdict.joint = joint;
    s->verdict.kind = kind;
    s->verdict.loss = loss;
    s->verdict.suspect = kind == GUARD_CONTACT ? find_lone_joint(s) : -1;
}

/* Update the rates and the residual of the momentum. */
static void observe(NAME_state *s, const double *q, const double *torque) {
#if WITH_TORQUES
    double p[N], energy[N], known;
    int anew = !s->begun || s->anew > 0;
#endif
    int k, first = !s->begun;
    for (k = 0; k < N; ++k) {
        if (first) {
            if (torque) s->torque[k] = s->low[k] = torque[k];
        } else {
            s->v[k] += (s->anew > CONST_LONGEST ? 1 : CONST_BAND) * ((q[k] - s->q[k]) / DT - s->v[k]);
        }
        s->q[k] = q[k];
    }
    if (!first && s->anew > 0) s->anew -= 1;
    s->begun = 1;
#if WITH_TORQUES
    if (!torque) return;
    momentum(q, s->v, p, energy, s->gravity);
    for (k = 0; k < N; ++k) {
        s->torque[k] += CONST_BAND * (torque[k] - s->torque[k]);
        s->low[k] += CONST_LOW * (s->torque[k] - s->low[k]);
        if (!anew) {
            known = s->torque[k] + energy[k] - s->gravity[k] - (coulomb[k] * tanh(s->v[k] / CONST_SLIP) + viscous[k] * s->v[k]);
            s->r[k] = CONST_KEEP * s->r[k] + CONST_GAIN * (p[k] - s->p[k] - DT * known);
        }
        s->p[k] = p[k];
    }
#endif
}

static void begin_anew(NAME_state *s) {
    int k;
    s->begun = 0;
    s->anew = CONST_LONGEST + 1;
    for (k = 0; k < N; ++k) s->r[k] = 0;
}

/* Interpolate linearly over skipped cycles; after too many, restart the observer and wait until the filters settle. */
static void bridge(NAME_state *s, const double *q, const double *torque) {
    double start[N], between[N], felt[N];
    long k;
    int i;
    if (s->begun && s->missed > CONST_LONGEST) begin_anew(s);
    for (i = 0; i < N; ++i) {
        start[i] = s->q[i];
        felt[i] = s->known == s->missed && s->known > 0 ? s->felt[i] / (double)s->known : s->torque[i];
        s->felt[i] = 0;
    }
    for (k = 1; k <= s->missed && s->begun; ++k) {
        for (i = 0; i < N; ++i) between[i] = start[i] + (double)k * ((q[i] - start[i]) / (double)(s->missed + 1));
        observe(s, between, torque ? felt : 0);
    }
    s->missed = s->known = 0;
}

/* Measured minus computed tool pose, and the Jacobian column by column. */
static void off_tool(const double *q, const double *pose, double residual[6], double jacobian[6 * N]) {
    double there[12], ends[3 * N], turn[9];
    int i, j, k;
    tool(q, there, jacobian, ends);
    for (i = 0; i < 3; ++i) {
        residual[i] = pose[4 * i + 3] - there[9 + i];
        for (j = 0; j < 3; ++j)
            for (turn[3 * i + j] = 0, k = 0; k < 3; ++k) turn[3 * i + j] += pose[4 * i + k] * there[3 * j + k];
    }
    rotation_vector(turn, residual + 3);
}

/* Add a sample of the tool pose: its residual, the smoothed one in units of the thresholds, the Jacobian by columns. */
static double look(NAME_state *s, const double *q, const double *pose, double residual[6], double jacobian[6 * N]) {
    double mean[6] = {0}, w;
    long since;
    int i, k, some;
    off_tool(q, pose, residual, jacobian);
    for (i = 0; i < 6; ++i) s->last[s->seen % SMOOTHED][i] = residual[i];
    some = s->seen + 1 < SMOOTHED ? (int)s->seen + 1 : SMOOTHED;
    for (k = 0; k < some; ++k)
        for (i = 0; i < 6; ++i) mean[i] += s->last[k][i];
    for (i = 0; i < 6; ++i) mean[i] /= some;
    w = larger(sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]) / CONST_POSITION,
               sqrt(mean[3] * mean[3] + mean[4] * mean[4] + mean[5] * mean[5]) / CONST_ANGLE);
    since = s->cycle - s->seen_at < CONST_LONGEST ? s->cycle - s->seen_at : CONST_LONGEST; /* one sample after a long gap is no evidence */
    if (s->seen) s->over_w = larger(0, s->over_w + (w - 1) * (double)since * DT);
    s->seen += 1;
    s->seen_at = s->cycle;
    return w;
}

/* Part of `rows`, in squared deviations, that a force at the far end of link `last` does not explain; end: from the tool. */
static double left_by_force(const NAME_state *s, const double *rows, const double *jacobian, const double *end, int last) {
    double column[3][N], rest[N], size, before, along, left = 0;
    int i, j, k;
    for (k = 0; k < N; ++k) {
        const double *v = jacobian + 6 * k, *w = v + 3, scale = k > last || s->out[k] ? 0 : 1 / (CONST_SCALE * change_bound[k]);
        rest[k] = rows[k];
        for (i = 0; i < 3; ++i)
            column[i][k] = scale * (v[i] + w[(i + 1) % 3] * end[(i + 2) % 3] - w[(i + 2) % 3] * end[(i + 1) % 3]);
    }
    for (i = 0; i < 3; ++i) {
        for (before = 0, k = 0; k < N; ++k) before += column[i][k] * column[i][k];
        for (j = 0; j < i; ++j) {
            for (along = 0, k = 0; k < N; ++k) along += column[i][k] * column[j][k];
            for (k = 0; k < N; ++k) column[i][k] -= along * column[j][k];
        }
        for (size = 0, k = 0; k < N; ++k) size += column[i][k] * column[i][k];
        size = size > 1e-18 * before ? sqrt(size) : 0;
        for (k = 0; k < N; ++k) column[i][k] = size > 0 ? column[i][k] / size : 0;
        for (along = 0, k = 0; k < N; ++k) along += column[i][k] * rest[k];
        for (k = 0; k < N; ++k) rest[k] -= along * column[i][k];
    }
    for (k = 0; k < N; ++k) left += rest[k] * rest[k];
    return left;
}

/* Squared deviations by which a force on a link explains the change of the residual torques better than one joint. */
static double better_by_force(const NAME_state *s, const double *q) {
    double there[12], jacobian[6 * N], ends[3 * N], rows[N], whole = 0, most = 0, least = HUGE_VAL;
    int k;
    tool(q, there, jacobian, ends);
    for (k = 0; k < N; ++k) {
        rows[k] = s->out[k] ? 0 : (s->residual[k] / CONST_SPLIT - s->level[k]) / (CONST_SCALE * change_bound[k]);
        whole += rows[k] * rows[k];
        most = larger(most, rows[k] * rows[k]);
    }
    for (k = 0; k < N; ++k) least = smaller(least, left_by_force(s, rows, jacobian, ends + 3 * k, k));
    return whole - most - least;
}

/* Add a cycle after the alarm to the sums that the decision needs. */
static void follow(NAME_state *s, const double *q, const double *reference, const double *z, const double *y) {
    int k;
    s->count += 1;
    if (s->count <= CONST_SPLIT) {
        for (k = 0; k < N; ++k) {
            double value = s->torques && !(z[k] <= y[k]) ? z[k] : y[k];
            s->size[k] += value == value ? value : 0;
            s->residual[k] += s->r[k];
        }
        if (s->count == CONST_SPLIT) {
            if (s->torques) s->push = better_by_force(s, q);
            for (s->joint = 0, k = 1; k < N; ++k)
                if (s->size[k] > s->size[s->joint]) s->joint = k;
        }
    } else if (s->count <= CONST_LAST) {
        int i = s->joint;
        double slip = tanh(s->v[i] / CONST_SLIP), r = s->r[i], low = s->low[i];
        if (s->some == 0) {
            s->lowest = s->highest = q[i];
            s->wanted_low = s->wanted_high = reference[i];
            s->least = HUGE_VAL;
        }
        s->some += 1;
        s->behind = fabs(reference[i] - q[i]);
        s->lowest = smaller(s->lowest, q[i]);
        s->highest = larger(s->highest, q[i]);
        s->wanted_low = smaller(s->wanted_low, reference[i]);
        s->wanted_high = larger(s->wanted_high, reference[i]);
        s->asked = larger(s->asked, fabs(low - s->gravity[i]));
        s->least = smaller(s->least, fabs(s->gravity[i]));
        s->rr += r * r;
        s->rt += r * low;
        s->rs += r * slip;
        s->tt += low * low;
        s->ss += slip * slip;
        s->ts += low * slip;
    }
}

/* Add the part of a tool pose sample that an error of each joint sensor would not explain. */
static void explain(NAME_state *s, double w, const double residual[6], const double jacobian[6 * N]) {
    double whole = 0, best = HUGE_VAL, next = HUGE_VAL, along, size;
    int i, k;
    if (s->count <= CONST_AGAIN && w > CONST_SUSPECT) s->suspect = 1;
    if (s->told >= 0 && s->gap > CONST_WORSE) return;
    for (i = 0; i < 6; ++i) whole += (residual[i] * weight[i]) * (residual[i] * weight[i]);
    for (k = 0; k < N; ++k) {
        for (along = size = 0, i = 0; i < 6; ++i) {
            double entry = jacobian[6 * k + i] * weight[i];
            along += residual[i] * weight[i] * entry;
            size += entry * entry;
        }
        s->left[k] += whole - along * along / larger(size, 1e-300);
    }
    s->poses += 1;
    if (s->poses < 2) return;
    for (k = 0; k < N; ++k) {
        if (s->left[k] < best) {
            next = best;
            best = s->left[k];
            s->told = k;
        } else {
            next = smaller(next, s->left[k]);
        }
    }
    s->gap = next - best;
}

static void decide(NAME_state *s) {
    int i = s->joint, still, follows, driven;
    double travel, wanted, loss, drag, by_loss, by_drag, worse;
    if (s->count < CONST_SPLIT) return;
    if (s->suspect) {
        answer(s, s->told >= 0 && s->gap > CONST_WORSE ? s->told : -1, GUARD_SENSOR, -1);
        return;
    }
    if (s->push > CONST_PUSHED && !(s->behind > CONST_LOST * tracking_bound[i])) {
        answer(s, -1, GUARD_CONTACT, -1);
        return;
    }
    if (s->count < CONST_LAST) {
        answer(s, i, GUARD_UNKNOWN, -1);
        return;
    }
    travel = s->highest - s->lowest;
    wanted = s->wanted_high - s->wanted_low;
    still = travel < CONST_STILL && travel < CONST_PART * wanted + CONST_NOISE;
    if (!s->torques) {
        answer(s, i, still ? GUARD_LOCKED : GUARD_UNKNOWN, -1);
        return;
    }
    loss = s->tt > 0 ? smaller(larger(-s->rt / s->tt, 0), 1.3) : -1;
    drag = larger(0, -s->rs / larger(s->ss, 1e-12));
    by_loss = s->tt > 0 ? s->rr + 2 * loss * s->rt + loss * loss * s->tt : HUGE_VAL;
    by_drag = s->rr + 2 * drag * s->rs + drag * drag * s->ss;
    follows = s->behind < tracking_bound[i];
    driven = coulomb[i] > 0 && s->rs + s->ts > CONST_DRIVEN * coulomb[i] * s->ss;
    worse = (by_drag - by_loss) / ((double)s->some * (CONST_SCALE * torque_bound[i]) * (CONST_SCALE * torque_bound[i]));
    if (still && s->asked >= CONST_TIMES * coulomb[i]) {
        if (loss > CONST_LEAST && loss < CONST_MOST && s->least < CONST_TIMES * coulomb[i])
            answer(s, i, GUARD_STANDSTILL, loss);
        else
            answer(s, i, GUARD_LOCKED, -1);
    } else if (!(s->tt > 0) || !(smaller(by_loss, by_drag) < 0.5 * s->rr)) {
        answer(s, i, GUARD_UNKNOWN, -1);
    } else if (fabs(worse) < 1 && (drag <= CONST_GROWN * coulomb[i] || coulomb[i] == 0)) {
        answer(s, i, GUARD_SLUGGISH, loss);
    } else if (worse < 0) {
        answer(s, i, GUARD_FRICTION, -1);
    } else if (follows && driven && loss > CONST_MORE) {
        answer(s, -1, GUARD_CONTACT, -1);
    } else if (loss > CONST_ALL || (loss > CONST_LEAST && s->behind > CONST_AWAY * tracking_bound[i])) {
        answer(s, i, GUARD_LIMP, loss);
    } else {
        answer(s, i, GUARD_WEAK, loss);
    }
}

void NAME_rearm(NAME_state *s) {
    int k;
    for (k = 0; k < N; ++k) {
        s->over_z[k] = s->over_y[k] = s->size[k] = s->residual[k] = 0;
        s->left[k] = s->out[k] ? HUGE_VAL : 0;
    }
    s->over_w = s->gap = s->lowest = s->highest = s->wanted_low = s->wanted_high = s->asked = s->least = s->behind = 0;
    s->rr = s->rt = s->rs = s->tt = s->ss = s->push = s->ts = s->verdict.time = 0;
    s->count = s->poses = s->some = 0;
    s->alarmed = s->torques = s->tool = s->suspect = s->verdict.alarm = 0;
    s->joint = s->told = -1;
    answer(s, -1, GUARD_UNKNOWN, -1);
}

void NAME_init(NAME_state *s) {
    static const NAME_state zero;
    *s = zero;
    NAME_rearm(s);
}

void NAME_leave_out(NAME_state *s, int joint) {
    int i, k;
    s->out[joint] = 1;
    s->seen = 0;
    for (i = 0; i <= GUARD_LATE; ++i)
        for (k = 0; k < N; ++k) s->past[i][k] = HUGE_VAL;
    begin_anew(s);
    NAME_rearm(s);
}

void NAME_skip(NAME_state *s, long cycles) {
    int k;
    for (; cycles > 0; --cycles, s->missed += 1) /* a pose of these cycles is not used */
        for (s->cycle += 1, k = 0; k < N; ++k) s->past[s->cycle % (GUARD_LATE + 1)][k] = HUGE_VAL;
}

void NAME_step(NAME_state *s, const double q[COUNT], const double reference[COUNT], const double *torque, const double *pose,
               NAME_verdict *verdict) {
    double z[N], y[N], residual[6], jacobian[6 * N], w = 0, over_z = 0, over_y = 0, most = 0, h;
    const double *then;
    int k, gated, look_now = 0;
    if (!WITH_TORQUES) torque = 0;
    s->cycle += 1;
    for (k = 0; k < N; ++k) s->past[s->cycle % (GUARD_LATE + 1)][k] = q[k];
    then = s->past[(s->cycle + 1) % (GUARD_LATE + 1)];
    *verdict = s->verdict;
    if (!finite_all(q, N) || !finite_all(reference, N) || (torque && !finite_all(torque, N))) {
        s->missed += 1;
        s->known += torque && finite_all(torque, N);
        for (k = 0; k < N && torque && finite_all(torque, N); ++k) s->felt[k] += torque[k];
        return;
    }
    h = (double)(s->missed + 1) * DT; /* longer after skipped cycles */
    bridge(s, q, torque);
    observe(s, q, torque);
    for (k = 0; k < N && s->referred; ++k)
        if (fabs(reference[k] - s->reference[k]) >= CONST_SLOW * h) s->fast = s->cycle;
    gated = !torque && s->cycle - s->fast < CONST_CALM;
    for (k = 0; k < N; ++k) {
        s->reference[k] = reference[k];
        z[k] = s->out[k] ? 0 : fabs(s->r[k]) / torque_bound[k];
        y[k] = s->out[k] ? 0 : fabs(reference[k] - q[k]) / tracking_bound[k];
        s->over_z[k] = larger(0, s->over_z[k] + (z[k] - 1) * DT);
        if (!gated) s->over_y[k] = larger(0, s->over_y[k] + (y[k] - 1) * DT);
        over_z = larger(over_z, s->over_z[k]);
        over_y = larger(over_y, s->over_y[k]);
        most = larger(most, z[k]);
        if (gated) y[k] = 0;
    }
    s->referred = 1;
    if (pose && s->cycle > GUARD_LATE && finite_all(then, N) && finite_all(pose, 16)) {
        w = look(s, then, pose, residual, jacobian);
        look_now = 1;
    }
    for (k = 0; k < N && !s->alarmed && most < CONST_UNSURE; ++k) s->level[k] += CONST_LEVEL * (s->r[k] - s->level[k]);
    if (!s->alarmed && (over_z > CONST_LIMIT_Z || over_y > CONST_LIMIT_Y || s->over_w > CONST_LIMIT_W)) {
        s->alarmed = s->verdict.alarm = 1;
        s->verdict.time = (double)(s->cycle - 1) * DT;
        s->torques = torque != 0;
        s->tool = s->seen > 0;
        s->suspect = !(over_z > CONST_LIMIT_Z || over_y > CONST_LIMIT_Y);
    }
    if (s->alarmed && s->count < CONST_ENDS) {
        follow(s, q, reference, z, y);
        if (look_now) explain(s, w, residual, jacobian);
        if (look_now || s->count == CONST_SPLIT || s->count == CONST_LAST) decide(s);
    }
    *verdict = s->verdict;
}

double NAME_joint_by_tool(const double q[COUNT], const double pose[16], int joint) {
    double at[N], residual[6], jacobian[6 * N], along, size;
    int i, k;
    for (i = 0; i < N; ++i) at[i] = q[i];
    for (k = 0; k < 3; ++k) {
        off_tool(at, pose, residual, jacobian);
        for (along = size = 0, i = 0; i < 6; ++i) {
            along += residual[i] * jacobian[6 * joint + i];
            size += jacobian[6 * joint + i] * jacobian[6 * joint + i];
        }
        at[joint] += along / larger(size, 1e-12);
    }
    return at[joint];
}

int NAME_stale(const NAME_state *s) {
    return (s->missed > CONST_LONGEST) + 2 * (s->seen > 0 && s->cycle - s->seen_at > CONST_LONGEST);
}

const char *NAME_kind_name(NAME_kind kind) {
    static const char *const names[] = {KIND_WORDS};
    return names[kind];
}
