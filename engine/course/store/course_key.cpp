#include "course/store/course_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

constexpr std::string_view kFirstLine = "dynlab receipt key 1", kCourse = "course: ", kDigits = "ed25519: ";
constexpr std::size_t kKeyDigits = 64;

bool is_hex(const std::string& digits) {
    return digits.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

std::string public_key_text(const std::string& course, const std::string& public_key) {
    std::string name = course;
    std::replace(name.begin(), name.end(), '\n', ' ');
    return fmt::format("{}\n{}{}\n{}{}\n", kFirstLine, kCourse, name, kDigits, public_key);
}

PublicKey read_public_key(const std::filesystem::path& file) {
    PublicKey key;
    bool is_key = false;
    std::istringstream lines(read_file(file));
    for (std::string line; std::getline(lines, line);) {
        if (line.ends_with('\r')) line.pop_back();
        if (line == kFirstLine) is_key = true;
        if (line.starts_with(kCourse)) key.course = line.substr(kCourse.size());
        if (line.starts_with(kDigits)) key.digits = line.substr(kDigits.size());
    }
    if (!is_key || key.digits.size() != kKeyDigits || !is_hex(key.digits))
        throw EnvironmentError(
            "{}: the file is not the public key of a course. Ask your instructor for the file {}, which dynlab course "
            "verify --key creates",
            file.string(), kPublicKeyFile);
    return key;
}

}  // namespace dynlab::inline course
