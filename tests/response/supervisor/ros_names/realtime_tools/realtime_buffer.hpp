#pragma once
namespace realtime_tools {
template <class T> struct RealtimeBuffer {
    T *readFromRT();
    void writeFromNonRT(const T &);
};
} // namespace realtime_tools
