#include "course/grading/boxed_document.h"

#include "course/grading/boxed_work.h"
#include "documents/document.h"
#include "documents/error.h"
#include "documents/latex_format.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr auto kTimeOfDocument = std::chrono::seconds(30);

/// What of a record reaches such documents.
json json_of(const RunRecord& record) {
    json j = {{"values", json::object()}, {"texts", json::object()}, {"tables", json::object()}};
    for (const auto& [name, value] : record.values) j["values"][name] = value.text;
    for (const auto& [name, text] : record.texts) j["texts"][name] = text.markdown;
    for (const auto& [name, table] : record.tables)
        j["tables"][name] = {{"header", table.header}, {"rows", table.rows}};
    return j;
}

RunRecord record_of_content(const json& j) {
    RunRecord record;
    for (const auto& [name, value] : j.at("values").items()) record.values[name] = {{}, value};
    for (const auto& [name, text] : j.at("texts").items()) record.texts[name] = {text};
    for (const auto& [name, table] : j.at("tables").items())
        record.tables[name] = {table.at("header"), table.at("rows")};
    for (const auto& [name, figure] : j.at("figures").items()) {
        record.figures[name].caption = figure.at("caption");
        record.figures[name].file = figure.at("file").get<std::string>();
    }
    return record;
}

json in_ascii(const json& j) {
    if (!j.is_string() && !j.is_structured()) return j;
    if (j.is_structured()) {
        json result = j;
        for (auto& part : result) part = in_ascii(part);
        return result;
    }
    std::string text = j;
    for (char& c : text)
        if (static_cast<unsigned char>(c) > 126) c = '?';
    return text;
}

/// Everything in `from` to the folder `to`.
void place_all(const fs::path& from, const fs::path& to) {
    for (const auto& entry : fs::recursive_directory_iterator(from)) {
        if (!entry.is_regular_file() || entry.is_symlink()) continue;
        const fs::path place = to / entry.path().lexically_relative(from);
        fs::create_directories(place.parent_path());
        place_file_atomically(entry.path(), place);
    }
}

}  // namespace

const fs::path& BoxedDocuments::latex_format() const {
    std::call_once(format_made_, [&] {
        LatexLayout layout;
        layout.shared_templates = shared_folder() / "report_templates";
        make_latex_format(layout, format_.path());
    });
    return format_.path();
}

void BoxedDocuments::make(const std::string& template_name, const RunRecord& record, const fs::path& output) const {
    const TemporaryFolder made;
    Box box(isolation_);
    box.add_document_programs();
    const fs::path templates = box.add(shared_folder() / "report_templates", "/box/home/report_templates");
    box.add(shared_folder() / "data", "/box/home/data");
    box.set_environment("DYNLAB_HOME", templates.parent_path().string());
    json job = {{"work", "document"}, {"template", template_name}, {"record", json_of(record)}};
    job["record"]["figures"] = json::object();
    for (const auto& [name, figure] : record.figures) {
        const fs::path file = box.add(figure.file, "/box/figures/" + figure.file.filename().string());
        job["record"]["figures"][name] = {{"caption", figure.caption}, {"file", file.string()}};
    }
    const bool pdf = document_format(output) == DocumentFormat::kPdf;
    if (pdf) job["format"] = box.add(latex_format(), "/box/format").string();
    job["to"] = (box.add_writable(made.path(), "/box/made") / output.filename()).string();
    const BoxedResult result = run_boxed(box, program_, job, kTimeOfDocument);
    if (!result.output) throw EnvironmentError(output.filename().string() + " cannot be made: " + result.reason);
    place_all(made.path(), output.parent_path());
}

json make_boxed_document(const json& job) {
    const fs::path to = job.at("to").get<std::string>();
    DocumentMaker::Options options;
    options.use_cache = false;
    if (job.contains("format")) options.latex_format = job.at("format").get<std::string>();
    const DocumentMaker maker(options);
    DocumentSource source;
    source.template_file = shared_folder() / "report_templates" / job.at("template").get<std::string>();
    const auto make = [&](const json& content) {
        const RunRecord record = record_of_content(content);
        source.record = &record;
        maker.make(source, to, document_format(to), [] {});
    };
    try {
        make(job.at("record"));
    } catch (const DocumentError&) {
        make(in_ascii(job.at("record")));  // letters that LaTeX does not have
    }
    return json::object();
}

}  // namespace dynlab::inline course
