#pragma once
#include <type_traits>
#define PLUGINLIB_EXPORT_CLASS(own, base) \
    static_assert(std::is_base_of_v<base, own> && !std::is_abstract_v<own> && std::is_default_constructible_v<own>);
