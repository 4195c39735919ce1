#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "course/intake/submission.h"
#include "course/store/assignments.h"

namespace dynlab::inline course {

/// Item of marks other than checks, criteria and kWholeItem (of a report or a talk in percent): the group's reviews, in
/// percent.
inline constexpr char kReviewsItem[] = "reviews";

/// An item as it is typed: of a report or a talk, `work` is the whole submission.
std::string item_called(const Assignment& assignment, const std::string& name);

/// Points given by the instructor or a reviewer.
struct GivenMark {
    std::int64_t group = 0;        ///< whose work it is
    std::string student;           ///< id of the only member who gets them; empty: all of the group
    std::string item;              ///< a check, a criterion, or one of those above
    std::optional<double> points;  ///< nothing: taken back
    std::string reason;
    std::int64_t version = 0;     ///< id of the only version that it is of; 0: of all
    std::int64_t id = 0;          ///< once it is stored; later ones have larger ids
    std::int64_t pair = 0;        ///< of the reviewer who gave it; 0: the instructor
    std::string stage = "first";  ///< "first" or "final"
};

/// The marks of an assignment that are in force, or were when the mark with the id `until` was the last one: of each
/// owner, item and version the newest, where no newer one is of all versions; not those that were taken back, nor those
/// of withdrawn versions. Oldest first.
std::vector<GivenMark> marks_in_force(Course& course, const Assignment& assignment,
                                      std::optional<std::int64_t> until = {});

/// Within a transaction: enters marks that say something new, without a line in the journal. Returns their number.
int enter_marks(Course& course, const Assignment& assignment, const std::vector<GivenMark>& marks, Instant now);

/// Within a transaction: enters the instructor's mark, with a line in the journal; the newest of equal ones is not
/// entered again. Returns whether it is new.
bool give_mark(Course& course, const Assignment& assignment, const GivenMark& mark, Instant now);

/// Within a transaction: the instructor's mark of an item is taken back, for all versions. With `alone` only that of
/// this student. Throws InvalidArgument where there is none.
void take_back_mark(Course& course, const Assignment& assignment, const std::string& who, bool alone,
                    const std::string& item, const std::string& reason, Instant now);

/// The instructor's newest entry for an item of a group, one that took a mark back among them.
struct MarkEntry {
    std::int64_t id = 0;           ///< 0: there is none
    std::optional<double> points;  ///< nothing: taken back
    std::string reason;
    Instant at = 0;
};
/// By group.
std::map<std::int64_t, MarkEntry> newest_entries(Course& course, const Assignment& assignment, const std::string& item);

/// Within a transaction: throws InvalidArgument if the newest entry is not `seen` (0: none), so that a mark that the
/// user has not seen is not replaced. `who`: the group as the user named it.
void refuse_unseen_entry(Course& course, const Assignment& assignment, std::int64_t group, const std::string& who,
                         const std::string& item, std::int64_t seen);

/// The most that may be given for an item of a lab, once it was graded. Throws InvalidArgument for an item that the
/// assignment does not have.
std::optional<double> max_points_of(Course& course, const Assignment& assignment, const std::string& item);

/// What the checks gave one version of a submission of a lab.
struct CheckPoints {
    std::string id;
    double points = 0, earned = 0;
    bool graded = true;
};
struct VersionResult {
    std::int64_t version = 0;  ///< its id
    std::vector<CheckPoints> checks;
    std::string fingerprint;  ///< of all that it depends on
};

/// The checks of the newest result of any version of a lab; none before it is graded.
std::vector<CheckPoints> newest_checks(Course& course, const Assignment& assignment);

/// Within a transaction: the newest result of a version counts; the same one again is not entered. Returns whether it
/// is new.
bool save_result(Course& course, const VersionResult& result, Instant now);

/// What a group has for a lab: the version that counts, the best or the newest as the assignment has it.
struct LabMark {
    std::int64_t group = 0, number = 0;  ///< of the version; 0 where nothing was submitted
    std::optional<double> earned;        ///< penalty taken off; nothing where something is not graded yet
    double possible = 0, penalty = 0;
    bool by_hand = false;             ///< the whole was marked by the instructor
    std::string reason;               ///< of that mark
    std::string own_reasons;          ///< of the marks of the student alone, a list
    std::int64_t version = 0;         ///< id of the version; 0 where nothing was submitted
    std::vector<CheckPoints> checks;  ///< with the instructor's marks
    std::optional<double> by_checks;  ///< points so far without the mark of the whole, as if a penalty that waits were
                                      ///< confirmed; nothing before a check is graded
    std::optional<double> percent() const;
};
/// Of each group that submitted something or has a mark; of one that never submitted anything, checks without a mark
/// count 0. `student`: with the marks of this student alone. `versions`:
/// ids of those that are considered; default all that are not withdrawn.
std::vector<LabMark> lab_marks(Course& course, const Assignment& assignment, const std::string& student = "",
                               const std::set<std::int64_t>* versions = nullptr);

}  // namespace dynlab::inline course
