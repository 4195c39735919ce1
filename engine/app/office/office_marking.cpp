// The view of written answers, and what belongs to one of them.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/office/office_views.h"
#include "base/languages.h"
#include "course/grading/cached_stages.h"
#include "course/office/course_grading.h"
#include "course/store/answer_names.h"
#include "course/store/groups.h"
#include "course/store/marks.h"
#include "data_io/values/json_values.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/text/read_number.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline app {
namespace {

constexpr std::size_t kShownBytes = 4096;  ///< of one answer, until all of it is asked for

/// A check that marks can belong to.
struct OfficeCheck {
    std::string id, about, rubric;
    double points = 0;
    bool by_hand = false;
};
DYNLAB_DESCRIBE(OfficeCheck, id, about, rubric, points, by_hand)

/// The newest entry of a mark.
struct OfficeEntry {
    std::int64_t id = 0;
    std::optional<double> points;
    std::string reason;
};
DYNLAB_DESCRIBE(OfficeEntry, id, points, reason)

struct OfficeAnswer {
    std::string name, text, trouble;
    std::int64_t bytes = 0;  ///< of the whole text
    std::int64_t same = 0;   ///< others with the same text
    bool is_reading = false;
    OfficeEntry entry;
};
DYNLAB_DESCRIBE(OfficeAnswer, name, text, trouble, bytes, same, is_reading, entry)

struct OfficeComment {
    std::string text;
    std::int64_t used = 0;
};
DYNLAB_DESCRIBE(OfficeComment, text, used)

struct OfficeMarking {
    std::vector<std::string> assignments;
    std::vector<std::string> questions;
    std::vector<OfficeCheck> checks;
    std::string assignment, question, check, asked, solution;
    bool graded = false;
    std::vector<OfficeComment> comments;
    std::vector<OfficeAnswer> answers;
};
DYNLAB_DESCRIBE(OfficeMarking, assignments, questions, checks, assignment, question, check, asked, solution, graded,
                comments, answers)

/// The checks of a lab, as the results of one graded submission describe them.
std::vector<OfficeCheck> checks_of_lab(Course& course, const Assignment& lab) {
    std::vector<OfficeCheck> checks;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(results_folder(course, lab) / "results", none)) {
        const std::optional<Grade> grade = earlier_grade(entry.path());
        if (!grade || grade->checks.empty()) continue;
        for (const CheckGrade& one : grade->checks)
            checks.push_back({one.id, message_text(one.about), one.rubric, one.points, one.by_hand});
        return checks;
    }
    for (const CheckPoints& one : newest_checks(course, lab))
        checks.push_back({one.id, "", "", one.points, !one.graded});
    return checks;
}

/// The check that a question is marked by: the one of its name, else the only one that is marked by hand.
std::string check_of_question(const std::vector<OfficeCheck>& checks, const std::string& question) {
    const std::string own = "q" + question;
    if (checks.empty() || std::ranges::find(checks, own, &OfficeCheck::id) != checks.end()) return own;
    std::vector<std::string> by_hand;
    for (const OfficeCheck& one : checks)
        if (one.by_hand) by_hand.push_back(one.id);
    return by_hand.size() == 1 ? by_hand.front() : "";
}

/// The first question with its own check, if there is one.
std::string first_question(const std::vector<std::string>& questions, const std::vector<OfficeCheck>& checks) {
    for (const std::string& question : questions)
        if (std::ranges::find(checks, "q" + question, &OfficeCheck::id) != checks.end()) return question;
    return questions.front();
}

/// Reasons of marks of this item, the most used ones first.
std::vector<OfficeComment> comments_on_item(Course& course, const Assignment& lab, const std::string& item) {
    constexpr std::size_t kMaxComments = 26;  // the page has a letter for each
    std::vector<OfficeComment> comments;
    for (Rows rows = course.database().query(
             "SELECT reason, count(DISTINCT group_id) FROM marks WHERE assignment = ? AND item = ? AND reason <> '' "
             "AND points IS NOT NULL AND pair IS NULL GROUP BY reason ORDER BY 2 DESC, max(id) DESC",
             lab.id, item);
         rows.next() && comments.size() < kMaxComments;)
        comments.push_back({rows.text(0), rows.integer(1)});
    return comments;
}

std::string beginning_of(const std::string& text) {
    if (text.size() <= kShownBytes) return text;
    std::size_t end = kShownBytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) --end;  // not within a letter
    return text.substr(0, end);
}

OfficeEntry shown_entry(const MarkEntry& entry) {
    return {entry.id, entry.points, entry.points ? entry.reason : ""};
}

}  // namespace

std::vector<SubmittedWork> OfficeViews::work_of(const Assignment& lab) {
    std::map<std::string, Student> students;
    for (Student& student : students_of(course_)) students[student.id] = std::move(student);
    std::map<std::int64_t, std::vector<Student>> members;
    for (const Group& group : groups_of(course_))
        for (const std::string& id : group.members) members[group.id].push_back(students[id]);
    std::map<std::int64_t, SubmittedWork> newest;
    for (Rows rows = course_.database().query(
             "SELECT group_id, part, hash, name FROM standing WHERE assignment = ? AND stage = 'first' AND part IN "
             "('script', 'pack') ORDER BY received_at, id",
             lab.id);
         rows.next();) {
        const std::int64_t group = rows.integer(0);
        newest[group] = {group, rows.text(1), rows.text(2), rows.text(3), course_.file(rows.text(2)), members[group]};
    }
    std::vector<SubmittedWork> work;
    for (auto& [group, one] : newest) work.push_back(std::move(one));
    return work;
}

const LessonQuestions& OfficeViews::questions_of(const std::string& lesson) {
    const auto known = lessons_.find(lesson);
    return known != lessons_.end() ? known->second
                                   : lessons_.emplace(lesson, LessonQuestions(find_lesson(lesson))).first->second;
}

std::string OfficeViews::marking(const std::string& assignment, const std::string& question, const std::string& check,
                                 const std::string& language) {
    const std::lock_guard lock(mutex_);
    const Reader reader{catalog_of(language)};
    OfficeMarking all;
    std::optional<Assignment> lab;
    for (const Assignment& a : assignments_of(course_)) {
        if (!a.is_lab()) continue;
        all.assignments.push_back(a.name);
        if (!lab || a.name == assignment) lab = a;
    }
    if (!lab) return json_of(all);
    all.assignment = lab->name;
    const LessonQuestions& lesson = questions_of(lab->lesson);
    for (const int number : lesson.given().questions()) all.questions.push_back(std::to_string(number));
    if (all.questions.empty()) return json_of(all);
    all.checks = checks_of_lab(course_, *lab);
    all.question = std::ranges::find(all.questions, question) != all.questions.end()
                       ? question
                       : first_question(all.questions, all.checks);
    all.graded = !all.checks.empty();
    const bool known = std::ranges::find(all.checks, check, &OfficeCheck::id) != all.checks.end();
    all.check = known ? check : check_of_question(all.checks, all.question);
    const QuestionName asked = lesson.question(all.question);
    const AskedQuestion texts = lesson.asked(asked);
    all.asked = texts.text, all.solution = texts.solution;
    all.comments = comments_on_item(course_, *lab, all.check);

    const std::vector<SubmittedWork> work = work_of(*lab);
    const std::vector<AnswerBook::Answer> answers = answers_.answers(work, lesson, asked, students_of(course_));
    std::map<std::int64_t, MarkEntry> entries = newest_entries(course_, *lab, all.check);
    std::map<std::string, std::int64_t> alike;
    for (const AnswerBook::Answer& one : answers) ++alike[one.text];
    for (std::size_t i = 0; i < work.size(); ++i) {
        const AnswerBook::Answer& one = answers[i];
        all.answers.push_back({answer_name(course_, *lab, work[i].group), beginning_of(one.text),
                               message_text(one.error_reason, reader), std::ssize(one.text),
                               one.text.empty() ? 0 : alike[one.text] - 1, one.is_reading,
                               shown_entry(entries[work[i].group])});
    }
    // The order differs for each question and is unpredictable.
    const auto lot = [&](const OfficeAnswer& one) {
        return hmac_sha256(course_.key(), {"dynlab order of answers\n", all.question, "\n", one.name});
    };
    std::vector<std::pair<std::string, OfficeAnswer>> drawn;
    for (OfficeAnswer& one : all.answers) drawn.emplace_back(lot(one), std::move(one));
    std::ranges::sort(drawn, {}, &std::pair<std::string, OfficeAnswer>::first);
    for (std::size_t i = 0; i < drawn.size(); ++i) all.answers[i] = std::move(drawn[i].second);
    return json_of(all);
}

std::string OfficeViews::answer(const std::string& assignment, const std::string& question, const std::string& name) {
    const std::lock_guard lock(mutex_);
    const Assignment lab = assignment_named(course_, assignment);
    const LessonQuestions& lesson = questions_of(lab.lesson);
    for (const SubmittedWork& work : work_of(lab))
        if (answer_name(course_, lab, work.group) == name)
            return answers_.answers({work}, lesson, lesson.question(question), students_of(course_)).front().text;
    throw EnvironmentError("the assignment {} has no submission named \"{}\"; reload the page", assignment, name);
}

std::string OfficeViews::entry(const std::string& assignment, const std::string& name, const std::string& check) {
    const std::lock_guard lock(mutex_);
    const Assignment lab = assignment_named(course_, assignment);
    const std::optional<Group> group = group_of_answers(course_, lab, name);
    if (!group)
        throw EnvironmentError("the assignment {} has no submission named \"{}\"; reload the page", assignment, name);
    return json_of(shown_entry(newest_entries(course_, lab, check)[group->id]));
}

}  // namespace dynlab::inline app
