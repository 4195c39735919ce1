#include "platform/files/file_error.h"

#include <string_view>

#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

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

}  // namespace

std::string file_error_sentence(const std::filesystem::filesystem_error& error) {
    std::string sentence = attempt_of(error);
    if (!error.path1().empty()) sentence += " " + error.path1().string();
    if (!error.path2().empty()) sentence += " to " + error.path2().string();
    return sentence + ": " + system_reason(error.code().value());
}

}  // namespace dynlab::inline platform
