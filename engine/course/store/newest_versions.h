#pragma once
#include <map>
#include <optional>
#include <string>

#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

/// The newest version of a part that a group submitted.
struct SubmittedFile {
    std::int64_t version = 0, late = 0;
    Instant received_at = 0;
    std::int64_t in_time = 0;  ///< of a late one: the newest earlier version that was in time and can be read, or 0
    bool confirmed = false;    ///< the time of receipt was corrected or confirmed
    int rules_broken = 0;
    std::string error_reason;  ///< why it cannot be read; else empty
    bool is_late() const { return late > 0 && in_time == 0; }
};
using SubmittedParts = std::map<std::string, SubmittedFile>;  ///< by part: report, slides, script, pack; of a lab a
                                                              ///< pack is a script

/// By group and stage ("first", "final").
std::map<std::int64_t, std::map<std::string, SubmittedParts>> newest_versions(Course& course,
                                                                              const Assignment& assignment);

/// The group whose work of an assignment counts for each student (by id): the group that the student belonged to when
/// it first submitted, else the one when it submitted what is withdrawn now, else the student's group now. The first
/// membership of a student counts from the beginning.
std::map<std::string, std::int64_t> author_groups(Course& course, const Assignment& assignment);
/// The groups as groups_of() has them, with the members whose work of the assignment is that of the group.
std::vector<Group> groups_of_authors(Course& course, const Assignment& assignment);

/// A file whose owner or place is unknown, until the instructor assigns it or a later file.
struct FileNotTaken {
    std::string name;
    Message reason;  ///< a sentence or a clause
    Instant received_at = 0;
    std::string hash;
};
std::vector<FileNotTaken> files_not_taken(Course& course, const Assignment& assignment);

/// A file of a version that is not withdrawn.
struct ValidFile {
    std::int64_t id = 0, number = 0, late = 0;
    std::string part, hash, name;
    Instant received_at = 0;
};
/// The newest report, slides or review of a group at a stage; `pair`: of a review, else 0.
std::optional<ValidFile> newest_file(Course& course, const Assignment& assignment, std::int64_t group,
                                     const std::string& stage, const std::string& part, std::int64_t pair = 0);
/// The version with this id.
std::optional<ValidFile> standing_file(Course& course, std::int64_t id);
/// The newest pack that was submitted with this document or later, but not with a later document: the document's
/// source.
std::optional<ValidFile> pack_of_document(Course& course, std::int64_t document);

}  // namespace dynlab::inline course
