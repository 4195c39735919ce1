#pragma once
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "platform/temporary_folder.h"

namespace dynlab::fuzz {

/// The input as text; a harness that has several things to try takes its first byte off.
inline std::string text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// The first byte, 0 of nothing.
inline unsigned take_choice(std::string& text) {
    if (text.empty()) return 0;
    const unsigned choice = static_cast<unsigned char>(text.front());
    text.erase(0, 1);
    return choice;
}

/// The folder in which this process puts its inputs.
inline const std::filesystem::path& work_folder() {
    static const TemporaryFolder folder;
    return folder.path();
}

/// The input as a file of this name.
inline std::filesystem::path file_of(const std::string& text, const std::string& name) {
    const std::filesystem::path file = work_folder() / name;
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(text.data(), static_cast<std::streamsize>(text.size()));
    return file;
}

/// A statement that must hold whatever the input is.
inline void demand(bool holds) {
    if (!holds) std::abort();
}

}  // namespace dynlab::fuzz
