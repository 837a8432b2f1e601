#ifndef GUARD_HPP
#define GUARD_HPP

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "NAME_monitor.h"

namespace NAME {

constexpr int joints = COUNT;
constexpr double rate = GUARD_MONITOR_RATE; /* cycles per second that the monitor was calibrated for */

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

using Joints = std::array<double, joints>;

enum class Return { ok, error };

/* stopped: all rates are 0, or on their way there. degraded: joints are left out of the law, also while what is left is slowed. */
enum class Mode { inactive, running, slowed, degraded, stopped };

const char *name_of(Mode mode);

struct Options {
    /* Whether it acts on what the monitor says; else it only tells, as while you record a healthy arm. */
    bool reacts = true;
    /* Whether something stops a joint whose motor gives no torque (Status::brake asks for it). Without brakes the arm stops for
       every fault but one of a joint that is locked for sure, or of its sensor. */
    bool brakes = true;
    /* A joint's torque that says something (Options of a robot whose drives hide it: false). */
    bool efforts = true;
    /* Largest change of a commanded rate, rad/s^2 and m/s^2; bounds hold for the motion that they were calibrated with. */
    double acceleration = 10.0;
};

/* What is known now. Read it after update_and_write_commands, and hand it on when `changes` has grown. */
struct Status {
    Mode mode = Mode::inactive;
    const char *why = "not active";
    long changes = 0;
    NAME_monitor_verdict verdict{}; /* of the last alarm; joint from 0, -1: none */
    int joint = -1;                 /* left out of the law last, from 0 */
    std::array<bool, joints> brake{}; /* all that are left out of the law */
    Joints place{};                 /* where these are by the tool's pose, rad or m, where a sensor is not believed; else not_known */
    bool watching = false;          /* the monitor saw this cycle */
    long cycles = 0, coasted = 0;   /* since it was activated; cycles that the monitor did not see, for its time was off */
    double time = 0;                /* s, since it was activated */
    Joints reference{};             /* where the joints should be: record it, with the measured values, to calibrate */
};

/*
 * Moves the tool as it is told, watches the arm for joint faults, and goes on with the joints that are left, which it watches on.
 *
 * Its life is that of a chainable controller of ROS 2, and it needs nothing of ROS: configure, lend it the interfaces, activate,
 * and call update_and_write_commands in every cycle, after the twist was written to references(). That call allocates nothing,
 * takes no lock, throws nothing, and returns ok also when a joint fails: an error would make a manager deactivate it, and the arm
 * would freeze. What is wrong is in status().
 */
class TolerantController {
public:
    explicit TolerantController(const Options &options = {});

    /* Names as the manager of ROS 2 wants them, in the order in which assign takes them. */
    std::vector<std::string> command_interface_configuration() const;   /* JOINT/velocity */
    std::vector<std::string> state_interface_configuration() const;     /* JOINT/position, then JOINT/effort if they are used */
    std::vector<std::string> reference_interface_configuration() const; /* twist/linear.x ... twist/angular.z */

    /* error: an option that is no number above 0. */
    Return on_configure();

    /* Where states are read and commands are written, rad, m, N m, N, rad/s, m/s; effort is null without torques. */
    void assign(const std::array<const double *, joints> &position, const std::array<const double *, joints> *effort,
                const std::array<double *, joints> &velocity);

    /* Forgets all faults. error: not configured, nothing assigned, or a position that is not a number. */
    Return on_activate();

    /* Commands zero rates. */
    Return on_deactivate();

    /* The twist that is wanted, m/s and rad/s, linear before angular, frame: TASK_FRAME; what is not a number counts as 0. */
    std::array<double, 6> &references() { return twist_; }

    /* The tool's measured pose, (4, 4) row by row, taken now: for the next cycle alone. Without poses a joint whose sensor is wrong
       cannot be told from one that is locked. */
    void see(const double pose[16]);

    /* time and period: s. */
    Return update_and_write_commands(double time, double period);

    const Status &status() const { return status_; }

private:
    void become(Mode mode, const char *why);
    bool read(Joints &q, Joints &effort) const;
    void watch(const Joints &q, const Joints &effort, double period);
    void hear(const Joints &q, const NAME_monitor_verdict &verdict);
    void at_once(int joint, const Joints &q);
    void slow(double pace, const char *why);
    void stop(const char *why);
    void leave_out(int joint, const char *why);
    void go_on();
    void measure(const Joints &q, const Joints &told);
    bool waits() const; /* until the tool's pose has told where the joint is that was left out */
    void command(const Joints &q, double period);
    void write(const Joints &rates);

    Options options_;
    Status status_;
    bool configured_ = false, assigned_ = false, active_ = false, with_effort_ = false;
    std::array<const double *, joints> position_{}, effort_{};
    std::array<double *, joints> velocity_{};
    std::array<double, 6> twist_{};
    std::array<double, 16> pose_{};
    bool posed_ = false, seen_ = false, over_ = false, lost_ = false;
    NAME_monitor_state monitor_{};
    Joints mask_{}, commanded_{};
    double elapsed_ = 0, pace_ = 0, aim_ = 1, usual_ = 1, alarm_ = 0, quiet_ = 0, settled_ = 0, place_ = 0, error_ = 0;
    int samples_ = 0, named_ = -1;
};

} /* namespace NAME */

#endif
