#pragma once
#include <memory>
#include "controller_interface/chainable_controller_interface.hpp"
namespace realtime_tools {
template <class T> struct RealtimePublisher {
    explicit RealtimePublisher(typename rclcpp::Publisher<T>::SharedPtr);
    bool trylock();
    void unlockAndPublish();
    T msg_;
};
} // namespace realtime_tools
