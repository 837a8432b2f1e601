/*
 * The damping that makes the worst single locked joint least bad, as holdfast/control/laws/damping_search.py has it: the same search,
 * in loops, which end where there is nothing left to do. J: ROWS rows of JOINTS columns; u: direction of norm 1.
 */
enum { ROWS = CONST_ROWS, JOINTS = CONST_JOINTS, WIDE = CONST_WIDE, PAIRS = CONST_NUMBER_OF_PAIRS };
enum { CELLS = CONST_CELLS };

static const unsigned char pairs[PAIRS][2] = {CONST_PAIRS};

/* WIDE: columns of 0 fill up to a multiple of 4, which processors take together. */
typedef struct {
    double squares[ROWS], c[ROWS], rows[ROWS][WIDE], columns[WIDE], missing;
} search;

/* A point of the squared damping, the squared peak error there and its slope. */
typedef struct {
    double s, value, slope;
} point;

static double larger(double a, double b) {
    return a > b ? a : b;
}

static double product(const double *a, const double *b) {
    double sum[4];
    int k;
    for (k = 0; k < 4; ++k) sum[k] = CONST_PRODUCTS;
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

static void rotate(double *restrict one, double *restrict other, double cosine, double sine) {
    int i;
    for (i = 0; i < WIDE; ++i) {
        double p = one[i], q = other[i];
        one[i] = cosine * p - sine * q;
        other[i] = sine * p + cosine * q;
    }
}

/* One-sided Jacobi rotations: rows become orthogonal. */
static void orthogonal(search *f) {
    int sweep, k, turned = 1;
    for (sweep = 0; sweep < CONST_SWEEPS && turned; ++sweep) {
        for (k = 0; k < ROWS; ++k) f->squares[k] = product(f->rows[k], f->rows[k]);
        for (turned = k = 0; k < PAIRS; ++k) {
            int one = pairs[k][0], other = pairs[k][1];
            double g = product(f->rows[one], f->rows[other]), a = f->squares[one], b = f->squares[other];
            if (g * g > CONST_ORTHOGONAL * CONST_ORTHOGONAL * a * b) {
                double difference = b - a, root = fabs(difference) + sqrt(difference * difference + 4 * g * g);
                double size = 1 / sqrt(root * root + 4 * g * g), cosine = root * size, sine = copysign(2, difference) * g * size;
                double x = f->c[one], moved = 2 * g * g / copysign(root, difference);
                f->c[one] = cosine * x - sine * f->c[other];
                f->c[other] = sine * x + cosine * f->c[other];
                f->squares[one] -= moved;
                f->squares[other] += moved;
                rotate(f->rows[one], f->rows[other], cosine, sine);
                turned |= g * g > CONST_CONVERGED * CONST_CONVERGED * a * b;
            }
        }
    }
    for (k = 0; k < ROWS; ++k) f->squares[k] = product(f->rows[k], f->rows[k]);
}

static point at(const search *restrict f, double s) {
    double r[ROWS], squares[ROWS], a[WIDE], sizes[WIDE];
    point out;
    int i, k, worst = 0;
    for (k = 0; k < ROWS; ++k) r[k] = 1 / (f->squares[k] + s);
    for (k = 0; k < ROWS; ++k) squares[k] = f->c[k] * r[k] * (f->c[k] * r[k]);
    for (i = 0; i < WIDE; ++i) a[i] = CONST_RATE;
    for (i = 0; i < WIDE; ++i) sizes[i] = a[i] * a[i] * (s + s + f->columns[i]);
    for (i = 1; i < JOINTS; ++i) worst = sizes[i] > sizes[worst] ? i : worst;
    out.s = s;
    out.value = f->missing + s * s * (CONST_HEALTHY) + sizes[worst];
    out.slope = 2 * s * (CONST_TURNING) + 2 * a[worst] * (a[worst] - (CONST_STEEP) * (s + s + f->columns[worst]));
    return out;
}

/* S at which the squared error of the healthy arm is `room`. */
static double largest_of(const search *f, double room) {
    double parts[ROWS], total = 0, low = -HUGE_VAL, high = HUGE_VAL, goal = 1 / sqrt(room), t;
    int k, i, step;
    for (k = 0; k < ROWS; ++k) total += parts[k] = f->c[k] * f->c[k];
    for (k = 0; k < ROWS; ++k) {
        double below = 0, upto = 0, most;
        for (i = 0; i < ROWS; ++i) {
            below += f->squares[i] < f->squares[k] ? parts[i] : 0;
            upto += f->squares[i] <= f->squares[k] ? parts[i] : 0;
        }
        low = larger((sqrt(upto / room) - 1) / f->squares[k], low);
        if (room > below) {
            most = (sqrt((total - below) / (room - below)) - 1) / f->squares[k];
            high = most < high ? most : high;
        }
    }
    for (step = 0; step < CONST_BISECTIONS && high > 1.2 * low; ++step) {
        double middle = sqrt(low * high), error = 0;
        for (k = 0; k < ROWS; ++k) {
            double d = 1 / (1 + middle * f->squares[k]);
            error += parts[k] * d * d;
        }
        low = error > room ? middle : low;
        high = error > room ? high : middle;
    }
    for (t = low, step = 0; step < CONST_NEWTON; ++step) {
        double error = 0, steep = 0, size, change;
        for (k = 0; k < ROWS; ++k) {
            double d = 1 / (1 + t * f->squares[k]), term = parts[k] * d * d;
            error += term;
            steep += term * d * f->squares[k];
        }
        size = sqrt(error);
        change = (goal - 1 / size) * size * error / steep;
        t += change;
        if (fabs(change) < 1e-15 * t) break;
    }
    return 1 / t;
}

/* How far beyond a the tangents at a and b meet. */
static double meet(point a, point b) {
    return (a.value - b.value + b.slope * (b.s - a.s)) / (b.slope - a.slope);
}

static point refined(const search *f, point a, point b, point best) {
    point x = best;
    int round;
    for (round = 1; round <= CONST_REFINED; ++round) {
        double edge = round < CONST_REFINED ? CONST_EDGE : 0, width = b.s - a.s, bend = b.slope - a.slope;
        double there = meet(a, b), flat = -a.slope * width / bend, step;
        step = fabs(there - width / 2.0) < CONST_SMOOTH * width || bend * width < CONST_ROUGH * a.value ? flat : there;
        step = larger(step, edge * width);
        x = at(f, a.s + (step < (1 - edge) * width ? step : (1 - edge) * width));
        if (x.value < best.value) best = x;
        if (x.slope > 0)
            b = x;
        else
            a = x;
    }
    return x.value <= best.value * (1 + CONST_SAME) ? x : best;
}

static double least(const search *f, double end) {
    point points[CELLS + 1], best;
    double estimates[CELLS], smallest = f->squares[0], first, ratio, power = 1, cells = CELLS;
    int k, number;
    for (k = 1; k < ROWS; ++k) smallest = f->squares[k] < smallest ? f->squares[k] : smallest;
    first = larger(CONST_FIRST * smallest, 1e-12 * end);
    first = first < end / 3.0 ? first : end / 3.0;
    ratio = exp(log(1 + end / first) / cells);
    for (k = 0; k <= CELLS; ++k) {
        points[k] = at(f, k < CELLS ? first * (power - 1) : end);
        power *= ratio;
    }
    best = points[0];
    for (k = 0; k <= CELLS; ++k) best = points[k].value < best.value ? points[k] : best;
    for (k = 0; k < CELLS; ++k) {
        const point a = points[k], b = points[k + 1];
        estimates[k] = a.slope < 0 && b.slope > 0 ? a.value + a.slope * meet(a, b) : HUGE_VAL;
    }
    for (number = 0; number < CONST_KEPT; ++number) {
        int lowest = 0;
        for (k = 1; k < CELLS; ++k) lowest = estimates[k] < estimates[lowest] ? k : lowest;
        if (estimates[lowest] == HUGE_VAL) break;
        best = refined(f, points[lowest], points[lowest + 1], best);
        estimates[lowest] = HUGE_VAL;
    }
    return best.s;
}

static void damped_inverse(const double *j, const double *v, double *rates, double *damping, double *largest, double *feasible) {
    search f = {{0}, {0}, {{0}}, {0}, 0};
    double a[WIDE] = {0}, size = 0, top = 0, room, s, end;
    int i, k;
    for (k = 0; k < ROWS; ++k) size += v[k] * v[k];
    size = sqrt(size);
    for (k = 0; k < ROWS; ++k) {
        f.c[k] = size > 0 ? v[k] / size : k == 0;
        for (i = 0; i < JOINTS; ++i) {
            f.rows[k][i] = j[k * JOINTS + i];
            f.columns[i] += f.rows[k][i] * f.rows[k][i];
        }
    }
    orthogonal(&f);
    for (k = 0; k < ROWS; ++k) top = larger(f.squares[k], top);
    for (k = 0; k < ROWS; ++k) {
        if (f.squares[k] <= CONST_SINGULAR * CONST_SINGULAR * top) { /* what a singular J cannot produce is error whatever the damping */
            f.missing += f.c[k] * f.c[k];
            f.c[k] = 0;
            f.squares[k] = top > 0 ? top : 1;
        }
        for (i = 0; i < WIDE; ++i) f.rows[k][i] *= f.c[k];
    }
    room = CONST_ALLOWED * CONST_ALLOWED - f.missing;
    end = room > 0 ? largest_of(&f, room) : CONST_FLOOR * CONST_FLOOR;
    s = room > 0 ? least(&f, end) : CONST_FLOOR * CONST_FLOOR;
    for (k = 0; k < ROWS; ++k)
        for (i = 0; i < WIDE; ++i) a[i] += f.rows[k][i] * (1 / (f.squares[k] + s));
    for (i = 0; i < JOINTS; ++i) rates[i] = size * a[i];
    *damping = size > 0 ? sqrt(s) : 0;
    *largest = size > 0 ? sqrt(end) : 0;
    *feasible = size > 0 ? room > 0 : 1;
}
