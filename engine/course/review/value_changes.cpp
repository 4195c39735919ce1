#include "course/review/value_changes.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "data_io/values/json_values.h"
#include "platform/text/read_number.h"

namespace dynlab::inline course {
namespace {

using nlohmann::json;

using Entries = std::map<std::string, RecordedValue>;

std::optional<double> number_in(std::string text) {
    while (!text.empty() && (text.back() == ' ' || text.back() == '%')) text.pop_back();
    const auto number = read_number<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

std::string text_of(const json& cell) {
    return cell.is_string() ? cell.get<std::string>() : cell.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::vector<std::string> row_in(const json& cells) {
    std::vector<std::string> row;
    if (cells.is_array())
        for (const json& cell : cells) row.push_back(text_of(cell));
    return row;
}

std::optional<RecordedTable> table_in(const json& table) {
    if (!table.is_object()) return {};
    const json header = table.value("header", json::array()), rows = table.value("rows", json::array());
    if (!header.is_array() || !rows.is_array()) return {};
    RecordedTable read{row_in(header), {}};
    for (const json& row : rows) read.rows.push_back(row_in(row));
    return read;
}

void add_table(const std::string& name, const RecordedTable& table, Entries& entries) {
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const std::vector<std::string>& row = table.rows[r];
        for (std::size_t c = 1; c < row.size(); ++c) {
            const std::string column = c < table.header.size() ? table.header[c] : fmt::format("column {}", c + 1);
            std::string entry = fmt::format("{}: {}, {}", name, row[0], column);
            if (entries.contains(entry)) entry += fmt::format(" (row {})", r + 1);
            entries[entry] = {number_in(row[c]), row[c]};
        }
    }
}

/// All that a record shows.
Entries entries_of(const ShownRecord& record) {
    Entries entries = record.values;
    for (const auto& [name, table] : record.tables) add_table(name, table, entries);
    return entries;
}

std::string change_text(const RecordedValue& before, const RecordedValue& after) {
    if (!before.number || !after.number) return "other text";
    if (*before.number == 0) return "from zero";
    const double percent = 100 * (*after.number - *before.number) / std::abs(*before.number);
    if (!std::isfinite(percent)) return "other text";
    return std::abs(percent) < 1000 ? fmt::format("{:+.3g} %", percent)
                                    : fmt::format("{:.3g} times", *after.number / *before.number);
}

}  // namespace

std::optional<ShownRecord> shown_record(const std::string& text) {
    constexpr std::size_t kMostText = 16u << 20;
    ValueLimits limits;
    limits.bytes = kMostText;
    limits.memory = 64 * kMostText;
    json record;
    try {
        record = parsed_json(text, limits);
    } catch (const ValueError&) {
    }
    if (!record.is_object()) return {};
    ShownRecord shown;
    shown.failed = record.contains("error");
    const json values = record.value("values", json::object()), tables = record.value("tables", json::object());
    for (const auto& [name, value] : values.items()) {
        if (!value.is_object() || !value.contains("text")) continue;
        RecordedValue& read = shown.values[name] = {{}, text_of(value.at("text"))};
        if (value.contains("number") && value.at("number").is_number()) read.number = value.at("number").get<double>();
    }
    for (const auto& [name, table] : tables.items())
        if (auto read = table_in(table)) shown.tables[name] = std::move(*read);
    return shown;
}

ValueChanges value_changes(const ShownRecord& before, const ShownRecord& after) {
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
