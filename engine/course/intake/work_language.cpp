#include "course/intake/work_language.h"

#include "documents/error.h"
#include "documents/percent_script.h"
#include "documents/template_file.h"

namespace dynlab::inline course {
namespace {

constexpr std::uintmax_t kMostText = 4u << 20;

bool is_small_file(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::symlink_status(file, error).type() == std::filesystem::file_type::regular &&
           std::filesystem::file_size(file, error) <= kMostText && !error;
}

}  // namespace

std::string language_of_work(const std::filesystem::path& folder) {
    try {
        if (const auto report = folder / "report.md"; is_small_file(report)) {
            const auto metadata = read_template(report).metadata;
            if (const auto found = metadata.find("lang"); found != metadata.end()) return found->second;
        }
    } catch (const DocumentError&) {  // students write headers, too
    }
    try {
        if (const auto script = folder / "analysis.lua"; is_small_file(script))
            return read_percent_script(script).header.language;
    } catch (const DocumentError&) {
    }
    return "";
}

}  // namespace dynlab::inline course
