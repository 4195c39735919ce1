#include "course/grading/lesson_trial.h"

#include <re2/re2.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/catalog.h"
#include "base/error.h"
#include "base/reader.h"
#include "course/checks/check_functions.h"
#include "course/grading/lesson_translation.h"
#include "course/issues/document_issues.h"
#include "documents/document_rules.h"
#include "documents/error.h"
#include "documents/solutions.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "scripting/lint/lint.h"
#include "scripting/runtime/errors.h"
#include "workflow/hints.h"
#include "workflow/make_report.h"
#include "workflow/student_copy.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLanguages[] = {"en", "fr"};
/// The findings of `dynlab check` about pages and their missing content.
constexpr const char* kFindingsOfPages[] = {"pages",         "section-missing",      "section-empty",
                                            "slot-unfilled", "reference-unresolved", "text-cut-off"};

/// Collects the faults of one lesson.
class Faults {
  public:
    explicit Faults(const Lesson& lesson) : lesson_(lesson) {}

    void add(const fs::path& file, int line, Message what) {
        found_.push_back({file.filename().string(), line, std::move(what)});
    }

    /// Does something whose exception is a fault of the file that its message names, or of this one.
    template <class Work>
    bool attempt(const fs::path& file, const Work& work) {
        try {
            work();
            return true;
        } catch (const MissingProgram&) {
            throw;
        } catch (const DocumentError& error) {
            const Place& place = error.place();
            const bool here = place.line > 0 && fs::exists(lesson_.folder / place.file.filename());
            add(here ? place.file : file, here ? place.line : 0, here ? error.sentence() : error.message());
        } catch (const std::runtime_error& error) {
            add(file, 0, message_of(error));
        }
        return false;
    }

    LessonFaults found() { return std::move(found_); }

  private:
    const Lesson& lesson_;
    LessonFaults found_;
};

std::vector<fs::path> lua_files_of(const Lesson& lesson) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(lesson.folder)) {
        const std::string name = entry.path().filename().string();
        const bool of_course = name.starts_with("wrong_") || name.starts_with("right_");
        if (entry.path().extension() == ".lua" && (of_course || name == "lesson.lua" || name == "checks.lua"))
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

void look_at_solutions(const Lesson& lesson, Faults& faults) {
    faults.attempt(lesson.script(), [&] {
        const PercentScript script = read_percent_script(lesson.script());
        const std::string starter = without_solutions(script.source, lesson.script(), script.header.language);
        if (starter == script.source)
            faults.add(
                lesson.script(), 0,
                Message("BEGIN SOLUTION and END SOLUTION enclose no lines, so students get the complete script"));
        if (script.header.title.empty())
            faults.add(lesson.script(), 0, Message("the header has no title; add a line \"title: TITLE\""));
        if (script.header.lesson != lesson.slug)
            faults.add(lesson.script(), 0,
                       Message("the header names the lesson \"{}\", but the folder of the lesson is \"{}\"",
                               script.header.lesson, lesson.slug));
    });
}

/// What the lines "-- expects: CHECK: words" of a script name.
struct Intended {
    std::string check, words;
    int line = 0;
};

std::vector<Intended> intended_failures(const fs::path& file) {
    static const RE2 kLine(R"(-- expects: (\w+): (.+))", RE2::Latin1);
    std::vector<Intended> all;
    int number = 0;
    std::string check, words;
    for (const std::string& line : lines_of(read_text(file))) {
        ++number;
        if (RE2::FullMatch(line, kLine, &check, &words)) all.push_back({check, trimmed(words), number});
    }
    return all;
}

int line_of_error(const EvaluatedScript& script) {
    return take_apart(message_text(script.error_reason)).line;
}

bool is_full(const EvaluatedCheck& one) {
    return one.check.by_hand || one.share == 1;
}

void look_at_starter(const Lesson& lesson, const EvaluatedScript& starter, Faults& faults) {
    for (const EvaluatedCheck& one : starter.checks)
        if (!one.check.by_hand && one.share.value_or(0) > 0)
            faults.add(lesson.script(), 0,
                       Message("the unchanged starter script gets points for the check \"{}\"", one.check.id));
}

/// Of wrong_*.lua and right_*.lua, which has nothing to expect.
void look_at_attempt(const fs::path& file, const EvaluatedScript& evaluated, Faults& faults) {
    const std::vector<Intended> intended = intended_failures(file);
    if (!evaluated.error_reason.empty())
        faults.add(file, line_of_error(evaluated), Message("the run stops: {}", evaluated.error_reason));
    if (intended.empty() && evaluated.name.starts_with("wrong_"))
        faults.add(
            file, 0,
            Message("no line \"-- expects: CHECK: part of the message\" names the check that the script must fail"));
    for (const Intended& one : intended) {
        const auto check =
            std::find_if(evaluated.checks.begin(), evaluated.checks.end(),
                         [&](const EvaluatedCheck& candidate) { return candidate.check.id == one.check; });
        if (check == evaluated.checks.end())
            faults.add(file, one.line, Message("unknown check \"{}\"", one.check));
        else if (is_full(*check))
            faults.add(file, one.line, Message("the script passes the check \"{}\", which it must fail", one.check));
        else if (message_text(check->message).find(one.words) == std::string::npos)
            faults.add(file, one.line,
                       Message("the check \"{}\" gives the message \"{}\", which does not contain \"{}\"", one.check,
                               check->message, one.words));
    }
    for (const EvaluatedCheck& one : evaluated.checks) {
        const bool meant = std::any_of(intended.begin(), intended.end(),
                                       [&](const Intended& line) { return line.check == one.check.id; });
        if (!meant && !is_full(one))
            faults.add(file, 0, Message("the script fails the check \"{}\": {}", one.check.id, one.message));
    }
}

/// The rules of a lesson's report, if the lesson has its own report template.
DocumentStandard standard_of_report(const Lesson& lesson, const std::string& language) {
    if (!fs::exists(lesson.report(language))) return {};
    return standard_of_lesson(lesson, language);
}

void look_at_pdf(const fs::path& pdf, const fs::path& source, const DocumentStandard& standard, Faults& faults) {
    CheckOptions check_options;
    check_options.standard = standard;
    for (const Issue& issue : check_pdf(pdf, check_options).findings)
        if (issue.severity == Severity::kRule &&
            std::find(std::begin(kFindingsOfPages), std::end(kFindingsOfPages), issue.id) != std::end(kFindingsOfPages))
            faults.add(source, 0, Message("the report, page {}: {}", issue.page, issue.what));
    for (const PdfPage& page : read_pdf_layout(pdf).pages)
        for (const PdfWord& word : page.words)
            if (word.text.find("SOLUTION") != std::string::npos)
                return faults.add(source, 0, Message("the report shows a BEGIN SOLUTION or END SOLUTION marker"));
}

void look_at_report(const Lesson& lesson, const std::string& language, const std::string& own, const fs::path& folder,
                    Faults& faults) {
    const bool has_report = fs::exists(lesson.report(language));
    if (language != own && !has_report) return;  // tasks alone
    const fs::path source = has_report ? lesson.report(language) : lesson.script();
    faults.attempt(source, [&] {
        const fs::path pdf = folder / (lesson.slug + "." + language + ".pdf");
        const ReportResult made = make_report(report_of(lesson.folder.string(), pdf, has_report ? language : ""));
        if (made.error) throw DocumentError(*made.error);
        for (const Message& gap : made.gaps) faults.add(source, 0, gap);
        look_at_pdf(pdf, source, standard_of_report(lesson, language), faults);
    });
}

void look_at_copy(const Lesson& lesson, const std::string& language, const fs::path& folder, Faults& faults) {
    faults.attempt(lesson.script(), [&] {
        const fs::path copy = folder / ("copy." + language);
        make_student_copy(lesson, copy, {}, language);
        ReportRequest request = report_of(copy.string());
        request.record = folder / "record.json";
        const ReportResult made = make_report(request);
        if (made.error)
            faults.add(lesson.script(), 0, Message("the student's copy ({}) stops: {}", language, *made.error));
        const auto record = nlohmann::json::parse(read_text(request.record));
        for (const char* kind : {"values", "answers"})
            if (record.contains(kind) && !record.at(kind).empty())
                faults.add(lesson.script(), 0,
                           Message("the student's copy ({}) contains {} of the solution: {}", language, kind,
                                   record.at(kind).begin().key()));
    });
}

void look_at_translated_checks(const Lesson& lesson, const std::string& language, Faults& faults) {
    const fs::path checks = lesson.folder / "checks.lua", words = lesson.checks_in(language);
    if (!fs::exists(checks)) return;
    if (!fs::exists(words)) {
        if (fs::exists(lesson.tasks(language)))
            faults.add(
                words, 0,
                Message("the file is missing, so the feedback shows the names of the checks and the hints in English"));
        return;
    }
    faults.attempt(words, [&] {
        const Catalog catalog(read_text(words));
        const std::vector<std::string> all = sentences_of_checks(read_text(checks));
        std::vector<std::string> missing;
        for (const std::string& sentence : all)
            if (catalog.translation(sentence).empty()) missing.push_back(sentence);
        if (!missing.empty())
            faults.add(words, 0,
                       plural(static_cast<std::int64_t>(missing.size()),
                              "{} of {} sentences in checks.lua has no translation: \"{}\"",
                              "{} of {} sentences in checks.lua have no translation; the first is \"{}\"", all.size(),
                              missing.front()));
    });
}

/// Wherever dynlab sheet --lang refuses them.
void look_at_tasks(const Lesson& lesson, const std::string& language, Faults& faults) {
    const fs::path tasks = lesson.tasks(language);
    if (!fs::exists(tasks)) return;
    faults.attempt(tasks, [&] {
        const bool fits = lesson_script(lesson, language).header.language == language;
        if (const std::string said = read_percent_script(tasks).header.language; said != language)
            faults.add(tasks, 0,
                       Message("the header has \"language: {}\", but the file name has {}: dynlab sheet --lang {} "
                               "rejects the file",
                               said, language, language));
        else if (!fits)
            faults.add(
                lesson.script(), 0,
                Message(
                    "the header has no line \"language: en\", so dynlab sheet --lang {} rejects the translated tasks",
                    language));
    });
}

/// The languages a lesson has: its script's, then those of its tasks and reports.
std::vector<std::string> languages_of(const Lesson& lesson) {
    std::vector<std::string> languages = {read_percent_script(lesson.script()).header.language};
    for (const char* language : kLanguages)
        if (language != languages.front() &&
            (fs::exists(lesson.tasks(language)) || fs::exists(lesson.report(language))))
            languages.emplace_back(language);
    return languages;
}

}  // namespace

LessonFaults faults_of_texts(const Lesson& lesson) {
    Faults faults(lesson);
    look_at_solutions(lesson, faults);
    for (const fs::path& file : lua_files_of(lesson)) {
        const bool checks = file.filename() == "checks.lua";
        faults.attempt(file, [&] {
            const std::string source = text_of_source(file);
            for (const LintIssue& found :
                 lint_script(source, file, checks ? names_of_check_functions() : std::vector<std::string>()))
                if (file != lesson.script() || found.kind != "header") faults.add(file, found.line, found.message);
        });
    }
    if (!fs::exists(lesson.folder / "checks.lua")) faults.add("checks.lua", 0, Message("the lesson has no checks"));
    for (const char* language : kLanguages) {
        if (fs::exists(lesson.hints(language)))
            faults.attempt(lesson.hints(language), [&] { read_hints(lesson.hints(language)); });
        look_at_translated_checks(lesson, language, faults);
        look_at_tasks(lesson, language, faults);
        if (fs::exists(lesson.report(language)))
            faults.attempt(lesson.report(language), [&] { document_rules(read_template(lesson.report(language))); });
    }
    return faults.found();
}

LessonFaults faults_of_checks(const Lesson& lesson, const CheckTrial& trial) {
    Faults faults(lesson);
    if (!trial.solution.error_reason.empty())
        faults.add(lesson.script(), line_of_error(trial.solution),
                   Message("the reference solution stops: {}", trial.solution.error_reason));
    for (const EvaluatedCheck& one : trial.solution.checks)
        if (!is_full(one))
            faults.add(lesson.script(), 0,
                       Message("the reference solution does not pass the check \"{}\": {}", one.check.id,
                               one.for_instructor.empty() ? one.message : one.for_instructor));
    bool wrong = false;
    for (const EvaluatedScript& script : trial.scripts) {
        wrong = wrong || script.name.starts_with("wrong_");
        if (script.name.starts_with("wrong_") || script.name.starts_with("right_"))
            look_at_attempt(lesson.folder / script.name, script, faults);
        else
            look_at_starter(lesson, script, faults);
    }
    if (!wrong)
        faults.add("checks.lua", 0,
                   Message("the lesson has no file wrong_*.lua with a mistake that the checks must detect"));
    return faults.found();
}

LessonFaults giveaways_of(const CheckTrial& trial) {
    LessonFaults found;
    for (const EvaluatedScript& script : trial.typed)
        for (const EvaluatedCheck& one : script.checks)
            if (one.check.visible && !one.check.by_hand && one.share.value_or(0) == 1)
                found.push_back(
                    {"checks.lua", 0,
                     Message("students can read this file and pass the check \"{}\" by entering {}: compute the "
                             "expected value from the data, or move the check into the folder for --checks",
                             one.check.id, script.name)});
    return found;
}

LessonFaults faults_of_checks(const GradingSetup& setup, LessonFaults* warnings) {
    Faults faults(setup.lesson);
    std::optional<CheckTrial> trial;
    if (!faults.attempt("checks.lua", [&] { trial = try_checks_of(setup, Mutants::kNone); })) return faults.found();
    if (warnings != nullptr) *warnings = giveaways_of(*trial);
    return faults_of_checks(setup.lesson, *trial);
}

LessonFaults faults_of_documents(const Lesson& lesson) {
    Faults faults(lesson);
    const TemporaryFolder folder;
    faults.attempt(lesson.script(), [&] {
        const std::vector<std::string> languages = languages_of(lesson);
        for (const std::string& language : languages) {
            look_at_report(lesson, language, languages.front(), folder.path(), faults);
            look_at_copy(lesson, language, folder.path(), faults);
        }
    });
    return faults.found();
}

}  // namespace dynlab::inline course
