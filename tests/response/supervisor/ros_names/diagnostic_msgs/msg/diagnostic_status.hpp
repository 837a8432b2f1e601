#pragma once
#include <string>
namespace diagnostic_msgs::msg {
struct DiagnosticStatus {
    static constexpr unsigned char OK = 0, WARN = 1, ERROR = 2;
    unsigned char level;
    std::string name, message, hardware_id;
};
} // namespace diagnostic_msgs::msg
