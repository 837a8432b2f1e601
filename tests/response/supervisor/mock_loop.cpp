// The controller around an arm without dynamics. By the clock: joint k is locked in the k-th arm, none in the last, until every lock
// is found. Or cycle by cycle, with states from standard input. Allocations while a controller updates are counted.
#include "controller.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <random>
#include <thread>
#include <vector>

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete" // it looks into these, and takes them for strangers
#endif
static bool counting = false;
static long allocations = 0;
void *operator new(std::size_t size) {
    allocations += counting;
    if (void *place = std::malloc(size)) return place;
    throw std::bad_alloc();
}
void operator delete(void *place) noexcept { std::free(place); }
void operator delete(void *place, std::size_t) noexcept { std::free(place); }

using namespace controller;

struct Arm {
    Joints q{}, told{}, v{}, command{}, effort{};
    TolerantController brain;
    explicit Arm(const Joints &start, const Options &options) : q(start), told(start), brain(options) {
        std::array<const double *, joints> position{}, torque{};
        std::array<double *, joints> velocity{};
        for (int k = 0; k < joints; ++k) position[k] = &told[k], torque[k] = &effort[k], velocity[k] = &command[k];
        if (brain.on_activate() != Return::error || brain.on_configure() != Return::ok) std::exit(2);
        brain.assign(position, &torque, velocity);
        if (brain.on_activate() != Return::ok) std::exit(2);
    }
    void update(double time, double period) {
        counting = true;
        if (brain.update_and_write_commands(time, period) != Return::ok) std::exit(2);
        counting = false;
    }
};

static int by_the_clock(double seconds, const Joints &home) {
    using clock = std::chrono::steady_clock;
    Options options;
    options.efforts = false;
    std::vector<std::unique_ptr<Arm>> arms;
    for (int k = 0; k <= joints; ++k) arms.emplace_back(new Arm(home, options));
    std::mt19937_64 generator(7);
    std::normal_distribution<double> noise(0, 2e-5);
    const auto cycle = std::chrono::duration_cast<clock::duration>(std::chrono::duration<double>(1 / rate));
    auto next = clock::now(), last = next;
    int found = 0;
    for (double t = 0; t < seconds && (t < 1 || found < joints);) {
        std::this_thread::sleep_until(next += cycle);
        const auto now = clock::now();
        const double period = std::chrono::duration<double>(now - last).count();
        last = now;
        t += period;
        for (int i = 0; i <= joints; ++i) {
            Arm &arm = *arms[i];
            for (int k = 0; k < joints; ++k) {
                const bool stands = i == k && t > 0.3;
                arm.q[k] += stands ? 0 : period * arm.v[k];
                arm.v[k] = stands ? 0 : arm.command[k] + (arm.v[k] - arm.command[k]) * std::exp(-period / 0.016);
                arm.told[k] = arm.q[k] + noise(generator);
            }
            for (int k = 0; k < 6; ++k) arm.brain.references()[k] = (k < 3 ? 0.05 : 0.1) * std::sin((2 + k) * t + k);
            arm.update(t, period);
        }
        found = 0;
        for (const auto &arm : arms) found += arm->brain.status().joint >= 0;
    }
    for (const auto &arm : arms) {
        const Status &status = arm->brain.status();
        std::printf("%d %d %s %ld %ld\n", status.verdict.alarm, status.joint, name_of(status.mode), status.cycles, status.coasted);
    }
    std::printf("%ld\n", allocations);
    return 0;
}

// In: period, told, effort, twist, whether there is a pose and that. Out: mode, joint, watching, time, its place, rates, reference,
// brake.
static int step_by_step(const Joints &home, const Options &options) {
    double in[1 + 2 * joints + 6 + 17], out[5 + 3 * joints];
    Arm arm(home, options);
    while (std::fread(in, sizeof *in, 24 + 2 * joints, stdin) == 24 + 2 * joints) {
        for (int k = 0; k < joints; ++k) arm.told[k] = in[1 + k], arm.effort[k] = in[1 + joints + k];
        for (int k = 0; k < 6; ++k) arm.brain.references()[k] = in[1 + 2 * joints + k];
        if (in[7 + 2 * joints] > 0) arm.brain.see(in + 8 + 2 * joints);
        if (std::isinf(in[0])) arm.brain.on_deactivate();
        else arm.update(0, in[0]);
        const Status &status = arm.brain.status();
        out[0] = static_cast<double>(status.mode), out[1] = status.joint, out[2] = status.watching, out[3] = status.time;
        out[4] = status.joint < 0 ? not_known : status.place[status.joint];
        for (int k = 0; k < joints; ++k) {
            out[5 + k] = arm.command[k], out[5 + joints + k] = status.reference[k], out[5 + 2 * joints + k] = status.brake[k];
        }
        std::fwrite(out, sizeof *out, 5 + 3 * joints, stdout);
        std::fflush(stdout);
    }
    return allocations ? 1 : 0;
}

// mock_loop q_1 ... q_n MOST_SECONDS, or mock_loop q_1 ... q_n step BRAKES
int main(int count, char **words) {
    Joints home{};
    if (count < joints + 2) return 2;
    for (int k = 0; k < joints; ++k) home[k] = std::atof(words[1 + k]);
    if (count == joints + 2) return by_the_clock(std::atof(words[joints + 1]), home);
    Options options;
    options.brakes = words[joints + 2][0] == '1';
    return step_by_step(home, options);
}
