#include "platform/files/file_error.h"

#include <cerrno>
#include <cstdint>
#include <string_view>

#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

constexpr std::uintmax_t kSmallestRoom = 64 << 10;  // bytes; a disk with less is full

/// What was tried, as the library tells it between its own name and the reason.
std::string attempt_of(const std::filesystem::filesystem_error& error) {
    constexpr std::string_view kBegin = "filesystem error: ";
    std::string attempt = error.what();
    if (attempt.starts_with(kBegin)) attempt.erase(0, kBegin.size());
    attempt = attempt.substr(0, attempt.find(": " + error.code().message()));
    if (attempt.starts_with("cannot create director")) return "cannot make the folder";
    if (attempt.find("directory iterator") != std::string::npos) return "cannot read the folder";
    return attempt.starts_with("cannot ") ? attempt : "cannot do this (" + attempt + ") with";
}

/// The library tells a copy that a full disk has stopped as an input/output error.
int reason_of(const std::filesystem::filesystem_error& error) {
    const int reason = error.code().value();
    if (reason != EIO || error.path2().empty()) return reason;
    std::error_code unknown;
    const auto space = std::filesystem::space(error.path2().parent_path(), unknown);
    return !unknown && space.available < kSmallestRoom ? ENOSPC : reason;
}

}  // namespace

std::string file_error_sentence(const std::filesystem::filesystem_error& error) {
    std::string sentence = attempt_of(error);
    if (!error.path1().empty()) sentence += " " + error.path1().string();
    if (!error.path2().empty()) sentence += " to " + error.path2().string();
    return sentence + ": " + system_reason(reason_of(error));
}

}  // namespace dynlab::inline platform
