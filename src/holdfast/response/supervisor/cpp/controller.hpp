#ifndef GUARD_HPP
#define GUARD_HPP

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "NAME_monitor.h"

namespace NAME {

constexpr int joints = COUNT;
constexpr double rate = GUARD_MONITOR_RATE; /* cycles per second for which the monitor is calibrated */

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

using Joints = std::array<double, joints>;

enum class Return { ok, error };

/* stopped: all rates are 0 or decreasing to 0. degraded: joints are excluded from the law, also while the arm is slowed. */
enum class Mode { inactive, running, slowed, degraded, stopped };

const char *name_of(Mode mode);

struct Options {
    /* True to respond to the monitor; false to report only, for example while you record a healthy arm. */
    bool reacts = true;
    /* True if brakes can stop a joint without motor torque (Status::brake requests it). Without brakes the arm stops for every
       fault except a certainly locked joint or a faulty sensor. */
    bool brakes = true;
    /* False for a robot whose drives do not report joint torques. */
    bool efforts = true;
    /* Acceleration limit, rad/s^2 and m/s^2; the thresholds are valid for the calibrated kind of motion. */
    double acceleration = 10.0;
};

/* Present status. Read it after update_and_write_commands, and publish it when `changes` has increased. */
struct Status {
    Mode mode = Mode::inactive;
    const char *why = "not active";
    long changes = 0;
    NAME_monitor_verdict verdict{}; /* of the last alarm; joint from 0, -1: none */
    int joint = -1;                 /* joint that was excluded last, from 0 */
    std::array<bool, joints> brake{}; /* all joints that are excluded from the law */
    Joints place{};                 /* their positions by the tool pose, rad or m, if a sensor is not trusted; else not_known */
    bool watching = false;          /* true if the monitor processed this cycle */
    long cycles = 0, coasted = 0;   /* cycles since activation, and those that the monitor skipped because of their period */
    double time = 0;                /* time since activation, s */
    Joints reference{};             /* references of the joints; record them with the measured positions to calibrate */
};

/*
 * Moves the tool by a commanded twist, monitors the arm for joint faults, and continues with the remaining joints, which it
 * keeps monitoring.
 *
 * Its life cycle is that of a chainable controller of ROS 2, but it does not need ROS: configure, assign the interfaces,
 * activate, and call update_and_write_commands in every cycle, after the twist was written to references(). That call
 * allocates no memory, takes no lock, and throws nothing. It returns ok even if a joint fails, because after an error a
 * manager would deactivate the controller, and the arm would freeze. status() describes the fault.
 */
class TolerantController {
public:
    explicit TolerantController(const Options &options = {});

    /* Names in the format of the ROS 2 controller manager, in the order of assign. */
    std::vector<std::string> command_interface_configuration() const;   /* JOINT/velocity */
    std::vector<std::string> state_interface_configuration() const;     /* JOINT/position, then JOINT/effort if they are used */
    std::vector<std::string> reference_interface_configuration() const; /* twist/linear.x ... twist/angular.z */

    /* error: an option is not a number above 0. */
    Return on_configure();

    /* Set the addresses of states and commands, rad, m, N m, N, rad/s, m/s; effort is null without torques. */
    void assign(const std::array<const double *, joints> &position, const std::array<const double *, joints> *effort,
                const std::array<double *, joints> &velocity);

    /* Clears all faults. error: not configured, nothing assigned, or a position is not a number. */
    Return on_activate();

    /* Commands zero rates. */
    Return on_deactivate();

    /* Commanded twist, m/s and rad/s, linear before angular, frame: TASK_FRAME; a component that is not a number counts as 0. */
    std::array<double, 6> &references() { return twist_; }

    /* Set the measured tool pose of the present time, (4, 4) by rows, for the next cycle only. Without poses, a faulty joint
       sensor cannot be distinguished from a locked joint. */
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
    bool waits() const; /* true until the tool poses determine the position of the excluded joint */
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
