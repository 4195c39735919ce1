#include "course/store/senders.h"

#include <algorithm>

#include "platform/spelling.h"

namespace dynlab::inline course {
namespace {

std::vector<std::string> group_names_of(const std::vector<Group>& groups) {
    std::vector<std::string> names;
    for (const Group& group : groups) names.push_back(group.name);
    return names;
}

}  // namespace

Senders::Senders(Course& course)
    : groups_(groups_of(course)), students_(students_of(course)), owners_(students_, group_names_of(groups_)) {}

bool Senders::knows(const Submission& submission) const {
    const Owners::Found found = owners_.find(submission);
    return found.anybody() && found.by_beginning;
}

std::optional<Group> Senders::find(const Submission& submission) const {
    const Owners::Found found = owners_.find(submission);
    if (!found.anybody()) return {};
    const auto group = std::ranges::find(groups_, found.group, &Group::name);
    return group == groups_.end() ? std::nullopt : std::optional(*group);
}

Message Senders::complaint(const Submission& submission) const {
    const std::string& own = submission.person.empty() ? submission.name : submission.person;
    const Owners::Found found = owners_.find(submission);
    if (found.doubtful) return Message("whose \"{}\" is cannot be told: {}; say it: --from GROUP", own, found.trouble);
    const auto near = nearest_word(own, owners_.names());
    if (!near)
        return Message("no group and no student of the course is called \"{}\"; say whose it is: --from GROUP", own);
    return Message(
        "no group and no student of the course is called \"{}\" (the nearest is {}); say whose it is: --from "
        "GROUP",
        own, *near);
}

}  // namespace dynlab::inline course
