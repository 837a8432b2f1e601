const N = COUNT, SMOOTHED = 5, DT = CONST_DT, LATE = LATE_CYCLES;
const KINDS = [KIND_WORDS];
const [UNKNOWN, LOCKED, STANDSTILL, LIMP, WEAK, FRICTION, SLUGGISH, SENSOR, CONTACT] = KINDS.keys();
const finiteAll = (values) => values.every(Number.isFinite);

/* Rotation vector of a rotation, row by row, by the longest row of 4 q q' of its quaternion q. */
function rotationVector(r) {
    const trace = r[0] + r[4] + r[8], o = [[], [], [], []];
    for (let i = 0; i < 3; ++i) for (let j = 0; j < 3; ++j) o[i][j] = i === j ? 1 + 2 * r[4 * i] - trace : r[3 * i + j] + r[3 * j + i];
    o[3][3] = 1 + trace;
    o[3][0] = o[0][3] = r[7] - r[5];
    o[3][1] = o[1][3] = r[2] - r[6];
    o[3][2] = o[2][3] = r[3] - r[1];
    let best = 0, size = 0;
    for (let i = 1; i < 4; ++i) if (o[i][i] > o[best][best]) best = i;
    for (let i = 0; i < 4; ++i) size += o[best][i] * o[best][i];
    const q = o[best].map((x) => (x / Math.sqrt(size)) * (o[best][3] < 0 ? -1 : 1));
    const half = Math.atan2(Math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), q[3]);
    const factor = half > 1e-12 ? (2 * half) / Math.sin(half) : 2;
    return [q[0] * factor, q[1] * factor, q[2] * factor];
}

/* Watches one arm: step(q, reference, torque, pose) in every cycle, RATE_HZ of them a second. As NAME_step in C. */
export class Monitor {
    constructor() {
        const zeros = () => new Float64Array(N);
        Object.assign(this, {v: zeros(), r: zeros(), q: zeros(), reference: zeros(), p: zeros(), gravity: zeros()});
        Object.assign(this, {torque: zeros(), low: zeros(), level: zeros(), felt: zeros(), last: []});
        for (const name of ["cycle", "fast", "seen", "seenAt", "missed", "known", "anew"]) this[name] = 0;
        this.begun = this.referred = false;
        this.past = Array.from({length: LATE + 1}, () => zeros().fill(NaN));
        this.given = new Float64Array(2 * N);
        this.terms = new Float64Array(3 * N);
        this.there = new Float64Array(12 + 9 * N);
        this.rearm();
    }

    /* Forget the alarm and what led to it, while the arm goes on. */
    rearm() {
        for (const name of ["overZ", "overY", "size", "residual", "left"]) this[name] = new Float64Array(N);
        for (const name of ["overW", "gap", "lowest", "highest", "wantedLow", "wantedHigh", "asked", "least", "behind"]) this[name] = 0;
        for (const name of ["rr", "rt", "rs", "tt", "ss", "ts", "count", "poses", "some", "push"]) this[name] = 0;
        this.alarmed = this.torques = this.tool = this.suspect = false;
        this.joint = this.told = -1;
        this.verdict = {alarm: false, time: 0, joint: -1, kind: UNKNOWN, loss: -1, suspect: -1};
    }

    kind() {
        return KINDS[this.verdict.kind];
    }

    /* What has told no number for 50 ms: "joints" (or torques), "tool" once it has been seen. */
    stale() {
        const tool = this.seen > 0 && this.cycle - this.seenAt > CONST_LONGEST;
        return [...(this.missed > CONST_LONGEST ? ["joints"] : []), ...(tool ? ["tool"] : [])];
    }

    step(q, reference, torque, pose) {
        const z = new Float64Array(N), y = new Float64Array(N);
        if (!WITH_TORQUES) torque = null;
        this.cycle += 1;
        this.past[this.cycle % (LATE + 1)].set(q);
        const then = this.past[(this.cycle + 1) % (LATE + 1)];
        if (!finiteAll(q) || !finiteAll(reference) || (torque && !finiteAll(torque))) {
            this.missed += 1;
            if (torque && finiteAll(torque)) {
                this.known += 1;
                torque.forEach((x, k) => (this.felt[k] += x));
            }
            return this.verdict;
        }
        const h = (this.missed + 1) * DT; /* longer after cycles without a sample */
        this.#bridge(q, torque);
        this.#observe(q, torque);
        for (let k = 0; k < N && this.referred; ++k) if (Math.abs(reference[k] - this.reference[k]) >= CONST_SLOW * h) this.fast = this.cycle;
        const gated = !torque && this.cycle - this.fast < CONST_CALM;
        let overZ = 0, overY = 0, most = 0, look = null;
        for (let k = 0; k < N; ++k) {
            this.reference[k] = reference[k];
            z[k] = Math.abs(this.r[k]) / torqueBound[k];
            y[k] = Math.abs(reference[k] - q[k]) / trackingBound[k];
            this.overZ[k] = Math.max(0, this.overZ[k] + (z[k] - 1) * DT);
            if (!gated) this.overY[k] = Math.max(0, this.overY[k] + (y[k] - 1) * DT);
            overZ = Math.max(overZ, this.overZ[k]);
            overY = Math.max(overY, this.overY[k]);
            most = Math.max(most, z[k]);
            if (gated) y[k] = 0;
        }
        this.referred = true;
        if (pose && finiteAll(then) && finiteAll(pose)) look = this.#look(then, pose);
        for (let k = 0; k < N && !this.alarmed && most < CONST_UNSURE; ++k) this.level[k] += CONST_LEVEL * (this.r[k] - this.level[k]);
        const joints = overZ > CONST_LIMIT_Z || overY > CONST_LIMIT_Y;
        if (!this.alarmed && (joints || this.overW > CONST_LIMIT_W)) {
            this.alarmed = this.verdict.alarm = true;
            this.verdict.time = (this.cycle - 1) * DT;
            this.torques = torque !== null;
            this.tool = this.seen > 0;
            this.suspect = !joints;
        }
        if (this.alarmed && this.count < CONST_ENDS) {
            this.#follow(q, reference, z, y);
            if (look) this.#explain(look);
            if (look || this.count === CONST_SPLIT || this.count === CONST_LAST) this.#decide();
        }
        return this.verdict;
    }

    /* Rates, and the residual of the momentum. */
    #observe(q, torque) {
        const first = !this.begun, anew = first || this.anew > 0, gain = this.anew > CONST_LONGEST ? 1 : CONST_BAND;
        for (let k = 0; k < N; ++k) {
            if (!first) this.v[k] += gain * ((q[k] - this.q[k]) / DT - this.v[k]);
            else if (torque) this.torque[k] = this.low[k] = torque[k];
            this.q[k] = q[k];
        }
        if (!first && this.anew > 0) this.anew -= 1;
        this.begun = true;
        if (!torque) return;
        this.given.set(q);
        this.given.set(this.v, N);
        momentum(this.given, this.terms);
        for (let k = 0; k < N; ++k) {
            const p = this.terms[k], friction = coulomb[k] * Math.tanh(this.v[k] / CONST_SLIP) + viscous[k] * this.v[k];
            this.gravity[k] = this.terms[2 * N + k];
            this.torque[k] += CONST_BAND * (torque[k] - this.torque[k]);
            this.low[k] += CONST_LOW * (this.torque[k] - this.low[k]);
            const known = this.torque[k] + this.terms[N + k] - this.gravity[k] - friction;
            if (!anew) this.r[k] = CONST_KEEP * this.r[k] + CONST_GAIN * (p - this.p[k] - DT * known);
            this.p[k] = p;
        }
    }

    /* Follow straight lines over cycles that were passed over; after too many begin anew, once the filters have settled. */
    #bridge(q, torque) {
        if (this.begun && this.missed > CONST_LONGEST) {
            this.begun = false;
            this.anew = CONST_LONGEST + 1;
            this.r.fill(0);
        }
        const all = this.known === this.missed && this.known > 0;
        const start = this.q.slice(), felt = this.torque.map((x, k) => (all ? this.felt[k] / this.known : x));
        for (let k = 1; k <= this.missed && this.begun; ++k) {
            const between = start.map((x, i) => x + k * ((q[i] - x) / (this.missed + 1)));
            this.#observe(between, torque ? felt : null);
        }
        this.felt.fill(0);
        this.missed = this.known = 0;
    }

    /* A sample of the tool's pose: its own residual, and its smoothed one in units of the bounds. */
    #look(q, pose) {
        const there = this.there, turn = [], mean = [0, 0, 0, 0, 0, 0];
        tool(q, there);
        for (let i = 0; i < 3; ++i)
            for (let j = 0; j < 3; ++j) {
                turn[3 * i + j] = 0;
                for (let k = 0; k < 3; ++k) turn[3 * i + j] += pose[4 * i + k] * there[3 * j + k];
            }
        const residual = [pose[3] - there[9], pose[7] - there[10], pose[11] - there[11], ...rotationVector(turn)];
        this.last[this.seen % SMOOTHED] = residual;
        for (const one of this.last) for (let i = 0; i < 6; ++i) mean[i] += one[i];
        for (let i = 0; i < 6; ++i) mean[i] /= this.last.length;
        const length = (i) => Math.sqrt(mean[i] * mean[i] + mean[i + 1] * mean[i + 1] + mean[i + 2] * mean[i + 2]);
        const w = Math.max(length(0) / CONST_POSITION, length(3) / CONST_ANGLE);
        const since = Math.min(this.cycle - this.seenAt, CONST_LONGEST);
        if (this.seen) this.overW = Math.max(0, this.overW + (w - 1) * since * DT);
        this.seen += 1;
        this.seenAt = this.cycle;
        return {w, residual};
    }

    /* Of `rows`, in squares of deviations, what a force at the far end of link `last` cannot explain. */
    #leftByForce(rows, there, last) {
        const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
        const rest = rows.slice(), column = [0, 1, 2].map(() => new Float64Array(N));
        const end = there.subarray(12 + 6 * N + 3 * last); /* from the tool */
        for (let k = 0; k <= last; ++k) {
            const v = there.subarray(12 + 6 * k), w = v.subarray(3), scale = 1 / (CONST_SCALE * changeBound[k]);
            for (let i = 0; i < 3; ++i)
                column[i][k] = scale * (v[i] + w[(i + 1) % 3] * end[(i + 2) % 3] - w[(i + 2) % 3] * end[(i + 1) % 3]);
        }
        for (let i = 0; i < 3; ++i) {
            const before = dot(column[i], column[i]);
            for (let j = 0; j < i; ++j) {
                const along = dot(column[i], column[j]);
                column[i].forEach((x, k) => (column[i][k] = x - along * column[j][k]));
            }
            const square = dot(column[i], column[i]), size = square > 1e-18 * before ? Math.sqrt(square) : 0;
            column[i].forEach((x, k) => (column[i][k] = size > 0 ? x / size : 0));
            const along = dot(column[i], rest);
            rest.forEach((x, k) => (rest[k] = x - along * column[i][k]));
        }
        return dot(rest, rest);
    }

    /* By how many squares of deviations a force on a link explains the change of the residual torques better than one joint. */
    #betterByForce(q) {
        const there = new Float64Array(12 + 9 * N); /* the other one is of the pose, and late */
        tool(q, there);
        const rows = this.residual.map((x, k) => (x / CONST_SPLIT - this.level[k]) / (CONST_SCALE * changeBound[k]));
        const squares = rows.map((x) => x * x), whole = squares.reduce((sum, x) => sum + x, 0);
        const least = Math.min(...squares.map((_, k) => this.#leftByForce(rows, there, k)));
        return whole - Math.max(...squares) - least;
    }

    /* A cycle after the alarm: sums, which are all that the decision needs. */
    #follow(q, reference, z, y) {
        this.count += 1;
        if (this.count <= CONST_SPLIT) {
            for (let k = 0; k < N; ++k) {
                this.size[k] += this.torques ? Math.max(z[k], y[k]) : y[k];
                this.residual[k] += this.r[k];
            }
            if (this.count < CONST_SPLIT) return;
            if (this.torques) this.push = this.#betterByForce(q);
            this.joint = this.size.indexOf(Math.max(...this.size));
        } else if (this.count <= CONST_LAST) {
            const i = this.joint, slip = Math.tanh(this.v[i] / CONST_SLIP), r = this.r[i], low = this.low[i];
            if (this.some === 0) {
                this.lowest = this.highest = q[i];
                this.wantedLow = this.wantedHigh = reference[i];
                this.least = Infinity;
            }
            this.some += 1;
            this.behind = Math.abs(reference[i] - q[i]);
            this.lowest = Math.min(this.lowest, q[i]);
            this.highest = Math.max(this.highest, q[i]);
            this.wantedLow = Math.min(this.wantedLow, reference[i]);
            this.wantedHigh = Math.max(this.wantedHigh, reference[i]);
            this.asked = Math.max(this.asked, Math.abs(low - this.gravity[i]));
            this.least = Math.min(this.least, Math.abs(this.gravity[i]));
            this.rr += r * r;
            this.rt += r * low;
            this.rs += r * slip;
            this.tt += low * low;
            this.ss += slip * slip;
            this.ts += low * slip;
        }
    }

    /* What each joint's sensor would leave unexplained of a sample of the tool's pose. */
    #explain({w, residual}) {
        if (this.count <= CONST_AGAIN && w > CONST_SUSPECT) this.suspect = true;
        if (this.told >= 0 && this.gap > CONST_WORSE) return;
        const scaled = residual.map((x, i) => x * weight[i]), whole = scaled.reduce((sum, x) => sum + x * x, 0);
        for (let k = 0; k < N; ++k) {
            let along = 0, size = 0;
            for (let i = 0; i < 6; ++i) {
                const entry = this.there[12 + 6 * k + i] * weight[i];
                along += scaled[i] * entry;
                size += entry * entry;
            }
            this.left[k] += whole - (along * along) / Math.max(size, 1e-300);
        }
        this.poses += 1;
        if (this.poses < 2) return;
        const [best, next = Infinity] = [...this.left].sort((a, b) => a - b);
        this.told = this.left.indexOf(best);
        this.gap = next - best;
    }

    #answer(joint, kind, loss) {
        const above = kind === CONTACT ? [...this.size.keys()].filter((k) => this.size[k] > CONST_SPLIT) : [];
        Object.assign(this.verdict, {joint, kind, loss, suspect: above.length === 1 ? above[0] : -1});
    }

    #decide() {
        const i = this.joint;
        if (this.count < CONST_SPLIT) return;
        if (this.suspect) return this.#answer(this.told >= 0 && this.gap > CONST_WORSE ? this.told : -1, SENSOR, -1);
        if (this.push > CONST_PUSHED && !(this.behind > CONST_LOST * trackingBound[i])) return this.#answer(-1, CONTACT, -1);
        if (this.count < CONST_LAST) return this.#answer(i, UNKNOWN, -1);
        const travel = this.highest - this.lowest, wanted = this.wantedHigh - this.wantedLow;
        const still = travel < CONST_STILL && travel < CONST_PART * wanted + CONST_NOISE;
        if (!this.torques) return this.#answer(i, still ? LOCKED : UNKNOWN, -1);
        const {rr, rt, rs, tt, ss} = this, scale = CONST_SCALE * torqueBound[i], lightly = CONST_TIMES * coulomb[i];
        const loss = tt > 0 ? Math.min(Math.max(-rt / tt, 0), 1.3) : -1, drag = Math.max(0, -rs / Math.max(ss, 1e-12));
        const byLoss = tt > 0 ? rr + 2 * loss * rt + loss * loss * tt : Infinity, byDrag = rr + 2 * drag * rs + drag * drag * ss;
        const worse = (byDrag - byLoss) / (this.some * scale * scale);
        if (still && this.asked >= lightly) {
            if (loss > CONST_LEAST && loss < CONST_MOST && this.least < lightly) return this.#answer(i, STANDSTILL, loss);
            return this.#answer(i, LOCKED, -1);
        }
        if (!(tt > 0) || !(Math.min(byLoss, byDrag) < 0.5 * rr)) return this.#answer(i, UNKNOWN, -1);
        if (Math.abs(worse) < 1 && (drag <= CONST_GROWN * coulomb[i] || coulomb[i] === 0)) return this.#answer(i, SLUGGISH, loss);
        const follows = this.behind < trackingBound[i];
        const driven = coulomb[i] > 0 && rs + this.ts > CONST_DRIVEN * coulomb[i] * ss;
        if (worse < 0) return this.#answer(i, FRICTION, -1);
        if (follows && driven && loss > CONST_MORE) return this.#answer(-1, CONTACT, -1);
        if (loss > CONST_ALL || (loss > CONST_LEAST && this.behind > CONST_AWAY * trackingBound[i])) return this.#answer(i, LIMP, loss);
        return this.#answer(i, WEAK, loss);
    }
}
