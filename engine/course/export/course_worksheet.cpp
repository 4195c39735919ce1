#include "course/export/course_worksheet.h"

#include <map>

#include "base/reader.h"
#include "course/export/platform_sheet.h"
#include "course/office/course_totals.h"
#include "course/store/groups.h"
#include "course/store/senders.h"

namespace dynlab::inline course {
namespace {

struct Points {
    double earned = 0, possible = 100;
};

/// By student, by id: points of a lab, percent of others; without an assignment the totals.
std::map<std::string, Points> points_of_students(Course& course, const std::optional<Assignment>& assignment,
                                                 const std::vector<Student>& students, Instant now) {
    std::map<std::string, Points> points;
    if (assignment) {
        for (const auto& [student, mark] : marks_of_students(course, *assignment, now))
            if (mark.lab && mark.percent && mark.lab->possible > 0)
                points[student] = {*mark.lab->earned, mark.lab->possible};
            else if (mark.percent)
                points[student] = {*mark.percent, 100};
        return points;
    }
    const CourseTotals totals = course_totals(course, now);
    for (std::size_t i = 0; i < students.size(); ++i)
        if (const auto total = weighted_total(totals.assignments, totals.marks[i]))
            points[students[i].id] = {*total, 100};
    return points;
}

}  // namespace

FilledWorksheet fill_worksheet(Course& course, const std::optional<Assignment>& assignment,
                               const std::filesystem::path& worksheet, const std::string& column, Instant now) {
    PlatformSheet sheet(worksheet, column);
    const std::vector<Student> students = students_of(course);
    const std::map<std::string, Points> points = points_of_students(course, assignment, students, now);
    const bool canvas = sheet.platform() == PlatformSheet::Platform::kCanvas;
    std::map<std::string, std::string> participants;
    if (assignment) participants = participants_of(course, assignment->id);
    std::vector<SoughtPerson> sought;
    for (const Student& student : students)
        sought.push_back({student.id, student.mail, student.name, canvas ? student.canvas : participants[student.id]});
    const std::map<std::size_t, PlatformSheet::Person> rows = rows_of(sheet, sought);
    FilledWorksheet filled;
    const std::size_t unknown = sheet.people().size() - rows.size();
    if (unknown > 0)
        filled.complaints.push_back(plural(static_cast<std::int64_t>(unknown),
                                           "{} row of {} matches no student and was not changed",
                                           "{} rows of {} match no student and were not changed", worksheet.string()));
    for (std::size_t i = 0; i < students.size(); ++i) {
        const auto own = points.find(students[i].id);
        if (own == points.end()) continue;
        const auto row = rows.find(i);
        if (row == rows.end()) {
            filled.complaints.push_back(Message("{} has marks, but no row in {}; enter the marks manually",
                                                students[i].name.empty() ? students[i].id : students[i].name,
                                                worksheet.string()));
            continue;
        }
        sheet.set_grade(row->second, points_in_sheet(sheet, own->second.earned, own->second.possible));
        ++filled.marks;
    }
    filled.text = sheet.text();
    return filled;
}

}  // namespace dynlab::inline course
