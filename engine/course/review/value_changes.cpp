#include "course/review/value_changes.h"

#include <fmt/format.h>

#include <map>

namespace dynlab::inline course {
namespace {

using Entries = std::map<std::string, std::pair<std::string, std::string>>;  ///< before and after

void add_entries(const RunRecord& record, std::string std::pair<std::string, std::string>::*side, Entries& entries) {
    for (const auto& [name, value] : record.values) entries[name].*side = value.text;
    for (const auto& [name, answer] : record.answers) entries[name].*side = answer.json;
    for (const auto& [name, table] : record.tables)
        for (std::size_t r = 0; r < table.rows.size(); ++r) {
            const std::vector<std::string>& row = table.rows[r];
            for (std::size_t c = 1; c < row.size(); ++c) {
                const std::string column = c < table.header.size() ? table.header[c] : std::to_string(c + 1);
                std::string entry = fmt::format("{}: {}, {}", name, row[0], column);
                if (!(entries[entry].*side).empty()) entry += fmt::format(" (row {})", r + 1);
                entries[entry].*side = row[c];
            }
        }
}

}  // namespace

ValueChanges value_changes(const RunRecord& before, const RunRecord& after) {
    Entries entries;
    add_entries(before, &Entries::mapped_type::first, entries);
    add_entries(after, &Entries::mapped_type::second, entries);
    ValueChanges changes{{}, entries.size()};
    for (const auto& [name, texts] : entries)
        if (texts.first != texts.second) changes.changed.push_back({name, texts.first, texts.second});
    return changes;
}

}  // namespace dynlab::inline course
