#include "course/grading/grading.h"

#include <utility>

#include "course/grading/feedback.h"
#include "course/grading/manual_marks.h"
#include "course/intake/staging.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline course {

namespace fs = std::filesystem;

namespace {

Message said(const ManualMark& mark) {
    return mark.reason.empty() ? Message("Marked by the instructor.") : Message::verbatim(mark.reason);
}

/// The instructor's marks replace what the checks gave.
Grade with_manual_marks(Grade grade, const std::map<std::string, ManualMark>& given) {
    for (CheckGrade& check : grade.checks) {
        const auto mark = given.find(check.id);
        if (mark == given.end()) continue;
        check.earned = mark->second.points;
        check.graded = check.visible = true;
        check.message = said(mark->second);
    }
    if (const auto mark = given.find(kWholeItem); mark != given.end()) {
        grade.whole_mark = mark->second.points;
        grade.whole_reason = said(mark->second);
    }
    return grade;
}

}  // namespace

GradingPipeline::GradingPipeline(const GradingRules& rules, const GradingOptions& options, const ClassWork& work)
    : rules_(rules),
      options_(options),
      newest_counts_(work.newest_counts),
      documents_(options.setup.isolation, options.setup.program) {}

std::optional<Grade> GradingPipeline::cached_grade(const WorkItem& item, const std::string& key) const {
    std::optional<Grade> grade = options_.regrade ? std::nullopt : earlier_grade(results_of(item));
    return grade && grade->fingerprint == key ? grade : std::nullopt;
}

/// Copies the item's files into a separate folder and runs the script there in sandboxes.
GradingPipeline::Run GradingPipeline::run(const WorkItem& item) const {
    std::string log;
    const std::string key = rules_.run_fingerprint(item.content, item.seed);
    CachedRuns runs = cached(kept_in(item) / "run.cbor", key, options_.regrade, [&] {
        const TemporaryFolder folder;
        const StagedWork staged =
            stage_submission(item.submission, folder.path(), options_.setup.isolation, options_.setup.program);
        CheckedSubmission work = rules_.work_in(staged.folder, item.seed, log, staged.of_notebook);
        return CachedRuns{key, std::move(work), staged.remark, staged.language};
    });
    return {std::move(runs), log.empty() ? "the earlier runs were used\n" : log};
}

std::vector<Grade> GradingPipeline::check(std::vector<ToCheck> submissions) const {
    std::vector<GradingRules::Work> works;
    for (ToCheck& one : submissions)
        works.push_back({one.item->submission.name, std::move(one.run.runs.work), one.item->seed, one.run.log});
    std::vector<Grade> grades = rules_.grade_all(std::move(works));
    for (std::size_t i = 0; i < grades.size(); ++i) {
        grades[i].fingerprint = submissions[i].key;
        grades[i].remark = submissions[i].run.runs.remark;
        grades[i].language = submissions[i].run.runs.language;
    }
    return grades;
}

Grade GradingPipeline::unreadable(const WorkItem& item, const std::string& key, const Message& why) const {
    Grade grade = rules_.unreadable(item.submission.name, why);
    grade.fingerprint = key;
    return grade;
}

GradingPipeline::Finished GradingPipeline::finish(const WorkItem& item, Grade grade, bool again) const {
    grade.title = item.addressee;
    if (!item.language.empty()) grade.language = item.language;
    grade.late_hours = item.lateness.hours;
    grade.lateness = item.lateness.reason;
    grade.penalty = 0;
    Grade marked = with_manual_marks(grade, item.given);
    if (!marked.whole_mark) grade.penalty = marked.penalty = marked.earned() * item.lateness.percent / 100;
    Message error_reason = write_files(item, grade, marked, again);
    return {std::move(marked), std::move(error_reason)};
}

/// The file of results last, as it says that the work is done.
Message GradingPipeline::write_files(const WorkItem& item, const Grade& grade, const Grade& marked, bool again) const {
    const fs::path folder = results_of(item);
    const std::string results = to_results_json(grade, marked);
    const bool written = fs::exists(folder / (options_.pdf ? "feedback.pdf" : "feedback.md")) &&
                         fs::exists(folder / "results.json") && read_file(folder / "results.json") == results;
    if (written && !again) return {};
    fs::create_directories(folder);
    Message error_reason;
    try {
        const fs::path made = kept_in(item) / "feedback";
        if (again) fs::remove(made);
        set_feedback(marked, folder / "feedback.pdf", made, options_.pdf ? &documents_ : nullptr);
    } catch (const EnvironmentError& error) {  // one that cannot be set stops no other, and no mark
        error_reason = error.message();
    }
    std::vector<NewFile> files = {{folder / "feedback.md", feedback_markdown(marked)}};
    if (!grade.log.empty()) {
        const fs::path logs = options_.out / "logs" / item.submission.name;
        fs::create_directories(logs);
        files.push_back({logs / "log.txt", terminal_text(grade.log)});
    }
    files.push_back({folder / "results.json", results});
    write_files_atomically(files);
    return error_reason;
}

std::optional<GradingPipeline::Finished> GradingPipeline::finish_as_counted(const WorkItem& item, const Grade& now,
                                                                            const std::string& instead) const {
    if (now.counts_instead == instead && (instead.empty() || now.newest_counts == newest_counts_)) return {};
    std::optional<Grade> grade = earlier_grade(results_of(item));
    if (!grade || grade->fingerprint != now.fingerprint) return {};  // it could not be graded now
    grade->counts_instead = instead;
    grade->newest_counts = newest_counts_;
    return finish(item, *std::move(grade), options_.regrade);
}

}  // namespace dynlab::inline course
