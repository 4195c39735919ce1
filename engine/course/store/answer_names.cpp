#include "course/store/answer_names.h"

#include "platform/hash.h"

namespace dynlab::inline course {
namespace {

constexpr std::string_view kAnswer = "answer-";

}  // namespace

std::string answer_name(const Course& course, const Assignment& assignment, std::int64_t group) {
    constexpr std::string_view kLetters = "0123456789abcdefghjkmnpqrstvwxyz";  // without those that look alike
    constexpr std::size_t kLength = 8;
    const std::string drawn =
        hmac_sha256(course.key(), {"dynlab answers\n", assignment.name, "\n", std::to_string(group)});
    std::string name(kAnswer);
    for (std::size_t i = 0; i < kLength; ++i) {
        const int byte = std::stoi(drawn.substr(2 * i, 2), nullptr, 16);
        name += kLetters[static_cast<std::size_t>(byte) % kLetters.size()];
    }
    return name;
}

std::optional<Group> group_of_answers(Course& course, const Assignment& assignment, const std::string& name) {
    if (!name.starts_with(kAnswer)) return {};
    for (const Group& group : groups_of(course))
        if (answer_name(course, assignment, group.id) == name) return group;
    return {};
}

}  // namespace dynlab::inline course
