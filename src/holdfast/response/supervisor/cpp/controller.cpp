#include "NAME.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "NAME_law.h"

namespace NAME {

namespace {

CONST_ARRAYS
constexpr double task[TASK_ROWS][6] = TASK_TEXT;

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double at_once_after = CONST_AT_ONCE, named_after = CONST_NAMED; /* s after the alarm */
constexpr long known_after = CONST_KNOWN; /* cycles after the alarm: the kind is decided */
constexpr double final_after = CONST_FINAL; /* s after the alarm: before this, a verdict may be revised */
constexpr double still = CONST_STILL, runs = CONST_RUNS, faster = CONST_FASTER; /* rad/s or m/s */
constexpr double behind_bounds = CONST_BEHIND, far_bounds = CONST_FAR; /* of the tracking threshold */
constexpr double slow_pace = CONST_SLOW, half_pace = CONST_HALF, ramp = CONST_RAMP; /* of the commanded speed; 1/s */
constexpr double quiet_for = CONST_QUIET, settle = CONST_SETTLED; /* s */
constexpr double spare = CONST_SPARE; /* times gravity that a weak motor must be able to carry */
constexpr double slack = CONST_SLACK, near = CONST_NEAR; /* rad or m */
constexpr int poses = CONST_SAMPLES;
constexpr double poses_later = CONST_LATER; /* s */
constexpr double leak = CONST_LEAK; /* 1/s: rate servos do not hold a position, so the reference forgets its start value */
constexpr double off_period = 0.5; /* of a cycle: beyond this deviation of the period, the monitor skips the cycle */

bool finite(double x) { return x - x == 0; }

} /* namespace */

const char *name_of(Mode mode) {
    static const char *const names[] = {"inactive", "running", "slowed", "degraded", "stopped"};
    return names[static_cast<int>(mode)];
}

TolerantController::TolerantController(const Options &options) : options_(options) {}

std::vector<std::string> TolerantController::command_interface_configuration() const {
    std::vector<std::string> names;
    for (const char *joint : NAME_monitor_joints) names.push_back(std::string(joint) + "/velocity");
    return names;
}

std::vector<std::string> TolerantController::state_interface_configuration() const {
    std::vector<std::string> names;
    for (const char *joint : NAME_monitor_joints) names.push_back(std::string(joint) + "/position");
    if (options_.efforts)
        for (const char *joint : NAME_monitor_joints) names.push_back(std::string(joint) + "/effort");
    return names;
}

std::vector<std::string> TolerantController::reference_interface_configuration() const {
    return {"twist/linear.x", "twist/linear.y", "twist/linear.z", "twist/angular.x", "twist/angular.y", "twist/angular.z"};
}

Return TolerantController::on_configure() {
    configured_ = options_.acceleration > 0 && finite(options_.acceleration);
    return configured_ ? Return::ok : Return::error;
}

void TolerantController::assign(const std::array<const double *, joints> &position,
                                const std::array<const double *, joints> *effort,
                                const std::array<double *, joints> &velocity) {
    position_ = position;
    with_effort_ = effort != nullptr && options_.efforts;
    if (with_effort_) effort_ = *effort;
    velocity_ = velocity;
    assigned_ = true;
}

Return TolerantController::on_activate() {
    Joints q{}, effort{};
    if (!configured_ || !assigned_ || !read(q, effort)) return Return::error;
    const long changes = status_.changes;
    status_ = Status{};
    status_.changes = changes;
    status_.reference = q;
    NAME_monitor_init(&monitor_);
    mask_.fill(1);
    commanded_.fill(0);
    twist_.fill(0);
    status_.place.fill(not_known);
    posed_ = seen_ = over_ = lost_ = false;
    elapsed_ = 1 / rate; /* the first cycle counts as one period */
    pace_ = place_ = error_ = 0;
    aim_ = usual_ = 1;
    alarm_ = quiet_ = settled_ = never;
    samples_ = 0;
    named_ = -1;
    active_ = true;
    become(Mode::running, "no fault detected");
    return Return::ok;
}

Return TolerantController::on_deactivate() {
    if (assigned_) write(Joints{});
    active_ = false;
    become(Mode::inactive, "not active");
    return Return::ok;
}

void TolerantController::see(const double pose[16]) {
    std::copy(pose, pose + 16, pose_.begin());
    posed_ = seen_ = true;
}

Return TolerantController::update_and_write_commands(double /*time*/, double period) {
    if (!active_) return Return::error;
    Joints q{}, effort{};
    const double passed = finite(period) && period > 0 ? period : 0;
    status_.cycles += 1;
    status_.time += passed;
    status_.watching = false;
    if (!read(q, effort)) {
        /* The configuration is unknown. When positions are back, the arm continues from standstill. */
        commanded_.fill(0);
        pace_ = 0;
        elapsed_ += passed;
        posed_ = false;
        lost_ = true;
        status_.coasted += 1;
        become(Mode::stopped, "a position is not a number");
        write(commanded_);
        return Return::ok;
    }
    const Joints told = q;
    for (int k = 0; k < joints; ++k)
        if (finite(status_.place[k])) q[k] = status_.place[k];
    /* The last command has been in force since the last cycle. */
    for (int k = 0; k < joints; ++k) {
        double &reference = status_.reference[k];
        reference = mask_[k] > 0 && !lost_ ? reference + passed * (commanded_[k] + leak * (q[k] - reference)) : q[k];
    }
    if (lost_) {
        lost_ = false;
        if (over_) become(Mode::stopped, "a joint failed, and then a position was not a number");
        else if (status_.joint >= 0) become(Mode::degraded, "positions are back");
        else become(aim_ < 1 ? Mode::slowed : Mode::running, "positions are back");
    }
    if (posed_ && waits()) measure(q, told);
    watch(q, effort, passed);
    command(q, passed);
    write(commanded_);
    return Return::ok;
}

/* ---- monitoring ----------------------------------------------------------------------------------------------------- */

void TolerantController::become(Mode mode, const char *why) {
    if (status_.mode == mode && status_.why == why) return;
    status_.mode = mode;
    status_.why = why;
    status_.changes += 1;
}

bool TolerantController::read(Joints &q, Joints &effort) const {
    bool fine = true;
    for (int k = 0; k < joints; ++k) {
        q[k] = *position_[k];
        effort[k] = with_effort_ ? *effort_[k] : 0;
        fine = fine && finite(q[k]);
    }
    return fine;
}

void TolerantController::watch(const Joints &q, const Joints &effort, double period) {
    const bool posed = posed_, late = std::fabs(period * rate - 1) > off_period;
    posed_ = false;
    elapsed_ += period;
    if (over_ || waits()) return;
    if (named_ >= 0 && mask_[named_] == 0) go_on();
    if (late || elapsed_ * rate < off_period) {
        status_.coasted += 1;
        return;
    }
    const long cycles = std::lround(elapsed_ * rate);
    if (cycles > 1) NAME_monitor_skip(&monitor_, cycles - 1);
    elapsed_ = 0;
    status_.watching = true;
    NAME_monitor_verdict verdict{};
    NAME_monitor_step(&monitor_, q.data(), status_.reference.data(), with_effort_ ? effort.data() : nullptr,
                      posed ? pose_.data() : nullptr, &verdict);
    if (verdict.alarm) status_.verdict = verdict;
    if (options_.reacts) hear(q, verdict);
}

/* ---- response ------------------------------------------------------------------------------------------------------- */

void TolerantController::hear(const Joints &q, const NAME_monitor_verdict &verdict) {
    const double time = status_.time;
    if (time > quiet_) {
        go_on();
        become(status_.joint < 0 ? Mode::running : Mode::degraded, "the external force is gone");
        return;
    }
    if (!verdict.alarm) return;
    if (alarm_ == never) alarm_ = time;
    if (verdict.joint < 0) {
        if (verdict.kind == GUARD_MONITOR_CONTACT) {
            if (quiet_ == never) {
                quiet_ = time + quiet_for;
                slow(slow_pace, "an external force acts on the arm, and no joint is faulty");
            }
        } else if (time > alarm_ + named_after) {
            stop("a joint failed, and it is not known which one");
        }
        return;
    }
    const int i = verdict.joint;
    switch (verdict.kind) {
    case GUARD_MONITOR_WEAK:
    case GUARD_MONITOR_FRICTION:
    case GUARD_MONITOR_SLUGGISH:
        if (named_ == i) {
            if (time > alarm_ + final_after) go_on();
        } else if (verdict.loss >= 0 && (1 - verdict.loss) * largest_effort[i] < spare * std::fabs(monitor_.gravity[i])) {
            leave_out(i, "the remaining motor torque of a joint does not carry the arm");
        } else {
            named_ = i;
            slow(std::min(usual_, half_pace), "a joint has a partial torque loss or more friction");
        }
        break;
    case GUARD_MONITOR_LOCKED:
        leave_out(i, "a joint is locked");
        break;
    case GUARD_MONITOR_SENSOR:
        leave_out(i, "the sensor of a joint is faulty, or its clutch slips");
        break;
    case GUARD_MONITOR_LIMP:
    case GUARD_MONITOR_STANDSTILL:
        if (options_.brakes) leave_out(i, "a joint is free-swinging or locked");
        else stop("a joint may be free-swinging, and there is no brake");
        break;
    default:
        if (monitor_.count >= known_after && !options_.brakes)
            stop("a joint has a fault of an unknown kind, and there is no brake");
        else if (monitor_.count >= known_after && monitor_.torques)
            leave_out(i, "a joint has a fault of an unknown kind");
        else if (time >= alarm_ + at_once_after) at_once(i, q);
    }
}

void TolerantController::at_once(int i, const Joints &q) {
    const double behind = status_.reference[i] - q[i], y = std::fabs(behind) / tracking_bound[i], v = monitor_.v[i];
    const double runs_off = behind * v < 0 ? behind_bounds : far_bounds;
    if (options_.brakes && std::fabs(v) < still && y > behind_bounds) leave_out(i, "a joint does not move");
    else if (options_.brakes && y > runs_off && std::fabs(v - commanded_[i]) > faster && std::fabs(v) > runs)
        leave_out(i, "a joint runs away");
    else if (aim_ > slow_pace)
        slow(slow_pace, "a joint failed, and the kind of fault is not known yet");
}

void TolerantController::slow(double pace, const char *why) {
    aim_ = pace;
    become(status_.joint < 0 ? Mode::slowed : Mode::degraded, why);
}

void TolerantController::stop(const char *why) {
    over_ = true;
    aim_ = 0;
    become(Mode::stopped, why);
}

void TolerantController::leave_out(int i, const char *why) {
    mask_[i] = 0;
    status_.joint = i;
    status_.brake[i] = true;
    named_ = i;
    aim_ = usual_;
    samples_ = 0;
    place_ = error_ = 0;
    /* Wait until the tool poses determine the position of that joint. */
    settled_ = status_.time + settle + (seen_ ? poses / 100.0 : 0);
    become(Mode::degraded, why);
}

bool TolerantController::waits() const {
    const double later = samples_ > 0 && samples_ < poses ? poses_later : 0;
    return settled_ != never && status_.time <= settled_ + later;
}

/* Continue monitoring without the isolated joint, at the pace that the failures allow. */
void TolerantController::go_on() {
    if (named_ < 0) NAME_monitor_rearm(&monitor_);
    else {
        NAME_monitor_leave_out(&monitor_, named_);
        if (mask_[named_] > 0) usual_ = std::min(usual_, half_pace);
    }
    elapsed_ = std::min(elapsed_, 1 / rate); /* the monitor restarts, so no cycle was skipped */
    aim_ = usual_;
    alarm_ = quiet_ = never;
    named_ = -1;
}

void TolerantController::measure(const Joints &q, const Joints &told) {
    if (samples_ == poses || status_.time <= settled_ - poses / 100.0) return;
    const int i = status_.joint;
    const double place = NAME_monitor_joint_by_tool(q.data(), pose_.data(), i);
    place_ += place / poses; /* the joint is at rest, independently of its sensor */
    error_ += (place - told[i]) / poses;
    samples_ += 1;
    if (samples_ == poses && std::fabs(error_) > slack) {
        status_.place[i] = place_;
        become(Mode::degraded, "the tool pose contradicts the sensor of a joint");
    }
}

void TolerantController::command(const Joints &q, double period) {
    const double dt = std::min(period, 2 / rate); /* after a stall the rates do not jump */
    Joints follow = mask_, wanted{};
    std::array<double, TASK_ROWS> v{};
    if (waits()) pace_ = 0;
    else pace_ += std::min(std::max(aim_ - pace_, -ramp * dt), ramp * dt);
    for (int r = 0; r < TASK_ROWS; ++r)
        for (int c = 0; c < 6; ++c) v[r] += task[r][c] * (finite(twist_[c]) ? twist_[c] : 0);
    /* A joint at its limit is not commanded beyond it; the other joints take over. */
    for (int tries = 0, again = 1; again && tries <= joints; ++tries) {
        again = 0;
        if (NAME_law(q.data(), v.data(), follow.data(), wanted.data())) break;
        for (int k = 0; k < joints; ++k)
            if ((q[k] <= lower[k] + near && wanted[k] < 0) || (q[k] >= upper[k] - near && wanted[k] > 0)) {
                follow[k] = 0;
                again = 1;
            }
    }
    double over = 1;
    for (int k = 0; k < joints; ++k) {
        const double most = status_.joint < 0 ? largest_rate[k] : calibrated_rate[k]; /* faster motion would raise false alarms */
        over = std::max(over, std::fabs(pace_ * wanted[k]) / most);
    }
    for (int k = 0; k < joints; ++k) {
        const double change = options_.acceleration * dt;
        const double low = -std::sqrt(2 * options_.acceleration * std::max(q[k] - lower[k], 0.0));
        const double high = std::sqrt(2 * options_.acceleration * std::max(upper[k] - q[k], 0.0));
        const double rates = std::min(std::max(pace_ * wanted[k] / over, low), high);
        commanded_[k] = mask_[k] * std::min(std::max(rates, commanded_[k] - change), commanded_[k] + change);
    }
}

void TolerantController::write(const Joints &rates) {
    for (int k = 0; k < joints; ++k) *velocity_[k] = rates[k];
}

} /* namespace NAME */
