#include "course/export/mailing.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "platform/files/zip_file.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline course {

TextTable mailing_list(const std::vector<Mailing>& mailings) {
    TextTable table;
    table.names = {"id", "name", "group", "mail", "files", "new"};
    for (const Mailing& mailing : mailings)
        table.rows.push_back({mailing.to.id, mailing.to.name, mailing.to.group, mailing.to.mail,
                              fmt::format("{}", fmt::join(mailing.files, "; ")), mailing.is_new ? "yes" : "no"});
    return table;
}

bool MoodleFeedback::add(const Recipient& to, const std::string& file, const std::string& content) {
    if (to.moodle.empty()) return false;
    std::string name = terminal_line(to.shown());
    std::ranges::replace_if(
        name, [](char c) { return std::string_view("_/\\:*?\"<>|").find(c) != std::string_view::npos; }, ' ');
    contents_[fmt::format("{}_{}_assignfeedback_file_/{}", name, to.moodle, file)] = content;
    return true;
}

void MoodleFeedback::write(const std::filesystem::path& zip) const {
    write_zip(zip, contents_);
}

}  // namespace dynlab::inline course
