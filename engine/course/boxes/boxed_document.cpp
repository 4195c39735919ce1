#include "course/boxes/boxed_document.h"

#include "course/boxes/boxed_work.h"
#include "course/boxes/job_descriptions.h"
#include "documents/document.h"
#include "documents/error.h"
#include "documents/latex_format.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr auto kTimeOfDocument = std::chrono::seconds(30);

std::string in_ascii(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) > 126) c = '?';
    return text;
}

RunRecord in_ascii(RunRecord record) {
    for (auto& [name, value] : record.values) value.text = in_ascii(value.text);
    for (auto& [name, text] : record.texts) text.markdown = in_ascii(text.markdown);
    for (auto& [name, figure] : record.figures) figure.caption = in_ascii(figure.caption);
    for (auto& [name, table] : record.tables) {
        for (std::string& cell : table.header) cell = in_ascii(cell);
        for (auto& row : table.rows)
            for (std::string& cell : row) cell = in_ascii(cell);
    }
    return record;
}

/// Everything in `from` to the folder `to`.
void place_all(const fs::path& from, const fs::path& to) {
    for (const auto& entry : fs::recursive_directory_iterator(from)) {
        if (!entry.is_regular_file() || entry.is_symlink()) continue;
        const fs::path copy = to / entry.path().lexically_relative(from);
        fs::create_directories(copy.parent_path());
        place_file_atomically(entry.path(), copy);
    }
}

}  // namespace

const fs::path& BoxedDocuments::latex_format(bool french) const {
    CompiledLayout& compiled = french ? french_ : english_;
    std::call_once(compiled.made, [&] {
        LatexLayout layout;
        layout.shared_templates = shared_folder() / "report_templates";
        if (french) layout.language = "fr";
        make_latex_format(layout, compiled.folder.path());
    });
    return compiled.folder.path();
}

void BoxedDocuments::make(const std::string& template_name, const RunRecord& record, const fs::path& output,
                          const std::map<std::string, std::string>& metadata) const {
    const TemporaryFolder made;
    Box box(isolation_);
    box.add_document_home(shared_folder() / "data");
    DocumentJob job;
    job.template_name = template_name;
    job.metadata = metadata;
    job.record.values = record.values;
    job.record.texts = record.texts;
    job.record.tables = record.tables;
    for (const auto& [name, figure] : record.figures) {
        const fs::path file = box.add(figure.file, "/box/figures/" + figure.file.filename().string());
        job.record.figures[name] = {{}, figure.caption, file, figure.order};
    }
    if (document_format(output) == DocumentFormat::kPdf) {
        const auto language = metadata.find("lang");
        job.latex_format = box.add(latex_format(language != metadata.end() && language->second == "fr"), "/box/format");
    }
    job.to = box.add_writable(made.path(), "/box/made") / output.filename();
    const auto result = run_boxed(box, program_, job, {kTimeOfDocument});
    if (!result.output) throw EnvironmentError("{} cannot be made: {}", output.filename().string(), result.reason);
    place_all(made.path(), output.parent_path());
}

BoxedOutcome make_boxed_document(const DocumentJob& job) {
    DocumentMaker::Options options;
    options.use_cache = false;
    if (job.latex_format) options.latex_format = *job.latex_format;
    const DocumentMaker maker(options);
    DocumentSource source;
    source.template_file = shared_folder() / "report_templates" / job.template_name;
    source.metadata = job.metadata;
    const auto make = [&](const RunRecord& record) {
        source.record = &record;
        maker.make(source, job.to, document_format(job.to), [] {});
    };
    try {
        make(job.record);
    } catch (const DocumentError&) {
        for (auto& [key, value] : source.metadata) value = in_ascii(value);
        make(in_ascii(job.record));  // letters that LaTeX does not have
    }
    return {};
}

}  // namespace dynlab::inline course
