#include "cli/course_aliases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/reader.h"

namespace dynlab::inline cli {
namespace {

using Words = std::vector<std::string>;

struct Alias {
    Words before, now;
};

/// Old names of commands of `dynlab`.
const std::vector<Alias>& program_aliases() {
    static const std::vector<Alias> all = {
        {{"look"}, {"inspect"}}, {{"hand-back"}, {"export-grades"}}, {{"manual"}, {"site"}}};
    return all;
}

/// Old names of commands of `dynlab course`.
const std::vector<Alias>& course_aliases() {
    static const std::vector<Alias> all = {
        {{"roster", "import"}, {"import"}},
        {{"roster", "drop"}, {"drop"}},
        {{"roster", "return"}, {"drop", "--end"}},
        {{"assignment", "add"}, {"assignment"}},
        {{"assignment", "change"}, {"assignment"}},
        {{"assignment", "remove"}, {"assignment", "--remove"}},
        {{"receive"}, {"submit"}},
        {{"review", "receive"}, {"review", "collect"}},
        {{"final", "receive"}, {"submit", "--stage", "final"}},
        {{"final", "changes"}, {"changes"}},
        {{"peer", "assign"}, {"review", "assign"}},
        {{"peer", "send"}, {"review", "send"}},
        {{"peer", "show"}, {"review", "pairs"}},
        {{"peer", "set"}, {"review", "pairs", "--set"}},
        {{"peer", "forbid"}, {"review", "pairs", "--forbid"}},
        {{"peer", "free"}, {"review", "pairs", "--free"}},
        {{"release"}, {"review", "release"}},
        {{"return"}, {"deliver"}},
        {{"time"}, {"set-received"}},
        {{"hold"}, {"withhold"}},
        {{"override"}, {"mark"}},
        {{"oral", "sheet"}, {"scores", "--sheet"}},
        {{"key"}, {"verify", "--key"}},
        {{"findings"}, {"issues"}},
    };
    return all;
}

/// An assignment may be called add, change or remove. The old commands had its name behind that word.
bool is_new_form(const Words& before, Words::const_iterator begin, Words::const_iterator end) {
    if (before.front() != "assignment") return false;
    begin += static_cast<std::ptrdiff_t>(before.size());
    return begin == end || begin->starts_with('-');
}

/// Past the option --course DIR.
std::size_t past_folder(const Words& args, std::size_t at) {
    while (at < args.size() && args[at].starts_with("--course")) at += args[at] == "--course" ? 2 : 1;
    return std::min(at, args.size());
}

/// Replaces the old name at `at`, if there is one, and makes the note.
void rename(Words& args, std::size_t at, const std::vector<Alias>& aliases, const char* group, std::string& note) {
    const auto begin = args.begin() + static_cast<std::ptrdiff_t>(at);
    for (const auto& [before, now] : aliases) {
        if (static_cast<std::size_t>(args.end() - begin) < before.size() ||
            !std::equal(before.begin(), before.end(), begin) || is_new_form(before, begin, args.end()))
            continue;
        note = message_text(Message("note: dynlab {} is now dynlab {}; the old name works until 2027",
                                    fmt::format("{}{}", group, fmt::join(before, " ")),
                                    fmt::format("{}{}", group, fmt::join(now, " "))));
        const auto rest = args.erase(begin, begin + static_cast<std::ptrdiff_t>(before.size()));
        args.insert(rest, now.begin(), now.end());
        return;
    }
}

}  // namespace

std::vector<std::string> with_new_names(std::vector<std::string> args, std::string& note) {
    const std::size_t command = past_folder(args, 0);
    if (command < args.size() && args[command] == "course")
        rename(args, past_folder(args, command + 1), course_aliases(), "course ", note);
    else
        rename(args, command, program_aliases(), "", note);
    return args;
}

}  // namespace dynlab::inline cli
