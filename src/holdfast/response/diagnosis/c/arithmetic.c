static double larger(double a, double b) { return a > b ? a : b; }
static double smaller(double a, double b) { return a < b ? a : b; }

static int finite_all(const double *x, int count) {
    int k;
    for (k = 0; k < count; ++k)
        if (!(x[k] - x[k] == 0)) return 0;
    return 1;
}

/* Rotation vector of a rotation, row by row, by the longest row of 4 q q' of its quaternion q. */
static void rotation_vector(const double r[9], double out[3]) {
    double o[4][4], q[4], size = 0, half, factor, trace = r[0] + r[4] + r[8];
    int i, j, best = 0;
    for (i = 0; i < 3; ++i)
        for (j = 0; j < 3; ++j) o[i][j] = i == j ? 1 + 2 * r[4 * i] - trace : r[3 * i + j] + r[3 * j + i];
    o[3][3] = 1 + trace;
    o[3][0] = o[0][3] = r[7] - r[5];
    o[3][1] = o[1][3] = r[2] - r[6];
    o[3][2] = o[2][3] = r[3] - r[1];
    for (i = 1; i < 4; ++i)
        if (o[i][i] > o[best][best]) best = i;
    for (i = 0; i < 4; ++i) size += o[best][i] * o[best][i];
    for (i = 0; i < 4; ++i) q[i] = o[best][i] / sqrt(size) * (o[best][3] < 0 ? -1 : 1);
    half = atan2(sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), q[3]);
    factor = half > 1e-12 ? 2 * half / sin(half) : 2;
    for (i = 0; i < 3; ++i) out[i] = q[i] * factor;
}
