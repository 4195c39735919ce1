#pragma once
#include <malloc.h>

#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

namespace dynlab::test {

/// Most memory that this process has in use while the work is done, MB; not what was freed before.
inline double peak_memory(const std::function<void()>& work) {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // starts the peak again
    work();
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double kilobytes = 0;
        if (word == "VmHWM:" && status >> kilobytes) return kilobytes / 1024;
    }
    throw std::runtime_error("/proc/self/status does not tell VmHWM");
}

}  // namespace dynlab::test
