#include "documents/run_record.h"

#include <fmt/format.h>

#include "base/reader.h"
#include "data_io/values/json_values.h"
#include "documents/record_description.h"

namespace dynlab::inline documents {
namespace {

/// The run results in the form for readers: files without their folders, each output a separate piece.
RunRecord readable_record(const RunRecord& record) {
    RunRecord readable;
    readable.script = record.script;
    readable.seed = record.seed;
    readable.values = record.values;
    readable.tables = record.tables;
    readable.texts = record.texts;
    readable.answers = record.answers;
    readable.sliders = record.sliders;
    readable.error = record.error;
    for (const auto& [name, figure] : record.figures)
        readable.figures[name] = {{}, figure.caption, figure.file.filename(), figure.order};
    for (const auto& [cell, outputs] : record.outputs) {
        auto& pieces = readable.outputs[cell];
        for (const CellOutput& output : outputs) {
            if (!output.printed.empty()) pieces.push_back({output.printed, {}});
            if (output.figure) pieces.push_back({"", output.figure});
        }
    }
    for (const std::filesystem::path& file : record.files_read) readable.files_read.push_back(file.filename());
    return readable;
}

}  // namespace

std::string RecordedError::text(const Reader& reader) const {
    const std::string what = message_text(message, reader);
    return line > 0 ? fmt::format("{}:{}: {}", file, line, what) : what;
}

void write_whole_value(ValueWriter& writer, const RecordedAnswer& answer) {
    if (!writer.keeps_all()) return writer.json_text(answer.json);
    writer.begin_object();
    writer.member("kind");
    writer.text(answer.kind);
    writer.member("json");
    writer.json_text(answer.json);
    writer.end_object();
}

void read_whole_value(ValueReader& reader, RecordedAnswer& answer) {
    if (!reader.keeps_all()) answer.json = reader.json_text();
    reader.begin_object();
    if (!reader.member("kind")) reader.lacks("kind");
    answer.kind = reader.text();
    if (reader.keeps_all()) {
        if (!reader.member("json")) reader.lacks("json");
        answer.json = reader.json_text();
    }
    reader.end_object();
}

std::string to_json(const RunRecord& record) {
    return json_of(readable_record(record), 2) + "\n";
}

RunRecord record_from_json(const std::string& json) {
    return from_json<RunRecord>(json);
}

}  // namespace dynlab::inline documents
