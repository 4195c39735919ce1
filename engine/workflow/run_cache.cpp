#include "workflow/run_cache.h"

#include <nlohmann/json.hpp>

#include "platform/atomic_file.h"
#include "workflow/inputs_read.h"

namespace dynlab::inline workflow {

namespace fs = std::filesystem;
using nlohmann::json;

// Not in a nameless namespace, where the library would not find them.
static void to_json(json& j, const RecordedValue& value) {
    j = {{"text", value.text}, {"is_number", value.number.has_value()}, {"number", value.number.value_or(0)}};
}
static void from_json(const json& j, RecordedValue& value) {
    value.text = j.at("text");
    if (j.at("is_number")) value.number = j.at("number").get<double>();
}

static void to_json(json& j, const RecordedTable& table) {
    j = {{"header", table.header}, {"rows", table.rows}};
}
static void from_json(const json& j, RecordedTable& table) {
    table = {j.at("header"), j.at("rows")};
}

/// The figure itself is needed no more: its file is kept.
static void to_json(json& j, const RecordedFigure& figure) {
    j = {{"caption", figure.caption}, {"file", figure.file.filename().string()}, {"place", figure.place}};
}
static void from_json(const json& j, RecordedFigure& figure) {
    figure.caption = j.at("caption");
    figure.file = j.at("file").get<std::string>();
    figure.place = j.at("place");
}

static void to_json(json& j, const RecordedText& text) {
    j = text.markdown;
}
static void from_json(const json& j, RecordedText& text) {
    text.markdown = j;
}

static void to_json(json& j, const RecordedAnswer& answer) {
    j = {{"kind", answer.kind}, {"json", answer.json}};
}
static void from_json(const json& j, RecordedAnswer& answer) {
    answer = {j.at("kind"), j.at("json")};
}

static void to_json(json& j, const CellOutput& output) {
    j = {{"printed", output.printed}};
    if (output.figure) j["figure"] = *output.figure;
}
static void from_json(const json& j, CellOutput& output) {
    output.printed = j.at("printed");
    if (j.contains("figure")) output.figure = j.at("figure").get<std::string>();
}

namespace {

constexpr char kRecord[] = "record";

std::string packed(const RunRecord& record) {
    json j = {{"script", record.script},   {"seed", record.seed},       {"values", record.values},
              {"tables", record.tables},   {"figures", record.figures}, {"texts", record.texts},
              {"answers", record.answers}, {"outputs", record.outputs}, {"timings", record.timings},
              {"files", json::array()}};
    for (const fs::path& file : record.files_read) j["files"].push_back(file.string());
    const std::vector<std::uint8_t> bytes = json::to_cbor(j);
    return {bytes.begin(), bytes.end()};
}

RunRecord unpacked(const std::string& bytes, const fs::path& folder) {
    const json j = json::from_cbor(bytes);
    RunRecord record;
    record.script = j.at("script");
    record.seed = j.at("seed");
    record.values = j.at("values");
    record.tables = j.at("tables");
    record.figures = j.at("figures");
    record.texts = j.at("texts");
    record.answers = j.at("answers");
    record.outputs = j.at("outputs");
    record.timings = j.at("timings");
    for (const std::string file : j.at("files")) record.files_read.emplace_back(file);
    for (auto& [name, figure] : record.figures) figure.file = folder / figure.file;
    return record;
}

/// "analysis.lua:12" in a text that the run produced.
bool names_a_line(const RunRecord& record) {
    const std::string start = record.script + ":";
    const auto named_in = [&start](const std::string& text) { return text.find(start) != std::string::npos; };
    for (const auto& [name, value] : record.values)
        if (named_in(value.text)) return true;
    for (const auto& [name, text] : record.texts)
        if (named_in(text.markdown)) return true;
    for (const auto& [cell, outputs] : record.outputs)
        for (const CellOutput& output : outputs)
            if (named_in(output.printed)) return true;
    for (const auto& [name, table] : record.tables)
        for (const auto& row : table.rows)
            for (const std::string& text : row)
                if (named_in(text)) return true;
    return false;
}

std::string text_of(const InputsRead& inputs) {
    return json(inputs).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string entry_of_script(const PercentScript& script, const fs::path& file, std::uint32_t seed,
                            FigureFormat format) {
    EntryName name("runs");
    name.add(file.string());
    name.add(std::to_string(seed));
    name.add(script.header.language);
    name.add(std::to_string(static_cast<int>(format)));
    for (const Cell& cell : script.cells)
        if (cell.kind == Cell::Kind::kCode) name.add(cell.id).add(cell.content);
    return name.text();
}

std::string entry_of_run(const std::string& entry_of_script, const InputsRead& inputs) {
    return EntryName("runs").add(entry_of_script).add(text_of(inputs)).text();
}

}  // namespace

RunCache::RunCache(const PercentScript& script, std::uint32_t seed, FigureFormat format, const Cache& cache)
    : cache_(cache),
      script_(fs::absolute(script.file)),
      entry_(cache.lasting() ? entry_of_script(script, script_, seed, format) : std::string()) {}

std::optional<RunRecord> RunCache::recall() const {
    const auto known = entry_.empty() ? std::nullopt : cache_.recall(entry_);
    if (!known) return {};
    const json inputs = json::parse(*known, nullptr, false);
    if (!inputs.is_object() || !unchanged(inputs.get<InputsRead>())) return {};
    const auto folder = cache_.find(entry_of_run(entry_, inputs));
    if (!folder) return {};
    try {
        return unpacked(read_file(*folder / kRecord), *folder);
    } catch (const std::exception&) {  // deleted meanwhile, or spoilt: then the script is run
        return {};
    }
}

void RunCache::remember(const RunRecord& record) const {
    if (entry_.empty() || record.error || names_a_line(record)) return;
    try {
        keep(record);
    } catch (const std::exception&) {  // a full disk, say: the next run does without
    }
}

void RunCache::keep(const RunRecord& record) const {
    const InputsRead inputs = inputs_read(record, script_.parent_path());
    const fs::path folder = cache_.prepare();
    for (const auto& [name, figure] : record.figures) fs::copy_file(figure.file, folder / figure.file.filename());
    write_file_atomically(folder / kRecord, packed(record));
    cache_.commit(folder, entry_of_run(entry_, inputs));
    cache_.remember(entry_, text_of(inputs));
}

}  // namespace dynlab::inline workflow
