#include "course/sandbox_jobs/sandboxed_document.h"

#include <algorithm>

#include "course/sandbox_jobs/job_descriptions.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "documents/document.h"
#include "documents/latex.h"
#include "documents/words/scripts.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr auto kTimeOfDocument = std::chrono::seconds(30);

/// All text that the run results and the metadata contribute to a document.
std::string text_of(const RunRecord& record, const std::map<std::string, std::string>& metadata) {
    std::string text;
    const auto add = [&text](const std::string& more) { text += more + "\n"; };
    for (const auto& [key, value] : metadata) add(value);
    for (const auto& [name, value] : record.values) add(value.text);
    for (const auto& [name, entry] : record.texts) add(entry.markdown);
    for (const auto& [name, figure] : record.figures) add(figure.caption);
    for (const auto& [name, table] : record.tables) {
        for (const std::string& cell : table.header) add(cell);
        for (const auto& row : table.rows)
            for (const std::string& cell : row) add(cell);
    }
    return text;
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

const fs::path& SandboxedDocuments::latex_format(bool french) const {
    CompiledLayout& compiled = french ? french_ : english_;
    std::call_once(compiled.made, [&] {
        LatexLayout layout;
        layout.shared_templates = shared_folder() / "report_templates";
        if (french) layout.language = "fr";
        make_latex_format(layout, compiled.folder.path());
    });
    return compiled.folder.path();
}

std::optional<fs::path> SandboxedDocuments::lualatex_fonts(const std::string& text) const {
    LatexLayout layout;
    layout.shared_templates = shared_folder() / "report_templates";
    const PrintableCharacters pdflatex = printable_by_pdflatex(layout.shared_templates);
    if (!first_beyond(pdflatex, text)) return {};
    const std::scoped_lock lock(mutex_);
    std::set<std::string> scripts = scripts_of(pdflatex, text);
    std::erase_if(scripts, [this](const std::string& script) { return read_.contains(script); });
    if (!scripts.empty() || read_.empty()) make_lualatex_fonts(layout, scripts, fonts_.path());
    read_.insert("");
    read_.merge(scripts);
    return fonts_.path();
}

void SandboxedDocuments::keep(const std::vector<Message>& notes) const {
    const std::scoped_lock lock(mutex_);
    for (const Message& note : notes)
        if (std::ranges::none_of(notes_, [&note](const Message& kept) { return kept.id() == note.id(); }))
            notes_.push_back(note);
}

std::vector<Message> SandboxedDocuments::notes() const {
    const std::scoped_lock lock(mutex_);
    return notes_;
}

void SandboxedDocuments::make(const std::string& template_name, const RunRecord& record, const fs::path& output,
                              const std::map<std::string, std::string>& metadata) const {
    const TemporaryFolder made;
    Sandbox sandbox(isolation_);
    sandbox.add_document_home(shared_folder() / "data");
    DocumentJob job;
    job.template_name = template_name;
    job.metadata = metadata;
    job.record.values = record.values;
    job.record.texts = record.texts;
    job.record.tables = record.tables;
    for (const auto& [name, figure] : record.figures) {
        const fs::path file = sandbox.add(figure.file, "/box/figures/" + figure.file.filename().string());
        job.record.figures[name] = {{}, figure.caption, file, figure.order};
    }
    if (document_format(output) == DocumentFormat::kPdf) {
        const auto language = metadata.find("lang");
        job.latex_format =
            sandbox.add(latex_format(language != metadata.end() && language->second == "fr"), "/box/format");
        if (const auto fonts = lualatex_fonts(text_of(record, metadata)))
            job.lualatex_fonts = sandbox.add(*fonts, "/box/fonts");
    }
    job.to = sandbox.add_writable(made.path(), "/box/made") / output.filename();
    const auto result = run_in_sandbox(sandbox, program_, job, {kTimeOfDocument});
    if (!result.output) throw EnvironmentError("{} cannot be created: {}", output.filename().string(), result.reason);
    keep(result.output->notes);
    place_all(made.path(), output.parent_path());
}

SandboxOutcome make_sandboxed_document(const DocumentJob& job) {
    DocumentMaker::Options options;
    options.use_cache = false;
    if (job.latex_format) options.latex_format = *job.latex_format;
    if (job.lualatex_fonts) options.lualatex_fonts = *job.lualatex_fonts;
    SandboxOutcome outcome;
    options.notes = &outcome.notes;
    DocumentSource source;
    source.template_file = shared_folder() / "report_templates" / job.template_name;
    source.metadata = job.metadata;
    source.record = &job.record;
    DocumentMaker(options).make(source, job.to, document_format(job.to), [] {});
    return outcome;
}

}  // namespace dynlab::inline course
