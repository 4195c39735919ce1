#include "course/store/participants.h"

#include <fmt/format.h>

#include "course/intake/owners.h"

namespace dynlab::inline course {
namespace {

/// Of the settings of the course, which every version of its tables has.
std::string setting_of(std::int64_t assignment) {
    return fmt::format("participant {} ", assignment);
}

}  // namespace

void keep_participant(Course& course, std::int64_t assignment, const Submission& sender, const Group& group) {
    if (sender.name.find("_assignsubmission_") == std::string::npos || sender.lms_id.empty()) return;
    for (const std::string& id : group.members) {
        Rows rows = course.database().query("SELECT name FROM students WHERE id = ?", id);
        if (!rows.next() || (group.members.size() > 1 && !same_person(rows.text(0), sender.person))) continue;
        course.remember(setting_of(assignment) + id, sender.lms_id);
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
