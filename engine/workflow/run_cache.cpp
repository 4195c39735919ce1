#include "workflow/run_cache.h"

#include "data_io/values/cbor_values.h"
#include "documents/record_description.h"
#include "platform/atomic_file.h"
#include "workflow/inputs_read.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

constexpr char kRecord[] = "record";

RunRecord unpacked(const std::string& bytes, const fs::path& folder) {
    auto record = from_cbor<RunRecord>(bytes, ValueLimits::own());
    for (auto& [name, figure] : record.figures) figure.file = folder / figure.file.filename();
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

std::string entry_of_script(const ReportRequest& request, const fs::path& file, FigureFormat format) {
    EntryName name("runs");
    name.add(file.string());
    name.add(std::to_string(request.seed));
    name.add(cbor_of(request.slider_values));
    name.add(request.script.header.language);
    name.add(std::to_string(static_cast<int>(format)));
    for (const Cell& cell : request.script.cells)
        if (cell.kind == Cell::Kind::kCode) name.add(cell.id).add(cell.content);
    return name.text();
}

std::string entry_of_run(const std::string& entry_of_script, const InputsRead& inputs) {
    return EntryName("runs").add(entry_of_script).add(cbor_of(inputs)).text();
}

}  // namespace

RunCache::RunCache(const ReportRequest& request, FigureFormat format, const Cache& cache)
    : cache_(cache),
      script_(fs::absolute(request.script.file)),
      entry_(cache.lasting() ? entry_of_script(request, script_, format) : std::string()) {}

std::optional<RunRecord> RunCache::load_entry() const {
    const auto known = entry_.empty() ? std::nullopt : cache_.load_entry(entry_);
    if (!known) return {};
    try {
        const auto inputs = from_cbor<InputsRead>(*known, ValueLimits::own());
        if (!unchanged(inputs)) return {};
        const auto folder = cache_.find(entry_of_run(entry_, inputs));
        if (!folder) return {};
        return unpacked(read_file(*folder / kRecord), *folder);
    } catch (const std::exception&) {  // deleted meanwhile, or corrupt: the script is then run
        return {};
    }
}

void RunCache::save_entry(const RunRecord& record) const {
    if (entry_.empty() || record.error || names_a_line(record)) return;
    try {
        keep(record);
    } catch (const std::exception&) {  // a full disk, say: the next run does without
    }
}

void RunCache::keep(const RunRecord& record) const {
    const InputsRead inputs = inputs_read(record.files_read, script_.parent_path());
    const fs::path folder = cache_.prepare();
    for (const auto& [name, figure] : record.figures) fs::copy_file(figure.file, folder / figure.file.filename());
    write_file_atomically(folder / kRecord, cbor_of(record));
    cache_.commit(folder, entry_of_run(entry_, inputs));
    cache_.save_entry(entry_, cbor_of(inputs));
}

}  // namespace dynlab::inline workflow
