const char *const NAME_joints[COUNT] = {JOINT_NAMES};

int NAME_check_joints(const char *const names[], int count) {
    int k, i;
    for (k = 0; k < COUNT; ++k) {
        if (k >= count || !names[k]) return k + 1;
        for (i = 0; names[k][i] && names[k][i] == NAME_joints[k][i]; ++i) {}
        if (names[k][i] != NAME_joints[k][i]) return k + 1;
    }
    return count > COUNT ? ABOVE_COUNT : 0;
}

SIGNATURE {
DECLARED_OUTPUTS    int fine = 1, k;
    for (k = 0; k < COUNT; ++k) fine = fine && q[k] - q[k] == 0;
    for (k = 0; k < TASK_ROWS; ++k) fine = fine && v[k] - v[k] == 0;
    if (fine) {
        computed(q, v, ALL_OUTPUTS);
        for (k = 0; k < COUNT; ++k) fine = fine && rates[k] - rates[k] == 0;
    }
    for (k = 0; k < COUNT && !fine; ++k) rates[k] = 0;
COPIED_OUTPUTS    return fine ? 0 : 1;
}
