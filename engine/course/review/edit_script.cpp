#include "course/review/edit_script.h"

#include <cctype>

#include "documents/work_file.h"
#include "platform/child_process.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kFewLines = 5000;  ///< of so many the shortest script is looked for
constexpr auto kDiffTime = std::chrono::seconds(30);

bool is_letter(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80 || std::isalpha(byte);
}

std::string lines_of_keys(const std::vector<std::string>& items) {
    std::string lines;
    for (const std::string& item : items) lines += comparison_key(item) + '\n';
    return lines;
}

std::string key_of_character(char32_t c, std::string_view bytes) {
    if (c == 0x2018 || c == 0x2019) return "'";
    if (c == 0x201C || c == 0x201D || c == 0xAB || c == 0xBB) return "\"";
    if (c == 0x2212 || c == 0x2013) return "-";
    if (c <= 0x20 || (c >= 0x7F && c <= 0xA0) || (c >= 0x2000 && c <= 0x200B) || c == 0x202F || c == 0xFEFF) return "";
    if (is_silent(c)) return "";
    if (c >= 0xFB00 && c <= 0xFB06) return folded_letter(c);
    return std::string(bytes);
}

}  // namespace

std::string comparison_key(const std::string& text) {
    std::string plain;
    for (std::string_view rest = text; !rest.empty();) {
        const std::string_view before = rest;
        const char32_t c = next_character(rest);
        plain += key_of_character(c, before.substr(0, before.size() - rest.size()));
    }
    std::string key;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const bool inside =
            plain[i] == '-' && i > 0 && i + 1 < plain.size() && is_letter(plain[i - 1]) && is_letter(plain[i + 1]);
        if (!inside) key += plain[i];
    }
    return key;
}

std::string edit_script(const std::vector<std::string>& before, const std::vector<std::string>& after) {
    const TemporaryFolder folder;
    write_work_file(folder.path() / "before", lines_of_keys(before));
    write_work_file(folder.path() / "after", lines_of_keys(after));
    ChildOptions options;
    options.command = {"diff", "--text", "--old-line-format=-", "--new-line-format=+", "--unchanged-line-format=="};
    if (before.size() + after.size() < kFewLines) options.command.push_back("--minimal");
    options.command.insert(options.command.end(), {"before", "after"});
    options.folder = folder.path();
    options.environment = {{"LC_ALL", "C"}};
    options.timeout = kDiffTime;
    const ChildResult result = run_child(options, "diffutils");
    if (result.timed_out || result.exit_code > 1)
        throw EnvironmentError("diff cannot compare the texts: " +
                               (result.timed_out ? std::string("it takes too long") : result.error_output));
    return result.output;
}

}  // namespace dynlab::inline course
