/*
 * A real-time loop of NAME::TolerantController with a kinematic arm: the joints follow their rates with a lag of 16 ms, the
 * sensors have noise, and joint LOCK (from 1; 0: none) stops after 0.5 s.
 * cc -std=c99 -c NAME_law.c NAME_monitor.c && c++ -std=c++17 NAME_example.cpp NAME.cpp NAME_law.o NAME_monitor.o -o NAME_example
 * ./NAME_example LOCK [SECONDS [RECORD.csv]]     the CSV file is a log for 'holdfast calibrate' and 'holdfast diagnose'
 */
#include "NAME.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>

int main(int count, char **words) {
    using clock = std::chrono::steady_clock;
    const int lock = count > 1 ? std::atoi(words[1]) : 0;
    const double seconds = count > 2 ? std::atof(words[2]) : 2.0;
    std::FILE *record = count > 3 ? std::fopen(words[3], "w") : nullptr;
    NAME::Joints q = {{HOME}}, told = q, v{}, command{};
    std::mt19937_64 generator(1);
    std::normal_distribution<double> noise(0, 2e-5); /* rad or m */
    std::array<const double *, NAME::joints> position{};
    std::array<double *, NAME::joints> velocity{};
    for (int k = 0; k < NAME::joints; ++k) position[k] = &told[k], velocity[k] = &command[k];
    NAME::Options options;
    options.efforts = false; /* this arm has no torques */
    options.reacts = record == nullptr; /* old thresholds must not influence a log for calibration */
    NAME::TolerantController controller(options);
    if (controller.on_configure() != NAME::Return::ok) return 2;
    controller.assign(position, nullptr, velocity);
    if (controller.on_activate() != NAME::Return::ok) return 2;
    if (record) {
        std::fputs("t", record);
        for (int k = 0; k < 2 * NAME::joints; ++k) std::fprintf(record, ",%s_%d", k < NAME::joints ? "q_ref" : "q", k % NAME::joints + 1);
        std::fputs("\n", record);
    }
    const auto cycle = std::chrono::duration_cast<clock::duration>(std::chrono::duration<double>(1 / NAME::rate));
    auto next = clock::now(), last = next;
    long changes = controller.status().changes;
    for (double t = 0; t < seconds;) {
        std::this_thread::sleep_until(next += cycle);
        const auto now = clock::now();
        const double period = std::chrono::duration<double>(now - last).count();
        last = now;
        t += period;
        for (int k = 0; k < NAME::joints; ++k) {
            const bool stands = k + 1 == lock && t > 0.5;
            q[k] += stands ? 0 : period * v[k];
            v[k] = stands ? 0 : command[k] + (v[k] - command[k]) * std::exp(-period / 0.016);
            told[k] = q[k] + noise(generator);
        }
        for (int k = 0; k < 6; ++k) controller.references()[k] = (k < 3 ? 0.05 : 0.1) * std::sin((2 + k) * t + k);
        controller.update_and_write_commands(t, period);
        const NAME::Status &status = controller.status();
        if (status.changes != changes) std::printf("%.3f s: %s, %s\n", t, NAME::name_of(status.mode), status.why);
        changes = status.changes;
        if (record) {
            std::fprintf(record, "%.9f", t);
            for (double x : status.reference) std::fprintf(record, ",%.9g", x);
            for (double x : told) std::fprintf(record, ",%.9g", x);
            std::fputs("\n", record);
        }
    }
    if (record) std::fclose(record);
    const NAME::Status &status = controller.status();
    if (!status.verdict.alarm) std::puts("no fault detected, which does not prove that there is none");
    else std::puts(status.joint < 0 ? "an alarm, and no joint was excluded" : NAME_monitor_joints[status.joint]);
    std::printf("%ld cycles, %ld of them off in time\n", status.cycles, status.coasted);
    return status.verdict.alarm ? 3 : 0;
}
