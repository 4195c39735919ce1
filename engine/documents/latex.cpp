#include "documents/latex.h"

#include <fmt/ranges.h>
#include <re2/re2.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <optional>

#include "data_io/values/cbor_values.h"
#include "documents/text_lines.h"
#include "documents/words/scripts.h"
#include "documents/work_file.h"
#include "platform/cache.h"
#include "platform/child_process.h"
#include "platform/program_identity.h"
#include "platform/program_lookup.h"
#include "platform/sandbox.h"
#include "platform/temporary_folder.h"
#include "platform/text/foreign_text.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr int kMaxPasses = 4;
constexpr std::uint64_t kMemoryLimit = 1u << 30, kMaxFileBytes = 64u << 20;
constexpr std::uint64_t kLualatexMemoryLimit = 4ull << 30;  // reading the Chinese, Arabic and other fonts of a class
constexpr std::array kAuxiliaryFiles = {"main.aux", "main.out", "main.toc"};

/// The program that sets a document.
struct Engine {
    const char *program, *package;
};
constexpr Engine kPdflatex = {"pdflatex", "texlive-latex-base"}, kLualatex = {"lualatex", "texlive-luatex"};

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
    KeptAuxiliaryFiles(const LatexJob& job, const Engine& engine) : job_(job) {
        if (!job.use_cache) return;
        cache_.emplace();
        if (!cache_->lasting()) return;
        entry_ = EntryName("latex-references").add(job.identity).add(job.layout.language).add(engine.program).text();
        before_ = cache_->load_entry(entry_).value_or("");
        if (!before_.empty()) write_files();
    }

    void keep() const {
        if (entry_.empty()) return;
        std::vector<std::string> files;
        for (const char* name : kAuxiliaryFiles) files.push_back(read_work_file(job_.work_folder / name));
        if (const std::string now = cbor_of(files); now != before_) cache_->save_entry(entry_, now);
    }

  private:
    void write_files() const {
        std::vector<std::string> files;
        try {
            files = from_cbor<std::vector<std::string>>(before_, ValueLimits::own());
        } catch (const ValueError&) {  // an entry of another form: LaTeX needs one more pass
        }
        for (std::size_t i = 0; i < kAuxiliaryFiles.size() && i < files.size(); ++i)
            if (!files[i].empty()) write_work_file(job_.work_folder / kAuxiliaryFiles[i], files[i]);
    }

    const LatexJob& job_;
    std::optional<Cache> cache_;  ///< none where nothing is to be found or left
    std::string entry_, before_;
};

/// "./main.tex:12: Undefined control sequence." and the line "l.12 text so far" below it.
LatexRefusal refusal_in(const std::string& log, int lines_before_body, const Engine& engine) {
    static const RE2 placed(R"((?m)^(?:\./)?main\.(tex|vrb):(\d+): (.*))", RE2::Latin1),
        unplaced("(?m)^! ?(.*)", RE2::Latin1), context(R"((?m)^l\.\d+ (.*))", RE2::Latin1);
    re2::StringPiece rest = log;
    int line = 0;
    std::string ending, message, before;
    if (RE2::FindAndConsume(&rest, placed, &ending, &line, &message)) {
        // Code on slides is set from a separate file, whose lines are not those of the body.
        line = ending == "tex" ? line - lines_before_body : 0;
    } else if (!RE2::FindAndConsume(&rest, unplaced, &message)) {
        return LatexRefusal(Message("{} stopped without a message", engine.program), 0, "");
    }
    RE2::PartialMatch(rest, context, &before);
    return LatexRefusal(Message::verbatim(trimmed(message)), line,
                        before.starts_with("...") ? before.substr(3) : before);
}

/// Letters that no font of LuaLaTeX has, which it leaves out of the page.
struct MissingLetters {
    std::set<char32_t> letters;
};

void check_letters(const std::string& log) {
    static const RE2 missing(R"(\nMissing character: There is no [^\n]*? \(U\+([0-9A-F]+)\))", RE2::Latin1);
    MissingLetters found;
    std::string code;
    for (re2::StringPiece rest = log; RE2::FindAndConsume(&rest, missing, &code);)
        found.letters.insert(static_cast<char32_t>(std::stoul(code, nullptr, 16)));
    if (!found.letters.empty()) throw found;
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
        slides.items.push_back(Message("the content of slide {} is {} mm too tall", number, std::ceil(excess)));
    }
    if (!slides.items.empty())
        throw LatexRefusal(
            Message("{}; shorten the text, reduce the height of a figure, or split the slide in two", slides), first,
            "");
}

class LatexRun {
  public:
    /// By pdflatex.
    explicit LatexRun(const LatexJob& job) : job_(job) {
        format_folder_ = job.format_folder;
        if (format_folder_.empty() && job.use_cache) {
            const auto start = std::chrono::steady_clock::now();
            format_folder_ = job.begun_format ? job.begun_format->folder() : CachedLatexFormat(job.layout).folder();
            note("latex format", start);
        }
        write_document("", job.body);
    }

    /// By LuaLaTeX, which cannot store a preamble with its fonts: it reads the preamble in each run. `letters`: those
    /// of the body beyond ASCII.
    LatexRun(const LatexJob& job, const std::set<std::string>& scripts, const std::set<char32_t>& letters,
             const std::string& body)
        : job_(job), engine_(kLualatex), fonts_(job.lualatex_fonts) {
        if (fonts_.empty() && job.use_cache) fonts_ = kept_fonts();
        std::string codes;
        for (const char32_t letter : letters) codes += fmt::format("{{{:X}}}", static_cast<std::uint32_t>(letter));
        write_document(
            fmt::format("\\def\\dynlabscripts{{{}}}\\def\\dynlabletters{{{}}}", fmt::join(scripts, ","), codes), body);
    }

    fs::path pdf() {
        const bool has_contents = job_.body.find("\n\\tableofcontents\n") != std::string::npos;
        const KeptAuxiliaryFiles kept(job_, engine_);
        std::string before = references(job_.work_folder, has_contents), after;
        for (int pass = 1; pass <= kMaxPasses; ++pass) {
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

    /// Reads preamble, fonts and text, and writes no PDF.
    void read_all() const { run_pass(1, true); }

  private:
    void write_document(const std::string& before_preamble, const std::string& body) {
        if (format_folder_.empty()) {
            write_preamble(job_.layout, job_.work_folder);
            lines_before_body_ = 1;
        }
        write_work_file(job_.work_folder / "main.tex",
                        (format_folder_.empty() ? before_preamble + "\\input{preamble}\n" : "") + body);
    }

    /// The cache's folder for what LuaLaTeX keeps of fonts.
    static fs::path kept_fonts() {
        const Cache cache;
        const std::string name = EntryName("lualatex-fonts", file_stamp(*find_program(kLualatex.program))).text();
        if (const auto folder = cache.find(name)) return *folder;
        return cache.commit(cache.prepare(), name);
    }

    void note(const std::string& step, std::chrono::steady_clock::time_point start) const {
        if (!job_.timings) return;
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        job_.timings->emplace_back(step, seconds.count());
    }

    ChildOptions command(bool draft) const {
        ChildOptions child;
        child.command = {engine_.program, "-no-shell-escape", "-interaction=nonstopmode", "-halt-on-error",
                         "-file-line-error"};
        if (engine_.program == kLualatex.program) child.command.push_back("--nosocket");
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
                             {"LC_ALL", "C.UTF-8"},
                             {"TEXINPUTS", template_files(job_.layout)}};
        if (!format_folder_.empty()) child.environment.emplace_back("TEXFORMATS", format_folder_.string() + ":");
        if (engine_.program == kLualatex.program) {
            const std::string own = (job_.work_folder / "fonts").string();
            child.environment.emplace_back("OSFONTDIR", kNotoFolders);
            child.environment.emplace_back("TEXMFCACHE", fonts_.empty() ? own : fonts_.string() + ":" + own);
        }
        child.processor_time = 120s;
        child.timeout = 1200s;  // of a machine that others keep busy
        child.memory_bytes = engine_.program == kLualatex.program ? kLualatexMemoryLimit : kMemoryLimit;
        child.file_bytes = kMaxFileBytes;
        return child;
    }

    /// LuaTeX's own language can access files and programs. Allowed formulas cannot access that language; the sandbox
    /// is the second barrier. A document that is made inside a sandbox cannot have another one.
    bool is_sandboxed() const {
        return engine_.program == kLualatex.program && strongest_isolation() == Isolation::kFull;
    }

    ChildResult run_sandboxed(const ChildOptions& requested) const {
        Sandbox sandbox(Isolation::kFull);
        sandbox.add_document_programs();
        const fs::path shared = fs::absolute(job_.layout.shared_templates);
        sandbox.add(shared, shared.string());
        for (const fs::path& folder : {fs::absolute(job_.work_folder), fonts_})
            if (!folder.empty()) sandbox.add_writable(folder, folder.string());
        for (const auto& [name, value] : requested.environment) sandbox.set_environment(name, value);
        Sandbox::Limits limits;
        limits.time = {*requested.processor_time, static_cast<int>(*requested.timeout / *requested.processor_time)};
        limits.file_bytes = requested.file_bytes;
        limits.memory_bytes = requested.memory_bytes;
        return sandbox.run(requested.command, fs::absolute(job_.work_folder), "", limits);
    }

    void run_pass(int pass, bool draft) const {
        const auto start = std::chrono::steady_clock::now();
        const ChildResult run =
            is_sandboxed() ? run_sandboxed(command(draft)) : run_child(command(draft), engine_.package);
        note("latex pass " + std::to_string(pass), start);
        if (run.timed_out)
            throw LatexRefusal(Message("{} exceeded the limit of two minutes of processor time and was stopped; "
                                       "shorten the document, or check the text for a macro that calls itself",
                                       engine_.program),
                               0, "");
        if (run.exit_code == 128 + SIGXFSZ)
            throw LatexRefusal(Message("{} wrote a file larger than 64 MB; use smaller pictures", engine_.program), 0,
                               "");
        if (run.output_exceeded)
            throw LatexRefusal(
                Message("{} wrote too many messages and was stopped; check the text for a macro that calls itself",
                        engine_.program),
                0, "");
        const std::string log = "\n" + run.output;
        if (run.exit_code != 0) {
            check_missing_packages(log);
            throw refusal_in(log, lines_before_body_, engine_);
        }
        const std::string messages = "\n" + read_work_file(job_.work_folder / "main.log");
        if (engine_.program == kLualatex.program) check_letters(messages);
        check_nothing_dropped(messages);
        if (job_.layout.slides) check_nothing_overflows(messages, lines_before_body_);
    }

    const LatexJob& job_;
    Engine engine_ = kPdflatex;
    fs::path format_folder_, fonts_;
    int lines_before_body_ = 0;
};

bool has_lualatex() {
    if (!find_program(kLualatex.program)) return false;
    ChildOptions look_up;
    look_up.command = {"kpsewhich", "luaotfload.sty"};
    return run_child(look_up, "texlive-binaries").exit_code == 0;
}

/// What all fonts of a preamble are needed for.
constexpr char kFontSample[] =
    "\\begin{document}\\dynlabfonts\\small\\dynlabfonts\\footnotesize\\dynlabfonts\\large\\dynlabfonts\\LARGE"
    "\\dynlabfonts\\end{document}\n";

}  // namespace

LatexDocument run_latex(const LatexJob& job) {
    const PrintableCharacters pdflatex = printable_by_pdflatex(job.layout.shared_templates);
    LatexJob composed_job = job;
    composed_job.body = composed(job.body);
    const std::string& body = composed_job.body;
    LatexDocument result;
    const std::string seen = without_directions(body);
    result.first_beyond = first_beyond(pdflatex, seen);
    if (!result.first_beyond) {
        composed_job.body = seen;
        result.pdf = LatexRun(composed_job).pdf();
        return result;
    }
    result.by_lualatex = has_lualatex();
    if (!result.by_lualatex) {
        result.replaced = letters_beyond(pdflatex, body);
        if (result.replaced.empty()) result.first_beyond.reset();  // Greek words, of symbols
        composed_job.body = without_letters(body, result.replaced);
        result.pdf = LatexRun(composed_job).pdf();
        return result;
    }
    const std::set<std::string> scripts = scripts_of(pdflatex, body);
    const std::string directed = with_direction_marks(body);
    constexpr char32_t kUnknown = 0xFFFD;  // replaces bytes that were no text; LuaTeX stops at it
    const std::set<char32_t> letters = characters_beyond_ascii(body);
    if (letters.contains(kUnknown)) result.replaced = {kUnknown};
    while (true) {  // a later pass may come to further letters
        try {
            result.pdf = LatexRun(composed_job, scripts, letters, without_letters(directed, result.replaced)).pdf();
            return result;
        } catch (const MissingLetters& missing) {
            const std::size_t known = result.replaced.size();
            result.replaced.insert(missing.letters.begin(), missing.letters.end());
            if (result.replaced.size() == known)
                throw LatexRefusal(Message("no font has the letter {}; remove the letter from the text",
                                           code_of(*missing.letters.begin())),
                                   0, "");
        }
    }
}

void make_lualatex_fonts(const LatexLayout& layout, const std::set<std::string>& scripts, const fs::path& folder) {
    if (!has_lualatex()) return;
    const TemporaryFolder work;
    LatexJob job{kFontSample, layout, work.path(), "", false};
    job.lualatex_fonts = folder;
    LatexRun(job, scripts, {}, job.body).read_all();
}

}  // namespace dynlab::inline documents
