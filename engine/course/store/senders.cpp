#include "course/store/senders.h"

#include <fmt/format.h>

#include <algorithm>

#include "course/store/newest_versions.h"
#include "platform/spelling.h"

namespace dynlab::inline course {
namespace {

/// Of the settings of the course, which every version of its tables has.
std::string setting_of(std::int64_t assignment) {
    return fmt::format("participant {} ", assignment);
}

std::vector<std::string> group_names_of(const std::vector<Group>& groups) {
    std::vector<std::string> names;
    for (const Group& group : groups) names.push_back(group.name);
    return names;
}

std::vector<Student> senders_among(Course& course, const Assignment& assignment, const std::string& stage,
                                   const std::vector<Group>& groups,
                                   const std::map<std::string, std::string>& numbers) {
    std::vector<Student> students = students_of(course);
    const auto authors = author_groups(course, assignment);
    for (Student& student : students) {
        if (const auto number = numbers.find(student.id); number != numbers.end()) student.moodle = number->second;
        const auto author = authors.find(student.id);
        if (stage != "final" || author == authors.end()) continue;
        const auto group = std::ranges::find(groups, author->second, &Group::id);
        if (group != groups.end()) student.group = group->name;
    }
    return students;
}

}  // namespace

Senders::Senders(Course& course, const Assignment& assignment, const std::string& stage,
                 const std::map<std::string, std::string>& numbers)
    : groups_(groups_of(course)),
      students_(senders_among(course, assignment, stage, groups_, numbers)),
      owners_(students_, group_names_of(groups_)) {}

bool Senders::knows(const Submission& submission) const {
    const Owners::Found found = owners_.find(submission);
    return found.anybody() && found.by_prefix;
}

/// A part of a name will do where only one group has it: "Petit.pdf" is that of the Petits, who work together.
Owners::Found Senders::owner_of(const Submission& submission) const {
    const Owners::Found found = owners_.find(submission);
    if (found.anybody() || found.doubtful) return found;
    return owners_.called(submission.person.empty() ? submission.name : submission.person);
}

std::optional<Group> Senders::find(const Submission& submission) const {
    const Owners::Found found = owner_of(submission);
    if (!found.anybody()) return {};
    const auto group = std::ranges::find(groups_, found.group, &Group::name);
    return group == groups_.end() ? std::nullopt : std::optional(*group);
}

Message Senders::complaint(const Submission& submission) const {
    const std::string& own = submission.person.empty() ? submission.name : submission.person;
    const Owners::Found found = owner_of(submission);
    if (found.doubtful)
        return Message("the owner of \"{}\" is unknown: {}. Give the owner with --from GROUP", own, found.error_reason);
    const auto near = nearest_word(own, owners_.names());
    if (!near)
        return Message("no group or student of the course is named \"{}\"; give the owner with --from GROUP", own);
    return Message(
        "no group or student of the course is named \"{}\" (the closest is {}); give the owner with --from GROUP", own,
        *near);
}

void keep_participant(Course& course, std::int64_t assignment, const Submission& sender, const Group& group) {
    if (sender.name.find("_assignsubmission_") == std::string::npos || sender.lms_id.empty()) return;
    for (const std::string& id : group.members) {
        Rows rows = course.database().query("SELECT name FROM students WHERE id = ?", id);
        if (!rows.next() || (group.members.size() > 1 && !same_person(rows.text(0), sender.person))) continue;
        course.save_entry(setting_of(assignment) + id, sender.lms_id);
    }
}

std::map<std::string, std::string> participants_of(Course& course, std::int64_t assignment) {
    const std::string setting = setting_of(assignment);
    std::map<std::string, std::string> numbers;
    for (Rows rows = course.database().query("SELECT key, value FROM course WHERE substr(key, 1, ?) = ?",
                                             static_cast<std::int64_t>(setting.size()), setting);
         rows.next();)
        numbers[rows.text(0).substr(setting.size())] = rows.text(1);
    return numbers;
}

}  // namespace dynlab::inline course
