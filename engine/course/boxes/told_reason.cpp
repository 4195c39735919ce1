#include "course/boxes/told_reason.h"

#include <string_view>

#include "documents/text_lines.h"

namespace dynlab::inline course {

std::string told_outside(const std::string& said, const std::filesystem::path& folder) {
    constexpr std::string_view kProgramSays = "dynlab: ";
    const std::string told = said.starts_with(kProgramSays) ? said.substr(kProgramSays.size()) : said;
    return replaced(told, folder.string() + "/", "");
}

std::string as_sentence(std::string text) {
    const bool ended = text.ends_with('.') || text.ends_with('?') || text.ends_with('!');
    return ended ? text : text + ".";
}

}  // namespace dynlab::inline course
