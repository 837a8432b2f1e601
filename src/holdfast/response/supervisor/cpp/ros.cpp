/*
 * The same as a chainable controller of ros2_control (Jazzy), for pluginlib: NAME_plugin.xml. Not compiled against ROS 2 where it
 * was written: its syntax was checked with headers that only have the names. Link NAME.cpp, NAME_law.c and NAME_monitor.c to it.
 *
 * Parameters of the node: none. Chained, it takes a twist from the controller before it, by six reference interfaces; alone, from
 * the topic ~/twist. What it says of the arm goes to ~/status when it changes.
 */
#include "NAME.hpp"

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "controller_interface/chainable_controller_interface.hpp"
#include "diagnostic_msgs/msg/diagnostic_status.hpp"
#include "geometry_msgs/msg/twist.hpp"
#include "pluginlib/class_list_macros.hpp"
#include "realtime_tools/realtime_buffer.hpp"
#include "realtime_tools/realtime_publisher.hpp"

namespace NAME {

class RosController : public controller_interface::ChainableControllerInterface {
    using Told = controller_interface::CallbackReturn;
    using Twist = geometry_msgs::msg::Twist;
    using Report = diagnostic_msgs::msg::DiagnosticStatus;

public:
    Told on_init() override { return Told::SUCCESS; }

    controller_interface::InterfaceConfiguration command_interface_configuration() const override {
        return {controller_interface::interface_configuration_type::INDIVIDUAL, core_.command_interface_configuration()};
    }

    controller_interface::InterfaceConfiguration state_interface_configuration() const override {
        return {controller_interface::interface_configuration_type::INDIVIDUAL, core_.state_interface_configuration()};
    }

    Told on_configure(const rclcpp_lifecycle::State &) override {
        for (int k = 0; k < joints; ++k) position_[k] = &q_[k], effort_[k] = &torque_[k], velocity_[k] = &rates_[k];
        core_.assign(position_, &effort_, velocity_);
        twist_ = get_node()->create_subscription<Twist>("~/twist", rclcpp::SystemDefaultsQoS(),
                                                        [this](const std::shared_ptr<Twist> told) { latest_.writeFromNonRT(told); });
        report_ = get_node()->create_publisher<Report>("~/status", rclcpp::SystemDefaultsQoS());
        sender_ = std::make_unique<realtime_tools::RealtimePublisher<Report>>(report_);
        return core_.on_configure() == Return::ok ? Told::SUCCESS : Told::FAILURE;
    }

    Told on_activate(const rclcpp_lifecycle::State &) override {
        read();
        latest_.writeFromNonRT(nullptr);
        reference_interfaces_.assign(6, std::numeric_limits<double>::quiet_NaN());
        return core_.on_activate() == Return::ok ? Told::SUCCESS : Told::FAILURE;
    }

    Told on_deactivate(const rclcpp_lifecycle::State &) override {
        core_.on_deactivate();
        write();
        return Told::SUCCESS;
    }

protected:
    std::vector<hardware_interface::CommandInterface> on_export_reference_interfaces() override {
        reference_interfaces_.assign(6, std::numeric_limits<double>::quiet_NaN());
        std::vector<hardware_interface::CommandInterface> offered;
        const std::vector<std::string> names = core_.reference_interface_configuration();
        for (int k = 0; k < 6; ++k) offered.emplace_back(std::string(get_node()->get_name()), names[k], &reference_interfaces_[k]);
        return offered;
    }

    bool on_set_chained_mode(bool) override { return true; }

    controller_interface::return_type update_reference_from_subscribers(const rclcpp::Time &, const rclcpp::Duration &) override {
        if (const auto told = *latest_.readFromRT()) {
            const double twist[6] = {told->linear.x, told->linear.y, told->linear.z, told->angular.x, told->angular.y, told->angular.z};
            for (int k = 0; k < 6; ++k) reference_interfaces_[k] = twist[k];
        }
        return controller_interface::return_type::OK;
    }

    controller_interface::return_type update_and_write_commands(const rclcpp::Time &time, const rclcpp::Duration &period) override {
        read();
        for (int k = 0; k < 6; ++k) core_.references()[k] = reference_interfaces_[k];
        core_.update_and_write_commands(time.seconds(), period.seconds());
        write();
        tell();
        /* OK also when a joint failed: an error would have this deactivated (ros2_control 742, 1499). */
        return controller_interface::return_type::OK;
    }

private:
    void read() {
        for (int k = 0; k < joints; ++k) {
            q_[k] = state_interfaces_[k].get_value();
            torque_[k] = state_interfaces_[joints + k].get_value();
        }
    }

    void write() {
        for (int k = 0; k < joints; ++k) command_interfaces_[k].set_value(rates_[k]);
    }

    void tell() {
        const Status &status = core_.status();
        if (status.changes == told_ || !sender_->trylock()) return;
        told_ = status.changes;
        Report &report = sender_->msg_;
        report.level = status.mode == Mode::running ? Report::OK : status.mode == Mode::stopped ? Report::ERROR : Report::WARN;
        report.name = name_of(status.mode);
        report.message = status.why; /* allocates, but only when it changes */
        report.hardware_id = status.verdict.joint < 0 ? "" : NAME_monitor_joints[status.verdict.joint];
        sender_->unlockAndPublish();
    }

    TolerantController core_;
    Joints q_{}, torque_{}, rates_{};
    std::array<const double *, joints> position_{}, effort_{};
    std::array<double *, joints> velocity_{};
    realtime_tools::RealtimeBuffer<std::shared_ptr<Twist>> latest_;
    rclcpp::Subscription<Twist>::SharedPtr twist_;
    rclcpp::Publisher<Report>::SharedPtr report_;
    std::unique_ptr<realtime_tools::RealtimePublisher<Report>> sender_;
    long told_ = 0;
};

} /* namespace NAME */

PLUGINLIB_EXPORT_CLASS(NAME::RosController, controller_interface::ChainableControllerInterface)
