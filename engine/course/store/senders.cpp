#include "course/store/senders.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "platform/spelling.h"

namespace dynlab::inline course {

Senders::Senders(Course& course) : groups_(groups_of(course)), roster_(students_of(course)) {}

std::optional<Group> Senders::group_called(const std::string& name) const {
    for (const Group& group : groups_)
        if (::strcasecmp(group.name.c_str(), name.c_str()) == 0) return group;
    return {};
}

/// The longest group's name that `name` begins with, before a character that cannot belong to it: group-1 is not
/// meant by group-12_report.
std::optional<Group> Senders::group_that_begins(const std::string& name) const {
    const Group* best = nullptr;
    for (const Group& group : groups_) {
        const std::size_t length = group.name.size();
        const bool begins = name.size() > length && ::strncasecmp(group.name.c_str(), name.c_str(), length) == 0 &&
                            !std::isalnum(static_cast<unsigned char>(name[length]));
        if (begins && (best == nullptr || best->name.size() < length)) best = &group;
    }
    return best != nullptr ? std::optional(*best) : std::nullopt;
}

std::optional<Group> Senders::find(const Submission& submission) const {
    const std::string& own = submission.person.empty() ? submission.name : submission.person;
    if (const auto group = group_called(own)) return group;
    const std::vector<std::size_t> owners = roster_.owners(submission);
    std::set<std::string> names;
    for (const std::size_t owner : owners) names.insert(roster_.students()[owner].group);
    if (names.size() == 1) return group_called(*names.begin());
    return group_that_begins(own);
}

std::string Senders::complaint(const Submission& submission) const {
    const std::string& own = submission.person.empty() ? submission.name : submission.person;
    std::vector<std::string> names;
    for (const Group& group : groups_) names.push_back(group.name);
    for (const Student& student : roster_.students()) names.push_back(student.name);
    const auto near = nearest_word(own, names);
    return fmt::format("no group and no student of the course is called \"{}\"{}; say whose it is: --from GROUP", own,
                       near ? fmt::format(" (the nearest is {})", *near) : "");
}

}  // namespace dynlab::inline course
