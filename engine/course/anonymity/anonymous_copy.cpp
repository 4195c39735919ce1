#include "course/anonymity/anonymous_copy.h"

#include <algorithm>
#include <csignal>
#include <utility>

#include "base/reader.h"
#include "course/anonymity/anonymity_issues.h"
#include "course/intake/staging.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "documents/pdf/distilled_pdf.h"
#include "documents/pdf/pdf_layout.h"
#include "documents/work_file.h"
#include "platform/atomic_file.h"
#include "platform/hash.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/terminal_text.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxFile = 64ull << 20, kMaxMade = 200ull << 20, kSpaceForReport = 8ull << 20;

std::uint64_t bytes_below(const fs::path& folder) {
    std::uint64_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (fs::is_regular_file(entry.symlink_status())) bytes += entry.file_size();
    return bytes;
}

bool is_pdf(const fs::path& file) {
    return ending_of(file) == ".pdf";
}

/// report.pdf in the folder or below, else the only PDF.
std::optional<fs::path> pdf_below(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (fs::is_regular_file(entry.symlink_status()) && is_pdf(entry.path())) found.push_back(entry.path());
    std::ranges::sort(found);
    const auto usual =
        std::find_if(found.begin(), found.end(), [](const fs::path& file) { return file.filename() == "report.pdf"; });
    if (usual != found.end()) return *usual;
    return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
}

/// The layout of the original PDF; empty if it cannot be read. Printing can lose the mapping from the glyphs of some
/// scripts to letters; the anonymity check then takes the letters from the original PDF.
PdfLayout layout_or_nothing(const fs::path& file) {
    try {
        return read_pdf_layout(file);
    } catch (const PdfRefusal&) {
        return {};
    }
}

/// The making of one copy.
class CopyingAnonymously {
  public:
    CopyingAnonymously(const fs::path& submission, const AnonymousCopySetup& setup)
        : submission_(submission), setup_(setup) {}

    AnonymousCopy make(const fs::path& copy) {
        const std::optional<fs::path> original = found_original();
        if (!original) return std::move(result_);
        try {
            const std::string bytes = distilled_pdf(*original, {setup_.isolation, {std::chrono::seconds(60)}, {}});
            const fs::path printed = work_.path() / "copy.pdf";
            write_work_file(printed, bytes);
            const PdfLayout source = layout_or_nothing(*original);
            result_.findings = anonymity_findings(printed, read_pdf_layout(printed), setup_.names, {}, &source);
            const bool clean = std::ranges::none_of(
                result_.findings, [](const Issue& issue) { return issue.severity == Severity::kRule; });
            result_.made = clean || setup_.accept;
            if (!result_.made) return std::move(result_);
            write_file_atomically(copy, bytes);
            result_.hash = sha256_of(bytes);
        } catch (const PdfRefusal& refusal) {
            refuse_full_disk(work_.path(), 2 * fs::file_size(*original));
            result_.made = false;
            result_.error_reason = refusal.message();
        }
        return std::move(result_);
    }

  private:
    /// The PDF made again or submitted; says in the result which, or why there is none.
    std::optional<fs::path> found_original() {
        if (fs::is_regular_file(submission_) && is_pdf(submission_)) return submission_;
        Submission given;
        given.path = submission_;
        given.archive = !fs::is_directory(submission_);
        const fs::path staged = work_.path() / "staged";
        fs::create_directories(staged);
        std::optional<fs::path> source;
        try {
            source = stage_submission(given, staged, setup_.isolation, setup_.program).folder;
        } catch (const SubmissionError& error) {
            result_.error_reason = error.message();
        }
        if (source && setup_.rebuild && fs::is_regular_file(*source / "report.md") && makes_report(*source)) {
            result_.rebuilt = true;
            result_.error_reason = Message();
            return report();
        }
        const std::optional<fs::path> pdf = pdf_below(staged);
        if (pdf)
            result_.not_rebuilt = std::exchange(result_.error_reason, Message());
        else if (result_.error_reason.empty())
            result_.error_reason = Message(
                "The report cannot be created again, "
                "and the submission contains neither report.pdf nor a single other PDF.");
        return pdf;
    }

    fs::path report() const { return work_.path() / "made" / "report.pdf"; }

    bool makes_report(const fs::path& folder) {
        fs::create_directories(report().parent_path());
        Sandbox sandbox(setup_.isolation);
        sandbox.add_document_home(shared_folder() / "data");
        const fs::path inside = sandbox.add(folder, "/box/submission");
        const fs::path out = sandbox.add_writable(report().parent_path(), "/box/made");
        const fs::path program = sandbox.add_program(setup_.program);
        Sandbox::Limits limits;
        limits.time = setup_.report_time;
        limits.file_bytes = kMaxFile;
        const ChildResult child = sandbox.run(
            {program.string(), "report", inside.string(), "-o", (out / "report.pdf").string()}, {}, "", limits);
        const bool made = child.exit_code == 0 && fs::is_regular_file(report());
        if (!made) refuse_full_disk(report().parent_path(), kSpaceForReport);
        if (made && bytes_below(report().parent_path()) <= kMaxMade) return true;
        result_.error_reason =
            Message("The report cannot be created again: {}",
                    made ? Message("the report exceeds {} MB", kMaxMade >> 20) : reason_of(child, inside));
        return false;
    }

    Message reason_of(const ChildResult& child, const fs::path& folder) const {
        if (child.timed_out) return reason_of_end(child, setup_.report_time);
        if (child.exit_code == 128 + SIGXFSZ)
            return Message("the script writes a file larger than {} MB", kMaxFile >> 20);
        const std::string first_line = child.error_output.substr(0, child.error_output.find('\n'));
        return Message::verbatim(without_full_stop(terminal_text(without_sandbox_paths(first_line, folder))));
    }

    fs::path submission_;
    const AnonymousCopySetup& setup_;
    AnonymousCopy result_;
    TemporaryFolder work_;
};

}  // namespace

AnonymousCopy anonymous_copy(const fs::path& submission, const fs::path& copy, const AnonymousCopySetup& setup) {
    return CopyingAnonymously(submission, setup).make(copy);
}

}  // namespace dynlab::inline course
