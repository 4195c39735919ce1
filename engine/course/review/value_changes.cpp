#include "course/review/value_changes.h"

#include <fmt/format.h>

#include <map>

namespace dynlab::inline course {
namespace {

/// A value, an answer and a cell may have one name.
enum class Kind { kValue, kAnswer, kCell };
using Entries = std::map<std::pair<std::string, Kind>, std::pair<std::string, std::string>>;  ///< before and after

void add_entries(const RunRecord& record, std::string std::pair<std::string, std::string>::*side, Entries& entries) {
    for (const auto& [name, value] : record.values) entries[{name, Kind::kValue}].*side = value.text;
    for (const auto& [name, answer] : record.answers) entries[{name, Kind::kAnswer}].*side = answer.json;
    for (const auto& [name, table] : record.tables) {
        std::map<std::string, int> seen;  // rows of the same first cell, and columns of the same header
        for (const std::vector<std::string>& row : table.rows)
            for (std::size_t c = 1; c < row.size(); ++c) {
                const std::string column = c < table.header.size() ? table.header[c] : std::to_string(c + 1);
                std::string entry = fmt::format("{}: {}, {}", name, row[0], column);
                if (const int number = ++seen[entry]; number > 1) entry += fmt::format(" ({})", number);
                entries[{entry, Kind::kCell}].*side = row[c];
            }
    }
}

}  // namespace

ValueChanges value_changes(const RunRecord& before, const RunRecord& after) {
    Entries entries;
    add_entries(before, &Entries::mapped_type::first, entries);
    add_entries(after, &Entries::mapped_type::second, entries);
    ValueChanges changes{{}, entries.size()};
    for (const auto& [key, texts] : entries)
        if (texts.first != texts.second) changes.changed.push_back({key.first, texts.first, texts.second});
    return changes;
}

}  // namespace dynlab::inline course
