#include "course/review/value_changes.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <optional>

namespace dynlab::inline course {
namespace {

using nlohmann::json;

struct Shown {
    std::string text;
    std::optional<double> number;
};
using Entries = std::map<std::string, Shown>;

std::optional<double> number_in(std::string text) {
    while (!text.empty() && (text.back() == ' ' || text.back() == '%')) text.pop_back();
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end || !std::isfinite(number)) return {};
    return number;
}

std::string text_of(const json& cell) {
    return cell.is_string() ? cell.get<std::string>() : cell.dump(-1, ' ', false, json::error_handler_t::replace);
}

void add_table(const std::string& name, const json& table, Entries& entries) {
    const json header = table.value("header", json::array()), rows = table.value("rows", json::array());
    if (!header.is_array() || !rows.is_array()) return;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const json& row = rows[r];
        if (!row.is_array() || row.empty()) continue;
        for (std::size_t c = 1; c < row.size(); ++c) {
            const std::string column = c < header.size() ? text_of(header[c]) : fmt::format("column {}", c + 1);
            std::string entry = fmt::format("{}: {}, {}", name, text_of(row[0]), column);
            if (entries.contains(entry)) entry += fmt::format(" (row {})", r + 1);
            const std::string text = text_of(row[c]);
            entries[entry] = {text, number_in(text)};
        }
    }
}

/// All that a record shows; whatever has another form than ours is left out.
Entries entries_of(const json& record) {
    Entries entries;
    if (!record.is_object()) return entries;
    const json values = record.value("values", json::object()), tables = record.value("tables", json::object());
    for (const auto& [name, value] : values.items()) {
        if (!value.is_object() || !value.contains("text")) continue;
        Shown shown{text_of(value.at("text")), {}};
        if (value.contains("number") && value.at("number").is_number()) shown.number = value.at("number").get<double>();
        entries[name] = std::move(shown);
    }
    for (const auto& [name, table] : tables.items())
        if (table.is_object()) add_table(name, table, entries);
    return entries;
}

std::string change_text(const Shown& before, const Shown& after) {
    if (!before.number || !after.number) return "other text";
    if (*before.number == 0) return "from zero";
    const double percent = 100 * (*after.number - *before.number) / std::abs(*before.number);
    if (!std::isfinite(percent)) return "other text";
    return std::abs(percent) < 1000 ? fmt::format("{:+.3g} %", percent)
                                    : fmt::format("{:.3g} times", *after.number / *before.number);
}

}  // namespace

ValueChanges value_changes(const json& before, const json& after) {
    const Entries old_entries = entries_of(before), new_entries = entries_of(after);
    ValueChanges changes;
    for (const auto& [name, was] : old_entries) {
        const auto now = new_entries.find(name);
        ++changes.compared;
        if (now == new_entries.end())
            changes.changed.push_back({name, was.text, "", "gone"});
        else if (now->second.text != was.text)
            changes.changed.push_back({name, was.text, now->second.text, change_text(was, now->second)});
    }
    for (const auto& [name, now] : new_entries) {
        if (old_entries.contains(name)) continue;
        ++changes.compared;
        changes.changed.push_back({name, "", now.text, "new"});
    }
    return changes;
}

}  // namespace dynlab::inline course
