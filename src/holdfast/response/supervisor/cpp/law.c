int NAME_law(const double q[COUNT], const double v[TASK_ROWS], const double mask[COUNT], double rates[COUNT]) {
    int k, fine = 1;
    for (k = 0; k < COUNT; ++k) fine = fine && q[k] - q[k] == 0;
    for (k = 0; k < TASK_ROWS; ++k) fine = fine && v[k] - v[k] == 0;
    if (fine) {
        double j[TASK_ROWS * COUNT], scaled[TASK_ROWS];
        seen(q, v, mask, j, scaled);
        inverse(j, scaled, rates);
        for (k = 0; k < COUNT; ++k) rates[k] *= mask[k];
        for (k = 0; k < COUNT; ++k) fine = fine && rates[k] - rates[k] == 0;
    }
    for (k = 0; k < COUNT && !fine; ++k) rates[k] = 0;
    return fine ? 0 : 1;
}
