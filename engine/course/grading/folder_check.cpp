#include "course/grading/folder_check.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <optional>
#include <thread>

#include "base/reader.h"
#include "course/grading/feedback.h"
#include "course/grading/folder_report.h"
#include "course/grading/grading_rules.h"
#include "course/grading/script_code.h"
#include "course/intake/folder_copy.h"
#include "course/intake/notebooks.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "data_io/dataset_index.h"
#include "documents/error.h"
#include "documents/solutions.h"
#include "documents/template_file.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/sandbox.h"
#include "platform/temporary_folder.h"
#include "workflow/make_report.h"
#include "workflow/notebooks/notebook.h"
#include "workflow/variant_data.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr const char *kOwnScript = "analysis.lua", *kOwnNotebook = "analysis.ipynb";

Message sentence_about(const UnplacedEntries& entries) {
    const bool one = entries.names.size() == 1;
    const MessageList names = entries.quoted_names();
    switch (entries.kind) {
        case UnplacedEntries::Kind::kTable:
            return one ? Message("In {}, the table {} is passed to the report but never shown.", kOwnScript, names)
                       : Message("In {}, the tables {} are passed to the report but never shown.", kOwnScript, names);
        case UnplacedEntries::Kind::kText:
            return one ? Message("In {}, the text {} is passed to the report but never shown.", kOwnScript, names)
                       : Message("In {}, the texts {} are passed to the report but never shown.", kOwnScript, names);
        case UnplacedEntries::Kind::kValue:
            return one ? Message("In {}, the value {} is passed to the report but never shown.", kOwnScript, names)
                       : Message("In {}, the values {} are passed to the report but never shown.", kOwnScript, names);
        case UnplacedEntries::Kind::kFigure:
            break;
    }
    return one ? Message("In {}, the figure {} is passed to the report but never shown.", kOwnScript, names)
               : Message("In {}, the figures {} are passed to the report but never shown.", kOwnScript, names);
}

Message sentence_about_missing(const ExpectedAnswer& answer) {
    const std::string &name = answer.name, &kind = answer.kind;
    if (kind == "number") return Message("The answer \"{}\" (number) is missing.", name);
    if (kind == "text") return Message("The answer \"{}\" (text) is missing.", name);
    if (kind == "truth") return Message("The answer \"{}\" (true or false) is missing.", name);
    if (kind == "vector") return Message("The answer \"{}\" (vector) is missing.", name);
    if (kind == "matrix") return Message("The answer \"{}\" (matrix) is missing.", name);
    if (kind == "data") return Message("The answer \"{}\" (data) is missing.", name);
    if (kind == "model") return Message("The answer \"{}\" (model) is missing.", name);
    if (kind == "response") return Message("The answer \"{}\" (response) is missing.", name);
    return Message("The answer \"{}\" (table) is missing.", name);
}

Message remedy_for(const UnplacedEntries& entries) {
    const std::string& name = entries.names.front();
    if (entries.kind == UnplacedEntries::Kind::kTable)
        return Message("Write ::: {.table name={}} above the caption of the table and ::: below the caption.", name);
    if (entries.kind == UnplacedEntries::Kind::kText)
        return Message("Write ::: {.text name={}} and, on a later line, :::.", name);
    return Message("Write {} in the text.", entries.slot());
}

/// One folder's check: a clean copy, what runs in it, and what is found.
class FolderCheck {
  public:
    FolderCheck(const fs::path& folder, const fs::path& program, const FolderLimits& limits)
        : folder_(folder), program_(program), limits_(limits) {
        result_.subject = folder.string();
        fs::create_directory(copy());
        fs::create_directory(out());
    }

    CheckResult check(CheckOptions check_options) {
        if (!has_its_files() || !copied()) return result_;
        const std::optional<PercentScript> script = readable_script();
        check_options.begins(CheckStep::kAnalysis);
        const bool made = script && makes_report();
        if (script) {
            result_.lesson = script->header.lesson;
            add_if_without_code(*script, kOwnScript, result_.findings);
            check_blanks(*script);
            check_ids(*script);
            check_stars(*script);
            if (made) {
                const RunRecord run = record_from_json(read_file(record()));
                check_answers(*script, run);
                check_places(*script, run);
            }
            check_options.begins(CheckStep::kLessonChecks);
            if (check_options.lesson_checks && !stopped_by_file()) try_lesson_checks(script->header.lesson);
        }
        if (!check_options.standard) check_options.standard = own_standard(script);
        add_members(check_options);
        check_options.begins(CheckStep::kReport);
        const std::optional<fs::path> submitted_pdf = pdf_in_folder();
        if (made || fs::exists(report()))
            check_report(report(), check_options);
        else if (submitted_pdf)
            check_report(*submitted_pdf, check_options);
        if (made && submitted_pdf) compare_with(*submitted_pdf);
        if (of_notebook_) convert_places_to_cells();
        sort_issues(result_.findings);
        return std::move(result_);
    }

  private:
    fs::path copy() const { return work_.path() / "folder"; }
    fs::path out() const { return work_.path() / "made"; }
    fs::path report() const { return out() / "report.pdf"; }
    fs::path record() const { return out() / "record.json"; }

    void add(const std::string& id, Severity severity, const std::string& place, const Message& what,
             const Message& remedy) {
        result_.findings.push_back({id, severity, 0, place, what, remedy});
    }

    bool has_its_files() {
        for (const char* needed : {kOwnScript, "report.md"}) {
            if (fs::is_regular_file(fs::symlink_status(folder_ / needed))) continue;
            if (needed == kOwnScript && fs::is_regular_file(fs::symlink_status(folder_ / kOwnNotebook))) continue;
            add("analysis-missing", Severity::kRule, needed, Message("The folder has no file {}.", needed),
                Message(
                    "Submit the complete folder that dynlab new created, with analysis.lua and report.md at its top "
                    "level."));
        }
        return result_.findings.empty();
    }

    bool copied() {
        const FolderCopy outcome = copy_folder(folder_, copy(), limits_.folder_bytes, limits_.files);
        for (const std::string& name : outcome.left_out) {
            add("link-left-out", Severity::kHint, name,
                Message("The file is a link or is not a regular file, and is not submitted."),
                Message("Replace the link with the file."));
        }
        if (!outcome.too_large) return scripts_made();
        add("folder-too-large", Severity::kRule, "",
            Message("The folder is too large: dynlab examines at most {} files and {} MB.", limits_.files,
                    limits_.folder_bytes >> 20),
            Message("Remove files that the report does not need."));
        return false;
    }

    /// Converts submitted notebooks to scripts. Returns false if a notebook cannot be read.
    bool scripts_made() {
        try {
            of_notebook_ = !take_notebooks(copy()).empty();
            return true;
        } catch (const SubmissionError& error) {
            add("analysis-fails", Severity::kRule, kOwnNotebook, error.message(),
                Message("Save the notebook again in Jupyter."));
            return false;
        }
    }

    /// The cells of the notebook instead of lines that its author does not see.
    void convert_places_to_cells() {
        const std::string source = read_file(copy() / kOwnScript);
        const auto in_cells = [&source](const auto& text) {
            return with_places_in_notebook(text, kOwnScript, kOwnNotebook, source);
        };
        for (Issue& issue : result_.findings) {
            issue.place = in_cells(issue.place);
            issue.what = in_cells(issue.what);
            issue.remedy = in_cells(issue.remedy);
        }
    }

    std::optional<PercentScript> readable_script() {
        try {
            return read_percent_script(copy() / "analysis.lua");
        } catch (const DocumentError& error) {
            add_failure(without_sandbox_paths(error.message(), copy()));
            return std::nullopt;
        }
    }

    void add_failure(const Message& message) {
        add("analysis-fails", Severity::kRule, "",
            Message("The report cannot be built from a clean copy of the folder: {}", message),
            Message("Fix the error and run \"dynlab report FOLDER\". Every file that the analysis reads must be in the "
                    "folder or in its subfolder \"data\"."));
    }

    /// The script stopped.
    void add_failure(const RecordedError& error) {
        if (!is_refusal_outside(error.message)) return add_failure(with_place(error));
        const int line = error.line_in(kOwnScript);
        add("file-outside", Severity::kRule, line > 0 ? fmt::format("{}:{}", kOwnScript, line) : "",
            Message("The analysis stops because it reads a file that is not submitted: {}.",
                    line > 0 ? error.message : with_place(error)),
            Message("Copy the file into the folder and load it by its name."));
    }

    bool makes_report() {
        const FolderReport made = make_folder_report(copy(), out(), program_, isolation_, limits_.time);
        if (made.stopped)
            add_failure(*made.stopped);
        else if (!made.made)
            add_failure(made.failure);
        return made.made;
    }

    /// What the checks say of a run that stopped there speaks of answers that are given further down.
    bool stopped_by_file() const {
        return std::any_of(result_.findings.begin(), result_.findings.end(),
                           [](const Issue& issue) { return issue.id == "file-outside"; });
    }

    /// "Your answer:" of the line "-- *Your answer:*".
    static std::string shown_mark(std::string mark) {
        std::erase_if(mark, [](char c) { return c == '*' || c == '-'; });
        return trimmed(mark);
    }

    /// Lines that a student's own take the place of: a question that has several is one finding.
    void check_blanks(const PercentScript& script) {
        struct Blanks {
            std::string question;     ///< its number; empty above the first
            int line;                 ///< of the first
            std::string code, words;  ///< the marks found at that place
        };
        static const RE2 kQuestion(R"(\*\*Question (\d{1,4})\b)", RE2::Latin1);
        std::vector<Blanks> found;
        std::string question;
        int number = 0;
        for (const std::string& line : lines_of(script.source)) {
            ++number;
            RE2::PartialMatch(line, kQuestion, &question);
            const std::string text = trimmed(line);
            if (text.starts_with("-- #")) question.clear();  // a heading: what follows belongs to none
            for (const char* language : {"en", "fr"}) {
                const AnswerMarks marks = answer_marks(language);
                if (text != marks.code && text != marks.text) continue;
                if (found.empty() || question.empty() || found.back().question != question)
                    found.push_back({question, number, "", ""});
                (text == marks.code ? found.back().code : found.back().words) = shown_mark(text);
            }
        }
        for (const Blanks& blanks : found) {
            const auto& [asked, line, code, words] = blanks;
            const std::string& one = code.empty() ? words : code;
            const bool both = !code.empty() && !words.empty();
            add("answer-open", Severity::kRule, fmt::format("analysis.lua:{}", line),
                asked.empty() ? Message("The line \"{}\" is still in the text.", one)
                : both ? Message("Question {} is unanswered: the lines \"{}\" and \"{}\" are still in the text.", asked,
                                 code, words)
                       : Message("Question {} is unanswered: the line \"{}\" is still in the text.", asked, one),
                Message("Replace the placeholder text with your own answer."));
        }
    }

    /// 2*3*4 in a text, whose stars Markdown takes for italics.
    void check_stars(const PercentScript& script) {
        for (const Cell& cell : script.cells)
            if (cell.kind == Cell::Kind::kText) check_stars("analysis.lua", cell.content, cell.first_line);
        check_stars("report.md", read_text(copy() / "report.md"), 1);
    }

    void check_stars(const std::string& file, const std::string& text, int line_number) {
        static const RE2 kNotProse(R"(`[^`]*`|\$[^$]*\$|\\.)", RE2::Latin1),
            kStars(R"((\d\*[^*\s][^*]*\*\d))", RE2::Latin1);
        for (std::string line : lines_of(text)) {
            RE2::GlobalReplace(&line, kNotProse, " ");
            if (std::string product; RE2::PartialMatch(line, kStars, &product))
                add("stars-lost", Severity::kHint, fmt::format("{}:{}", file, line_number),
                    Message("\"{}\" is printed without its asterisks: Markdown reads them as italics.", product),
                    Message("Write a product as a formula, such as $2 \\cdot 3$, or write each asterisk as \\*."));
            ++line_number;
        }
    }

    /// A cell that was copied to try something, and forgotten.
    void check_ids(const PercentScript& script) {
        for (const Cell& cell : script.cells) {
            if (cell.repeats.empty()) continue;
            add("cell-copied", Severity::kHint, fmt::format("analysis.lua:{}", cell.first_line),
                Message("Another cell already has the id \"{}\".", cell.repeats),
                Message("Remove the copy, or give it a different id."));
        }
    }

    /// Every answer that the script's header declares is given; of the right kind it is, or the script stops.
    void check_answers(const PercentScript& script, const RunRecord& run) {
        for (const ExpectedAnswer& answer : script.header.answers) {
            if (run.answers.contains(answer.name)) continue;
            add("answer-missing", Severity::kRule, "analysis.lua", sentence_about_missing(answer),
                Message("Submit the answer: answer(\"{}\", ...).", answer.name));
        }
    }

    /// What the analysis reports and no reader would see.
    void check_places(const PercentScript& script, const RunRecord& run) {
        for (const UnplacedEntries& entries : entries_without_place(script, run))
            add("not-shown", Severity::kHint, "report.md", sentence_about(entries), remedy_for(entries));
    }

    /// Where the lesson itself is not on this machine: the checks that came with the folder, and the answers that its
    /// script declares.
    std::optional<Lesson> lesson_of_folder(const std::string& slug) {
        if (!fs::is_regular_file(copy() / "checks.lua")) return {};
        const fs::path folder = work_.path() / "lesson";
        fs::create_directory(folder);
        fs::copy_file(copy() / "analysis.lua", folder / "lesson.lua");
        fs::copy_file(copy() / "checks.lua", folder / "checks.lua");
        fs::copy_file(copy() / "report.md", folder / "report.en.md");
        const bool own_data = fs::symlink_status(copy() / "data").type() == fs::file_type::directory;
        if (own_data) fs::copy(copy() / "data", folder / "data", fs::copy_options::recursive);
        return Lesson{slug.empty() ? "(unnamed)" : slug, folder};
    }

    /// The checks of the lesson that students may read; what falls short is a hint, as marks are given elsewhere.
    void try_lesson_checks(const std::string& slug) {
        const std::vector<Lesson> all = lessons();
        const auto installed = std::find_if(all.begin(), all.end(), [&](const Lesson& l) { return l.slug == slug; });
        std::optional<Lesson> lesson;
        if (installed != all.end()) lesson = *installed;
        if (!lesson || !fs::exists(lesson->folder / "checks.lua")) lesson = lesson_of_folder(slug);
        if (!lesson) return;
        GradingSetup setup;
        setup.lesson = *lesson;
        setup.isolation = isolation_;
        setup.time = limits_.time;
        setup.program = program_;
        setup.jobs = static_cast<int>(std::thread::hardware_concurrency());
        const GradingRules::GroupSeed own = group_seed_of(copy() / "data");
        const Grade grade = GradingRules(setup).grade(folder_.filename().string(), copy(), own);
        const Message name = slug.empty() ? Message("(unnamed)") : Message::verbatim(lesson->slug);
        result_.checked.push_back(Message("checks of lesson {}: {} of {} points", name, points_number(grade.earned()),
                                          points_number(grade.possible())));
        for (const CheckGrade& check : grade.checks) {
            if (check.by_hand || check.earned >= check.points) continue;
            const Message score = Message("Score: {} of {} for \"{}\".", points_number(check.earned),
                                          points_number(check.points), check.about);
            add("check-failed", Severity::kHint, "",
                message_text(check.message).empty() ? score : sentences({score, check.message}),
                check.hint.empty() ? Message("See checks.lua of the lesson.") : check.hint);
        }
    }

    DocumentStandard own_standard(const std::optional<PercentScript>& script) const {
        DocumentStandard standard;
        try {
            if (script) standard = standard_of(script->header.template_name);
            const TemplateFile own = read_template(copy() / "report.md");
            const bool demands_nothing = !standard.rules.pages && standard.rules.sections.empty();
            if (demands_nothing) {
                standard.rules = document_rules(own);
                if (standard.rules.pages || !standard.rules.sections.empty()) standard.template_name.clear();
            }
            const auto language = own.metadata.find("lang");
            standard.language = language == own.metadata.end() ? "en" : language->second;
        } catch (const std::runtime_error&) {
            // A template or header that cannot be read needs no message here: a separate finding reports that the
            // report was not made.
        }
        return standard;
    }

    /// The check always looks for the authors' own names, in addition to any other names.
    void add_members(CheckOptions& check_options) {
        IdentityMatcher names = check_options.names ? *check_options.names : IdentityMatcher();
        const std::vector<Student> members = members_of(copy() / "group.toml");
        for (const Student& member : members) names.add(member, true);
        if (members.empty() && fs::exists(copy() / "group.toml"))
            add("members-missing", Severity::kHint, "group.toml",
                Message("No members are listed, so the report was not searched for your names."),
                Message("Add the names of the members: members = [\"Ada Lovelace\", \"Rudolf Kalman\"]."));
        check_options.names = std::make_shared<const IdentityMatcher>(std::move(names));
    }

    void check_report(const fs::path& file, const CheckOptions& check_options) {
        const CheckResult found = check_pdf(file, check_options, limits_.pdf);
        result_.template_name = found.template_name;
        result_.language = found.language;
        result_.pages = found.pages;
        result_.checked.insert(result_.checked.begin(), found.checked.begin(), found.checked.end());
        result_.checked.insert(result_.checked.begin(), file == report() ? Message("run from a clean copy")
                                                                         : Message("{}", file.filename().string()));
        result_.findings.insert(result_.findings.end(), found.findings.begin(), found.findings.end());
    }

    /// report.pdf, or the only PDF in the folder.
    std::optional<fs::path> pdf_in_folder() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(copy())) {
            if (entry.is_regular_file() && entry.path().extension() == ".pdf") found.push_back(entry.path());
        }
        const auto usual = std::find(found.begin(), found.end(), copy() / "report.pdf");
        if (usual != found.end()) return *usual;
        return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
    }

    static Message make_again(const std::string& name) {
        if (name == "report.pdf") return Message("Create the PDF again: dynlab report FOLDER");
        return Message("Create the PDF again: dynlab report FOLDER -o FOLDER/{}", name);
    }

    void compare_with(const fs::path& submitted_pdf) {
        const std::string name = submitted_pdf.filename().string();
        if (read_file(submitted_pdf) == read_file(report())) {
            result_.checked.push_back(Message("{} is up to date", name));
            return;
        }
        const auto written = fs::last_write_time(folder_ / name);
        const bool outdated =
            written < fs::last_write_time(copy() / kOwnScript) || written < fs::last_write_time(copy() / "report.md");
        if (outdated) {
            add("pdf-outdated", Severity::kHint, name, Message("The PDF is older than the analysis or the text."),
                make_again(name));
        } else {
            add("pdf-differs", Severity::kHint, name,
                Message("The PDF differs from the PDF that the folder produces now."), make_again(name));
        }
    }

    bool of_notebook_ = false;
    fs::path folder_, program_;
    FolderLimits limits_;
    Isolation isolation_ = strongest_isolation();
    TemporaryFolder work_;
    CheckResult result_;
};

}  // namespace

CheckResult check_folder(const fs::path& folder, const fs::path& program, const CheckOptions& check_options,
                         const FolderLimits& limits) {
    return FolderCheck(folder, program, limits).check(check_options);
}

}  // namespace dynlab::inline course
