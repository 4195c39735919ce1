#include "course/office/marks_join.h"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "course/grading/feedback.h"
#include "course/grading/manual_marks.h"
#include "course/intake/course_clock.h"
#include "course/store/marks.h"
#include "platform/error.h"
#include "platform/text/read_number.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// The marks in force, by what they are about and the check.
class MarksInForce {
  public:
    explicit MarksInForce(const std::vector<GivenMark>& marks) {
        for (const GivenMark& mark : marks)
            if (mark.student.empty()) marks_[{{mark.group, mark.version}, mark.item}] = mark;
    }
    /// That of a version, or else of all versions of its group; null where there is none.
    const GivenMark* of(const CourseWork::Marked& marked, const std::string& check) const {
        const GivenMark* const own = exactly(marked, check);
        return own != nullptr ? own : exactly({marked.group, 0}, check);
    }
    const GivenMark* exactly(const CourseWork::Marked& marked, const std::string& check) const {
        const auto found = marks_.find({marked, check});
        return found == marks_.end() ? nullptr : &found->second;
    }

  private:
    std::map<std::pair<CourseWork::Marked, std::string>, GivenMark> marks_;
};

/// Whether a row of the file says what a mark says; points are compared as they are printed.
bool says(const MarksFile::Row& row, const GivenMark* mark) {
    if (mark == nullptr || !row.points) return mark == nullptr && !row.points;
    return points_text(*row.points) == points_text(*mark->points) && row.reason == mark->reason;
}

/// Why points cannot be taken; empty where they can. A mark that is in force already may be above the maximum.
Message problem_of_points(const MarksFile::Row& row, const std::map<std::string, double>& max_points,
                          const GivenMark* in_force) {
    const auto max = max_points.find(row.check);
    if (max == max_points.end()) {
        std::vector<std::string> checks;
        for (const auto& [check, points] : max_points)
            if (check != kWholeItem) checks.push_back(check);
        return Message("unknown check \"{}\" (for \"{}\"); the checks are {}, and * means the complete submission",
                       row.check, row.who, listed(checks));
    }
    if (!row.points || *row.points <= max->second) return {};
    if (in_force != nullptr && points_text(*in_force->points) == points_text(*row.points)) return {};
    return Message(
        "\"{}\" gets {} points for the check \"{}\", but the maximum is {}; correct the points, or give --force",
        row.who, points_text(*row.points), row.check, points_text(max->second));
}

std::string joined_setting(const Assignment& assignment) {
    return fmt::format("marks joined {}", assignment.id);
}

/// A mark whose row the instructor took out of the file, emptied, or changed to points that are refused, is in force no
/// more.
void take_back_lost_rows(Course& course, const Assignment& assignment, const CourseWork& work, const MarksFile& file,
                         const std::map<std::string, double>& max_points, const MarksInForce& before) {
    std::set<std::pair<CourseWork::Marked, std::string>> written;
    const MarkedItems items(work.work());
    for (const MarksFile::Row& row : file.rows())
        if (const auto marked = CourseWork::marked_by(course, items.find(row.who), row.who);
            marked && row.points && problem_of_points(row, max_points, before.exactly(*marked, row.check)).empty())
            written.insert({*marked, row.check});
    for (const GivenMark& mark : marks_in_force(course, assignment)) {
        const CourseWork::Marked marked{mark.group, mark.version};
        if (!mark.student.empty() || written.contains({marked, mark.item}) ||
            before.exactly(marked, mark.item) == nullptr || work.names_of(mark.group, mark.version).empty())
            continue;
        give_mark(course, assignment, {mark.group, "", mark.item, {}, "its row was removed or refused", mark.version},
                  CourseClock::now());
    }
}

/// The rows that the instructor changed. Refuses a row that contradicts an earlier one about the same work, or a
/// command since the last grading: only the instructor knows which mark is right.
class ChangedRows {
  public:
    explicit ChangedRows(const fs::path& results) : file_((results / kMarksFile).string()) {}
    void refuse_contradiction(const CourseWork::Marked& marked, const MarksFile::Row& row) {
        const auto [other, fresh] = rows_.try_emplace({marked, row.check}, row);
        if (fresh || points_text(*other->second.points) == points_text(*row.points)) return;
        throw EnvironmentError(
            "{}, lines {} and {}: both rows are about the same work and the check \"{}\", but give {} and {} points. "
            "Delete one of the two rows",
            file_, other->second.line, row.line, row.check, points_text(*other->second.points),
            points_text(*row.points));
    }
    void refuse_other_than(const GivenMark& given, const MarksFile::Row& row) const {
        if (points_text(*given.points) == points_text(*row.points)) return;
        throw EnvironmentError(
            "{}, line {}: \"{}\" has the mark {} for the check \"{}\", but dynlab course mark gave {} since the last "
            "grading. Write the correct mark into this row",
            file_, row.line, row.who, points_text(*row.points), row.check, points_text(*given.points));
    }

  private:
    std::string file_;
    std::map<std::pair<CourseWork::Marked, std::string>, MarksFile::Row> rows_;
};

}  // namespace

std::optional<std::int64_t> newest_joined_mark(Course& course, const Assignment& assignment) {
    return read_number<std::int64_t>(course.saved_entry(joined_setting(assignment)));
}

std::vector<Message> join_marks_file(Course& course, const Assignment& assignment, const CourseWork& work,
                                     const std::map<std::string, double>& max_points, const fs::path& results,
                                     bool file_alone) {
    MarksFile file(results);
    const MarkedItems items(work.work());
    Transaction transaction(course.database());  // a mark that a command gives meanwhile comes with the next join
    const std::optional<std::int64_t> last = newest_joined_mark(course, assignment);
    const MarksInForce before(last ? marks_in_force(course, assignment, last) : std::vector<GivenMark>());
    if (file_alone) take_back_lost_rows(course, assignment, work, file, max_points, before);
    const MarksInForce now(marks_in_force(course, assignment));
    std::vector<std::pair<MarksFile::Row, CourseWork::Marked>> known;
    ChangedRows changed(results);
    std::vector<Message> complaints;
    for (const MarksFile::Row& row : file.rows()) {
        const MarkedItems::Found found = items.find(row.who);
        const auto marked = CourseWork::marked_by(course, found, row.who);
        Message problem = found.error_reason;
        if (problem.empty() && !marked)
            problem = Message("the work of \"{}\" could not be stored, so it cannot have a mark", row.who);
        if (problem.empty()) problem = problem_of_points(row, max_points, now.of(*marked, row.check));
        if (!problem.empty()) {
            if (row.points) complaints.push_back(Message("{}, line {}: {}", kMarksFile, row.line, problem));
            continue;
        }
        if (file_alone && !row.points) continue;
        known.emplace_back(row, *marked);
        // In a file alone, each row is a mark. A row of a group that was taken out also takes back what rows of its
        // versions say; they give it again.
        const auto of = file_alone ? &MarksInForce::exactly : &MarksInForce::of;
        const GivenMark *const given = (now.*of)(*marked, row.check), *const common = (before.*of)(*marked, row.check);
        if (!row.points || says(row, given)) continue;
        if (says(row, common) && (given != nullptr || !file_alone)) continue;
        changed.refuse_contradiction(*marked, row);
        const bool given_since = given != nullptr && (common == nullptr || given->id != common->id);
        if (given_since && !file_alone) changed.refuse_other_than(*given, row);
        give_mark(course, assignment, {marked->group, "", row.check, row.points, row.reason, marked->version},
                  CourseClock::now());
    }
    const std::vector<GivenMark> in_force = marks_in_force(course, assignment);
    Rows newest = course.database().query("SELECT max(id) FROM marks WHERE assignment = ?", assignment.id);
    const std::int64_t last_now = newest.next() ? newest.optional_integer(0).value_or(0) : 0;
    transaction.commit();
    const MarksInForce valid(in_force);
    for (const auto& [row, marked] : known) {
        const GivenMark* const mark = valid.of(marked, row.check);
        if (!says(row, mark))
            file.fill(row.who, row.check, mark ? mark->points : std::nullopt, mark ? mark->reason : "");
    }
    std::vector<MarksFile::Row> missing;
    for (const GivenMark& mark : in_force) {
        if (!mark.student.empty()) continue;
        for (const std::string& name : work.names_of(mark.group, mark.version))
            if (max_points.contains(mark.item))
                missing.push_back({0, name, mark.item, mark.points, mark.reason});
            else
                complaints.push_back(
                    Message("the mark that \"{}\" has for the unknown check \"{}\" does not count; "
                            "withdraw it with dynlab course withdraw",
                            name, mark.item));
    }
    file.add(missing);
    Transaction joined(course.database());
    course.save_entry(joined_setting(assignment), std::to_string(last_now));
    joined.commit();
    return complaints;
}

}  // namespace dynlab::inline course
