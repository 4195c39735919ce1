#include "documents/run_record.h"

#include "data_io/values/json_values.h"
#include "documents/record_description.h"

namespace dynlab::inline documents {
namespace {

/// What people are told of a run: files without their folders, each output a piece of its own.
RunRecord told_record(const RunRecord& record) {
    RunRecord told;
    told.script = record.script;
    told.seed = record.seed;
    told.values = record.values;
    told.tables = record.tables;
    told.texts = record.texts;
    told.answers = record.answers;
    told.error = record.error;
    for (const auto& [name, figure] : record.figures)
        told.figures[name] = {{}, figure.caption, figure.file.filename(), figure.order};
    for (const auto& [cell, outputs] : record.outputs) {
        auto& pieces = told.outputs[cell];
        for (const CellOutput& output : outputs) {
            if (!output.printed.empty()) pieces.push_back({output.printed, {}});
            if (output.figure) pieces.push_back({"", output.figure});
        }
    }
    for (const std::filesystem::path& file : record.files_read) told.files_read.push_back(file.filename());
    return told;
}

}  // namespace

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
    return json_of(told_record(record), 2) + "\n";
}

RunRecord record_from_json(const std::string& json) {
    return from_json<RunRecord>(json);
}

}  // namespace dynlab::inline documents
