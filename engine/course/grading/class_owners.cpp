#include "course/grading/class_owners.h"

#include <algorithm>

#include "platform/error.h"

namespace dynlab::inline course {

ClassOwners::ClassOwners(const GradingRequest& request) {
    if (request.owners && !request.roster)
        throw EnvironmentError("--owners tells who of a roster handed in what; give --roster CSV, too");
    if (!request.roster) return;
    roster_.emplace(*request.roster);
    owners_.emplace(roster_->students());
    if (request.owners) owners_->read_list(*request.owners);
}

Owners::Found ClassOwners::of(const Submission& submission) const {
    return owners_ ? owners_->find(submission) : Owners::Found{};
}

std::vector<std::string> ClassOwners::names_of(const Submission& submission) const {
    std::vector<std::string> names;
    for (const std::size_t student : of(submission).students)
        for (const std::string& name : known_names_of(roster_->students()[student])) names.push_back(name);
    return names;
}

std::vector<std::string> ClassOwners::all_names() const {
    std::vector<std::string> names;
    if (!roster_) return names;
    for (const Student& student : roster_->students())
        for (const std::string& name : known_names_of(student)) names.push_back(name);
    return names;
}

bool ClassOwners::is_meant(const Submission& submission, const std::string& word) const {
    const bool by_name = submission.name == word || submission.lms_id == word || submission.person == word ||
                         submission.path.filename() == word;
    if (by_name || !owners_) return by_name;
    Submission wanted;
    wanted.name = word;
    const std::vector<std::size_t> owners = owners_->find(wanted).students;
    return !owners.empty() && owners == owners_->find(submission).students;
}

std::vector<std::size_t> ClassOwners::chosen(const std::vector<Submission>& submissions,
                                             const std::vector<std::string>& words) const {
    std::vector<std::size_t> indices;
    for (const std::string& word : words) {
        const std::size_t before = indices.size();
        for (std::size_t i = 0; i < submissions.size(); ++i)
            if (is_meant(submissions[i], word)) indices.push_back(i);
        if (indices.size() == before)
            throw EnvironmentError("there is no submission \"{}\", nor one of a group or student of that name", word);
    }
    if (words.empty())
        for (std::size_t i = 0; i < submissions.size(); ++i) indices.push_back(i);
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    return indices;
}

std::optional<std::uint32_t> ClassOwners::seed_of(const Submission& submission) const {
    const std::vector<std::size_t> owners = of(submission).students;
    return owners.empty() ? std::nullopt : roster_->students()[owners.front()].seed;
}

void ClassOwners::address(const Submission& submission, Grade& grade) const {
    grade.title = submission.person;
    const Owners::Found owner = of(submission);
    if (!owner.group.empty()) grade.title = owner.group;
    for (const std::size_t student : owner.students) {
        const Student& one = roster_->students()[student];
        if (owner.group.empty()) grade.title = one.name.empty() ? one.id : one.name;
        if (!one.language.empty()) grade.language = one.language;
    }
}

std::vector<std::string> ClassOwners::strays(const std::vector<Submission>& submissions) const {
    return owners_ ? owners_->strays(submissions) : std::vector<std::string>{};
}

}  // namespace dynlab::inline course
