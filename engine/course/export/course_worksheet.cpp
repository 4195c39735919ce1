#include "course/export/course_worksheet.h"

#include <fmt/format.h>

#include <map>

#include "base/reader.h"
#include "course/export/platform_sheet.h"
#include "course/office/course_totals.h"
#include "course/store/groups.h"

namespace dynlab::inline course {
namespace {

/// By student, by id; without an assignment the totals.
std::map<std::string, double> percent_of_students(Course& course, const std::optional<Assignment>& assignment,
                                                  const std::vector<Student>& students, Instant now) {
    std::map<std::string, double> percent;
    std::vector<Assignment> assignments = assignment ? std::vector{*assignment} : assignments_of(course);
    std::vector<std::map<std::string, AssignmentMark>> marks;
    for (const Assignment& one : assignments) marks.push_back(marks_of_students(course, one, now));
    if (assignment) assignments.front().weight = 1;  // one of weight 0 has marks all the same
    for (const Student& student : students) {
        std::vector<AssignmentMark> own;
        for (auto& of_assignment : marks) own.push_back(of_assignment[student.id]);
        if (const auto total = weighted_total(assignments, own)) percent[student.id] = *total;
    }
    return percent;
}

}  // namespace

FilledWorksheet fill_worksheet(Course& course, const std::optional<Assignment>& assignment,
                               const std::filesystem::path& worksheet, const std::string& column, Instant now) {
    PlatformSheet sheet(worksheet, column);
    const std::vector<Student> students = students_of(course);
    const std::map<std::string, double> percent = percent_of_students(course, assignment, students, now);
    const double max_grade = sheet.maximum().value_or(100);
    std::map<std::string, std::string> students_by_number;
    for (const auto& [student, number] : numbers_in(sheet, students)) students_by_number[number] = student;
    FilledWorksheet filled;
    std::map<std::string, bool> entered;
    std::int64_t unknown = 0;
    for (const PlatformSheet::Person& person : sheet.people()) {
        const auto student = students_by_number.find(person.number);
        if (student == students_by_number.end()) {
            ++unknown;
            continue;
        }
        const auto mark = percent.find(student->second);
        if (mark == percent.end()) continue;
        sheet.set_grade(person, fmt::format("{:.4g}", mark->second * max_grade / 100));
        entered[student->second] = true;
        ++filled.marks;
    }
    if (unknown > 0)
        filled.complaints.push_back(plural(unknown, "{} row of {} matches no student and was not changed",
                                           "{} rows of {} match no student and were not changed", worksheet.string()));
    for (const Student& student : students)
        if (percent.contains(student.id) && !entered[student.id])
            filled.complaints.push_back(Message("{} has marks, but no row in {}; enter the marks manually",
                                                student.name.empty() ? student.id : student.name, worksheet.string()));
    filled.text = sheet.text();
    return filled;
}

}  // namespace dynlab::inline course
