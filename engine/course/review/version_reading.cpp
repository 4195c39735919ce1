#include "course/review/version_reading.h"

#include "base/error.h"
#include "course/intake/staging.h"
#include "course/review/version_description.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "documents/work_file.h"
#include "figures/gnuplot_renderer.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "workflow/make_report.h"
#include "workflow/run_script.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr auto kReadingTime = std::chrono::seconds(120);
constexpr std::uintmax_t kMaxSourceBytes = 16u << 20;

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

/// Only a regular file: a pack may hold links.
std::optional<std::string> text_of_file(const fs::path& file) {
    std::error_code error;
    if (fs::symlink_status(file, error).type() != fs::file_type::regular) return {};
    if (fs::file_size(file, error) > kMaxSourceBytes || error) return {};
    return read_work_file(file);
}

void read_pack(const fs::path& pack, Isolation level, const fs::path& program, ReadVersion& version) {
    const TemporaryFolder staged, made;
    Submission submission;
    submission.path = pack;
    submission.archive = true;
    try {
        const fs::path folder = stage_submission(submission, staged.path(), level, program).folder;
        const Message reason = make_version_in_sandbox(folder, made.path(), false, level, program);
        if (!reason.empty()) {
            version.problems.push_back(Message("The pack's analysis cannot be run: {}.", reason));
            return;
        }
        if (const auto text = text_of_file(made.path() / "report.md")) version.source = words_of_markdown(*text);
        if (const auto text = text_of_file(made.path() / "record.json")) version.record = record_from_json(*text);
    } catch (const SubmissionError& error) {
        version.problems.push_back(Message("The pack cannot be used: {}", error.message()));
    } catch (const ValueError&) {
        version.problems.push_back(Message("The pack's run results cannot be read."));
    }
}

void read_pdf(const fs::path& pdf, ReadVersion& version) {
    try {
        const PdfLayout layout = read_pdf_layout(pdf);
        version.pages = static_cast<int>(layout.pages.size());
        version.printed = words_of_pdf(text_of_layout(layout));
        if (version.printed->empty()) version.problems.push_back(Message("The PDF contains no readable text."));
    } catch (const PdfRefusal& refusal) {
        version.problems.push_back(Message("The PDF cannot be read: {}", refusal.message()));
    }
}

void make_document(const ReportRequest& request, RunRecord record, const fs::path& output, FigureFormat figures) {
    GnuplotRenderer renderer;
    const TemporaryFolder drawn;
    draw_figures(record, renderer, drawn.path(), figures, request.script.header.language);
    DocumentSource source;
    source.template_file = request.template_file;
    source.record = &record;
    DocumentMaker::Options options;
    options.use_cache = false;
    DocumentMaker(options).make(source, output, document_format(output), [&] { renderer.finish(); });
}

}  // namespace

SandboxOutcome make_version(const VersionJob& job) {
    const fs::path &folder = job.folder, &to = job.to;
    try {
        const ReportRequest request = report_of(folder.string(), to / "report.md");
        GnuplotRenderer renderer;
        const TemporaryFolder saved;
        RunRequest run;
        run.script = request.script;
        run.seed = request.seed;
        run.out_folder = saved.path();
        const RunRecord record = run_script(run, renderer);
        write_work_file(to / "record.json", to_json(record));
        make_document(request, record, to / "report.md", FigureFormat::kSvg);
        if (job.pdf) make_document(request, record, to / "report.pdf", FigureFormat::kPdf);
        if (record.error) return {with_place(*record.error)};
        return {};
    } catch (const std::runtime_error& error) {
        return {message_of(error)};
    }
}

Message make_version_in_sandbox(const fs::path& folder, const fs::path& made, bool pdf, Isolation level,
                                const fs::path& program) {
    Sandbox sandbox(level);
    sandbox.add_document_home(shared_folder() / "data");
    VersionJob job;
    job.folder = sandbox.add_writable(folder, "/box/submission");
    job.to = sandbox.add_writable(made, "/box/made");
    job.pdf = pdf;
    const auto result = run_in_sandbox(sandbox, program, job, {kReadingTime});
    const Message& reason = result.output && result.output->error ? *result.output->error : result.reason;
    return with_changed_text(reason, [&job](const std::string& text) {
        return without_full_stop(without_sandbox_paths(first_line(text), job.folder));
    });
}

ReadVersion read_version(const VersionFiles& files, Isolation level, const fs::path& program) {
    ReadVersion version;
    if (files.pack) read_pack(*files.pack, level, program, version);
    if (files.pdf) read_pdf(*files.pdf, version);
    return version;
}

}  // namespace dynlab::inline course
