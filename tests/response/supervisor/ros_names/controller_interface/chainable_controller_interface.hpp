// Names that NAME_ros.cpp uses of ros2_control (Jazzy), so that a compiler can read it where there is no ROS 2. Nothing works.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rclcpp {
struct Time {
    double seconds() const;
};
struct Duration {
    double seconds() const;
};
struct SystemDefaultsQoS {};
template <class T> struct Subscription {
    using SharedPtr = std::shared_ptr<Subscription>;
};
template <class T> struct Publisher {
    using SharedPtr = std::shared_ptr<Publisher>;
};
} // namespace rclcpp

namespace rclcpp_lifecycle {
struct State {};
struct LifecycleNode {
    const char *get_name() const;
    template <class T, class Q, class F>
    typename rclcpp::Subscription<T>::SharedPtr create_subscription(const std::string &, const Q &, F &&call) {
        std::function<void(const std::shared_ptr<T>)> checked(call);
        return nullptr;
    }
    template <class T, class Q> typename rclcpp::Publisher<T>::SharedPtr create_publisher(const std::string &, const Q &);
};
} // namespace rclcpp_lifecycle

namespace hardware_interface {
struct CommandInterface {
    CommandInterface(const std::string &, const std::string &, double *);
};
struct LoanedStateInterface {
    double get_value() const;
};
struct LoanedCommandInterface {
    void set_value(double);
};
} // namespace hardware_interface

namespace controller_interface {
enum class CallbackReturn { SUCCESS, FAILURE, ERROR };
enum class return_type { OK, ERROR };
enum class interface_configuration_type { ALL, INDIVIDUAL, NONE };
struct InterfaceConfiguration {
    interface_configuration_type type;
    std::vector<std::string> names;
};
class ChainableControllerInterface {
public:
    virtual ~ChainableControllerInterface() = default;
    virtual CallbackReturn on_init() = 0;
    virtual InterfaceConfiguration command_interface_configuration() const = 0;
    virtual InterfaceConfiguration state_interface_configuration() const = 0;
    virtual CallbackReturn on_configure(const rclcpp_lifecycle::State &);
    virtual CallbackReturn on_activate(const rclcpp_lifecycle::State &);
    virtual CallbackReturn on_deactivate(const rclcpp_lifecycle::State &);
    std::shared_ptr<rclcpp_lifecycle::LifecycleNode> get_node() const;

protected:
    virtual std::vector<hardware_interface::CommandInterface> on_export_reference_interfaces();
    virtual bool on_set_chained_mode(bool);
    virtual return_type update_reference_from_subscribers(const rclcpp::Time &, const rclcpp::Duration &) = 0;
    virtual return_type update_and_write_commands(const rclcpp::Time &, const rclcpp::Duration &) = 0;
    std::vector<double> reference_interfaces_;
    std::vector<hardware_interface::LoanedStateInterface> state_interfaces_;
    std::vector<hardware_interface::LoanedCommandInterface> command_interfaces_;
};
} // namespace controller_interface
