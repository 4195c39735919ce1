#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/store/assignments.h"

namespace dynlab::inline course {

/// The item of a mark that is of the whole submission.
inline constexpr char kWholeItem[] = "*";

/// Points that the instructor gave by hand, instead of those of a check, or of all of them.
struct GivenMark {
    std::int64_t group = 0;
    std::string student;           ///< id of the only member who gets them; empty: all of the group
    std::string item;              ///< a check; * for the whole; of a report or a talk "work", in percent
    std::optional<double> points;  ///< nothing: taken back
    std::string reason;
    std::int64_t version = 0;  ///< id of the only version that it is of; 0: of all
    std::int64_t id = 0;       ///< once it is stored; later ones have larger ids
};

/// The marks of an assignment that are in force, or were when the mark with the id `until` was the last one: of each
/// owner, item and version the newest, where no newer one is of all versions; not those that were taken back.
std::vector<GivenMark> marks_in_force(Course& course, const Assignment& assignment,
                                      std::optional<std::int64_t> until = {});
/// All that were ever given, oldest first.
std::vector<GivenMark> marks_ever_given(Course& course, const Assignment& assignment);

/// Within a transaction: enters a mark, with a line in the journal; the newest of equal ones is not entered again.
/// Returns whether it is new.
bool give_mark(Course& course, const Assignment& assignment, const GivenMark& mark, Instant now);

/// What the checks gave one version of a submission of a lab.
struct CheckPoints {
    std::string id;
    double points = 0, earned = 0;
    bool graded = true;
};
/// Of the text in which the store has them.
std::vector<CheckPoints> checks_in(const std::string& json);

struct VersionResult {
    std::int64_t version = 0;  ///< its id
    std::vector<CheckPoints> checks;
    std::string fingerprint;  ///< of all that it depends on
};

/// Within a transaction: the newest result of a version counts; the same one again is not entered. Returns whether it
/// is new.
bool record_result(Course& course, const VersionResult& result, Instant now);

/// What a group has for a lab: the version that counts, the best or the newest as the assignment has it.
struct LabMark {
    std::int64_t group = 0, number = 0;  ///< of the version; 0 where nothing was submitted
    std::optional<double> earned;        ///< penalty taken off; nothing where something is not graded yet
    double possible = 0, penalty = 0;
    bool by_hand = false;  ///< the whole was marked by the instructor
    std::string reason;    ///< of that mark
    std::optional<double> percent() const;
};
/// Of each group that submitted something or has a mark. Marks of single students: `student` gives them.
std::vector<LabMark> lab_marks(Course& course, const Assignment& assignment, const std::string& student = "");

}  // namespace dynlab::inline course
