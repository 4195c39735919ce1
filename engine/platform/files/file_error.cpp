#include "platform/files/file_error.h"

#include <cerrno>
#include <cstdint>
#include <string_view>

#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

constexpr std::uintmax_t kMinFreeSpace = 64 << 10;  // bytes; a disk with less is full

/// What was tried, as the library says it between its own name and the reason: "cannot copy file".
std::string attempt_of(const std::filesystem::filesystem_error& error) {
    constexpr std::string_view kBegin = "filesystem error: ";
    std::string attempt = error.what();
    if (attempt.starts_with(kBegin)) attempt.erase(0, kBegin.size());
    return attempt.substr(0, attempt.find(": " + error.code().message()));
}

/// The library reports a copy that a full disk has stopped as an input/output error.
int reason_of(const std::filesystem::filesystem_error& error) {
    const int reason = error.code().value();
    if (reason != EIO || error.path2().empty()) return reason;
    std::error_code unknown;
    const auto space = std::filesystem::space(error.path2().parent_path(), unknown);
    return !unknown && space.available < kMinFreeSpace ? ENOSPC : reason;
}

}  // namespace

Message file_error_sentence(const std::filesystem::filesystem_error& error) {
    const std::string attempt = attempt_of(error), reason = system_reason(reason_of(error));
    const std::string file = error.path1().string(), other = error.path2().string();
    if (attempt.starts_with("cannot create director")) return Message("cannot create the folder {}: {}", file, reason);
    if (attempt.find("directory iterator") != std::string::npos)
        return Message("cannot read the folder {}: {}", file, reason);
    const Message tried = attempt.starts_with("cannot ") ? Message::verbatim(attempt)
                                                         : Message("cannot perform the operation ({}) on", attempt);
    if (file.empty()) return Message("{}: {}", tried, reason);
    if (other.empty()) return Message("{} {}: {}", tried, file, reason);
    return Message("{} {} to {}: {}", tried, file, other, reason);
}

}  // namespace dynlab::inline platform
