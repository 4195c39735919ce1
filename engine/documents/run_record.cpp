#include "documents/run_record.h"

#include <nlohmann/json.hpp>

namespace dynlab::inline documents {
namespace {

using nlohmann::json;

json json_of(const RecordedValue& value) {
    json result = {{"text", value.text}};
    if (value.number) result["number"] = *value.number;
    return result;
}

json json_of(const std::vector<CellOutput>& outputs) {
    json result = json::array();
    for (const CellOutput& output : outputs) {
        if (!output.printed.empty()) result.push_back({{"printed", output.printed}});
        if (output.figure) result.push_back({{"figure", *output.figure}});
    }
    return result;
}

/// Names of figures and captions only: their curves are in the figure files.
json json_of(const RecordedFigure& figure) {
    json result = {{"caption", figure.caption}};
    if (!figure.file.empty()) result["file"] = figure.file.filename().string();
    return result;
}

json json_of(const RecordedTable& table) {
    return {{"header", table.header}, {"rows", table.rows}};
}

json json_of(const RecordedText& text) {
    return text.markdown;
}

json json_of(const RecordedAnswer& answer) {
    return json::parse(answer.json);
}

template <typename Entry>
json json_of_entries(const std::map<std::string, Entry>& entries) {
    json result = json::object();
    for (const auto& [name, entry] : entries) result[name] = json_of(entry);
    return result;
}

std::string text_of(const json& value) {
    return value.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string to_json(const RunRecord& record) {
    json result = {{"script", record.script},
                   {"seed", record.seed},
                   {"values", json_of_entries(record.values)},
                   {"tables", json_of_entries(record.tables)},
                   {"figures", json_of_entries(record.figures)},
                   {"texts", json_of_entries(record.texts)},
                   {"answers", json_of_entries(record.answers)},
                   {"outputs", json_of_entries(record.outputs)},
                   {"files_read", json::array()}};
    for (const std::filesystem::path& file : record.files_read)
        result["files_read"].push_back(file.filename().string());
    if (record.error) result["error"] = {{"message", record.error->message}, {"line", record.error->line}};
    return text_of(result);
}

std::string timings_to_json(const RunRecord& record) {
    return text_of(json(record.timings));
}

}  // namespace dynlab::inline documents
