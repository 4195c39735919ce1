#include "documents/latex.h"

#include <re2/re2.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <optional>

#include "data_io/values/cbor_values.h"
#include "documents/text_lines.h"
#include "documents/work_file.h"
#include "platform/cache.h"
#include "platform/child_process.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr int kMostPasses = 4;
constexpr std::uint64_t kMemoryLimit = 1u << 30, kLargestFile = 64u << 20;
constexpr std::array kAuxiliaryFiles = {"main.aux", "main.out", "main.toc"};

/// What a pass reads from the pass before. Lines for a table of contents count only where there is one.
std::string references(const fs::path& folder, bool has_contents) {
    std::string result;
    for (const char* name : kAuxiliaryFiles) {
        if (!has_contents && std::string_view(name) == "main.toc") continue;
        for (const std::string& line : lines_of(read_work_file(folder / name)))
            if (has_contents || !line.starts_with("\\@writefile{")) result += line + "\n";
    }
    return result;
}

/// The auxiliary files of a document's last run, kept between runs.
class KeptAuxiliaryFiles {
  public:
    explicit KeptAuxiliaryFiles(const LatexJob& job) : job_(job) {
        if (!job.use_cache) return;
        cache_.emplace();
        if (!cache_->lasting()) return;
        entry_ = EntryName("latex-references").add(job.identity).add(job.layout.language).text();
        before_ = cache_->recall(entry_).value_or("");
        if (!before_.empty()) write_files();
    }

    void keep() const {
        if (entry_.empty()) return;
        std::vector<std::string> files;
        for (const char* name : kAuxiliaryFiles) files.push_back(read_work_file(job_.work_folder / name));
        if (const std::string now = cbor_of(files); now != before_) cache_->remember(entry_, now);
    }

  private:
    void write_files() const {
        std::vector<std::string> files;
        try {
            files = from_cbor<std::vector<std::string>>(before_, ValueLimits::own());
        } catch (const ValueError&) {  // an entry of another form: pdflatex makes one pass more
        }
        for (std::size_t i = 0; i < kAuxiliaryFiles.size() && i < files.size(); ++i)
            if (!files[i].empty()) write_work_file(job_.work_folder / kAuxiliaryFiles[i], files[i]);
    }

    const LatexJob& job_;
    std::optional<Cache> cache_;  ///< none where nothing is to be found or left
    std::string entry_, before_;
};

/// "./main.tex:12: Undefined control sequence." and the line "l.12 text so far" below it.
LatexRefusal refusal_in(const std::string& log, int lines_before_body) {
    static const RE2 placed(R"((?m)^(?:\./)?main\.(tex|vrb):(\d+): (.*))", RE2::Latin1),
        unplaced("(?m)^! ?(.*)", RE2::Latin1), context(R"((?m)^l\.\d+ (.*))", RE2::Latin1);
    re2::StringPiece rest = log;
    int line = 0;
    std::string ending, message, before;
    if (RE2::FindAndConsume(&rest, placed, &ending, &line, &message)) {
        // Code on slides is set from a file of its own, whose lines are not those of the body.
        line = ending == "tex" ? line - lines_before_body : 0;
    } else if (!RE2::FindAndConsume(&rest, unplaced, &message)) {
        return LatexRefusal(Message("pdflatex stopped without a message"), 0, "");
    }
    RE2::PartialMatch(rest, context, &before);
    return LatexRefusal(Message::verbatim(trimmed(message)), line,
                        before.starts_with("...") ? before.substr(3) : before);
}

/// Complaints that LaTeX itself passes over, though something is missing on the page.
void check_nothing_dropped(const std::string& log) {
    static const RE2 dropped(
        R"(\n(Missing character: [^\n]*|[^\n]*invalid in math mode[^\n]*?)(?: on input line (\d+))?\.?\n)",
        RE2::Latin1);
    std::string complaint, line;
    if (RE2::PartialMatch(log, dropped, &complaint, &line))
        throw LatexRefusal(Message::verbatim(trimmed(complaint)), line.empty() ? 0 : std::stoi(line), "");
}

/// Slides whose content is higher than they are: it would run over their lower edge.
void check_nothing_overflows(const std::string& log, int lines_before_body) {
    static const RE2 overfull(R"(\nOverfull \\vbox \(([0-9.]+)pt too high\) detected at line (\d+))", RE2::Latin1),
        page(R"(\n\[(\d+))", RE2::Latin1);
    constexpr double kPointsPerMm = 72.27 / 25.4, kUnseen = 0.5;  // mm
    MessageList slides;
    std::string number;
    double points = 0;
    int first = 0, line = 0;
    for (re2::StringPiece rest = log; RE2::FindAndConsume(&rest, overfull, &points, &line);) {
        const double excess = points / kPointsPerMm;
        if (excess < kUnseen || !RE2::PartialMatch(rest, page, &number)) continue;
        if (slides.items.empty()) first = line - lines_before_body;
        slides.items.push_back(Message("slide {} is too full by {} mm", number, std::ceil(excess)));
    }
    if (!slides.items.empty())
        throw LatexRefusal(Message("{}; shorten the text, make a figure less high, or part the slide into two", slides),
                           first, "");
}

class LatexRun {
  public:
    explicit LatexRun(const LatexJob& job) : job_(job) {
        format_folder_ = job.format_folder;
        if (format_folder_.empty() && job.use_cache) {
            const auto start = std::chrono::steady_clock::now();
            format_folder_ = job.begun_format ? job.begun_format->folder() : CachedLatexFormat(job.layout).folder();
            note("latex format", start);
        }
        if (format_folder_.empty()) {
            write_preamble(job.layout, job.work_folder);
            lines_before_body_ = 1;
        }
        write_work_file(job.work_folder / "main.tex", (format_folder_.empty() ? "\\input{preamble}\n" : "") + job.body);
    }

    fs::path pdf() {
        const bool has_contents = job_.body.find("\n\\tableofcontents\n") != std::string::npos;
        const KeptAuxiliaryFiles kept(job_);
        std::string before = references(job_.work_folder, has_contents), after;
        for (int pass = 1; pass <= kMostPasses; ++pass) {
            // Where nothing is known of page counts and bookmarks there is another pass: the first writes no PDF.
            const bool draft = pass == 1 && before.empty();
            run_pass(pass, draft);
            after = references(job_.work_folder, has_contents);
            if (after == before && !draft) break;
            before = after;
        }
        kept.keep();
        return job_.work_folder / "main.pdf";
    }

  private:
    void note(const std::string& step, std::chrono::steady_clock::time_point start) const {
        if (!job_.timings) return;
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        job_.timings->emplace_back(step, seconds.count());
    }

    ChildOptions command(bool draft) const {
        ChildOptions child;
        child.command = {"pdflatex", "-no-shell-escape", "-interaction=nonstopmode", "-halt-on-error",
                         "-file-line-error"};
        if (draft) child.command.push_back("-draftmode");
        if (!format_folder_.empty()) child.command.push_back(std::string("-fmt=") + kLatexFormatName);
        child.command.push_back("main.tex");
        child.folder = job_.work_folder;
        child.environment = {{"SOURCE_DATE_EPOCH", "0"},
                             {"FORCE_SOURCE_DATE", "1"},
                             {"openin_any", "p"},
                             {"openout_any", "p"},
                             {"max_print_line", "10000"},
                             {"error_line", "254"},
                             {"half_error_line", "238"},
                             {"MKTEXPK", "0"},
                             {"MKTEXTFM", "0"},
                             {"MKTEXFMT", "0"},
                             {"TEXMFHOME", "/nonexistent"},
                             {"TEXMFOUTPUT", ""},
                             {"LC_ALL", "C.UTF-8"}};
        if (!format_folder_.empty()) child.environment.emplace_back("TEXFORMATS", format_folder_.string() + ":");
        child.processor_time = 120s;
        child.timeout = 1200s;  // of a machine that others keep busy
        child.memory_bytes = kMemoryLimit;
        child.file_bytes = kLargestFile;
        return child;
    }

    void run_pass(int pass, bool draft) const {
        const auto start = std::chrono::steady_clock::now();
        const ChildResult run = run_child(command(draft), "texlive-latex-base");
        note("latex pass " + std::to_string(pass), start);
        if (run.timed_out) throw LatexRefusal(Message("pdflatex did not finish within two minutes"), 0, "");
        if (run.exit_code == 128 + SIGXFSZ)
            throw LatexRefusal(Message("pdflatex wrote a file of more than 64 MB; use smaller pictures"), 0, "");
        if (run.output_exceeded) throw LatexRefusal(Message("pdflatex wrote messages without end"), 0, "");
        const std::string log = "\n" + run.output;
        if (run.exit_code != 0) {
            check_missing_packages(log);
            throw refusal_in(log, lines_before_body_);
        }
        const std::string messages = "\n" + read_work_file(job_.work_folder / "main.log");
        check_nothing_dropped(messages);
        if (job_.layout.slides) check_nothing_overflows(messages, lines_before_body_);
    }

    const LatexJob& job_;
    fs::path format_folder_;
    int lines_before_body_ = 0;
};

}  // namespace

fs::path run_latex(const LatexJob& job) {
    return LatexRun(job).pdf();
}

}  // namespace dynlab::inline documents
