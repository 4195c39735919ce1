#include "course/review/version_reading.h"

#include "base/error.h"
#include "course/boxes/boxed_work.h"
#include "course/boxes/told_reason.h"
#include "course/intake/staging.h"
#include "course/review/version_description.h"
#include "documents/text_lines.h"
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
constexpr std::uintmax_t kMostText = 4u << 20;

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

/// A small ordinary file, or nothing.
std::optional<std::string> text_of_file(const fs::path& file) {
    std::error_code error;
    if (fs::symlink_status(file, error).type() != fs::file_type::regular) return {};
    if (fs::file_size(file, error) > kMostText || error) return {};
    return read_work_file(file);
}

std::optional<ShownRecord> record_in(const fs::path& file) {
    const auto text = text_of_file(file);
    return text ? shown_record(*text) : std::nullopt;
}

class VersionReader {
  public:
    VersionReader(const VersionFiles& files, Isolation level, const fs::path& program)
        : files_(files), level_(level), program_(program) {}

    ReadVersion run() {
        if (files_.pack) read_pack();
        if (files_.pdf) read_pdf(*files_.pdf, Message("The PDF"));
        return std::move(version_);
    }

  private:
    void read_pack() {
        Submission submission;
        submission.path = *files_.pack;
        submission.archive = true;
        const fs::path staged = work_.path() / "staged", made = work_.path() / "made";
        fs::create_directories(staged);
        fs::create_directories(made);
        try {
            const fs::path folder = stage_submission(submission, staged, level_, program_).folder;
            const Message reason = make_version_in_box(folder, made, !files_.pdf, level_, program_);
            if (!reason.empty())
                version_.troubles.push_back(Message("The pack's report could not be made again: {}.", reason));
            read_made(folder, made);
        } catch (const SubmissionError& error) {
            version_.troubles.push_back(Message("The pack: {}", error.message()));
        }
    }

    void read_made(const fs::path& folder, const fs::path& made) {
        version_.record = record_in(made / "record.json");
        if (!version_.record || version_.record->failed) {
            if (auto own = record_in(folder / "record.json")) {
                version_.record = std::move(own);
                version_.record_found = true;
            }
        }
        if (const auto text = text_of_file(made / "report.md")) version_.source = report_text_of_markdown(*text);
        if (files_.pdf) return;
        for (const fs::path& pdf : {made / "report.pdf", folder / "report.pdf"}) {
            if (fs::symlink_status(pdf).type() != fs::file_type::regular) continue;
            read_pdf(pdf, Message("The pack's PDF"));
            return;
        }
    }

    void read_pdf(const fs::path& file, const Message& what) {
        try {
            const PdfLayout layout = read_pdf_layout(file);
            version_.pages = static_cast<int>(layout.pages.size());
            ReportText text = report_text_of_pdf(text_of_layout(layout));
            if (text.sentences.empty())
                version_.troubles.push_back(Message("{} holds no text that can be read.", what));
            else
                version_.printed = std::move(text);
        } catch (const PdfRefusal& refusal) {
            version_.troubles.push_back(Message("{} cannot be read: {}", what, refusal.message()));
        }
    }

    const VersionFiles& files_;
    Isolation level_;
    const fs::path& program_;
    TemporaryFolder work_;
    ReadVersion version_;
};

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

BoxedOutcome make_version(const VersionJob& job) {
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

Message make_version_in_box(const fs::path& folder, const fs::path& made, bool pdf, Isolation level,
                            const fs::path& program) {
    Box box(level);
    box.add_document_home(shared_folder() / "data");
    VersionJob job;
    job.folder = box.add_writable(folder, "/box/submission");
    job.to = box.add_writable(made, "/box/made");
    job.pdf = pdf;
    const auto result = run_boxed(box, program, job, {kReadingTime});
    const Message& reason = result.output && result.output->error ? *result.output->error : result.reason;
    return with_changed_text(reason, [&job](const std::string& text) {
        return without_full_stop(told_outside(first_line(text), job.folder));
    });
}

ReadVersion read_version(const VersionFiles& files, Isolation level, const fs::path& program) {
    return VersionReader(files, level, program).run();
}

}  // namespace dynlab::inline course
