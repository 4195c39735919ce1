#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/grading/manual_marks.h"
#include "course/grading/work_item.h"
#include "course/office/receive_class.h"
#include "course/store/marks.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {

/// The work of one lab as the course knows it, for the grading pipeline. It lives without the course.
class CourseWork {
  public:
    /// Every version that is not withdrawn, under its group's name ("group-07 v2"). Penalties of half the points or
    /// more wait until the time of receipt was corrected or confirmed.
    CourseWork(Course& course, const Assignment& assignment);
    /// The same of what a folder holds now only, under the names there.
    CourseWork(Course& course, const Assignment& assignment, const ReceivedClass& received);

    /// Of these groups, students or submissions; of all where there are none. Throws EnvironmentError for a name that
    /// means no submission.
    void choose(Course& course, const std::vector<std::string>& names);

    const ClassWork& work() const { return work_; }
    /// Items whose penalty waits.
    std::vector<const WorkItem*> waiting() const;

    /// What a row of marks.csv is about: a version by its name, else all versions of a group. Nothing for a name that
    /// fits neither; the grading complains of the row.
    struct Marked {
        std::int64_t group = 0, version = 0;
        auto operator<=>(const Marked&) const = default;
    };
    static std::optional<Marked> marked_by(Course& course, const MarkedItems::Found& found, const std::string& who);
    /// The instructor's marks as they are in the course now. `complaints`: about those that it does not have.
    void take_marks(Course& course, const Assignment& assignment, std::vector<Message> complaints = {});
    /// Names under which a mark is in marks.csv: of its version, of each version of its group, or of the group where it
    /// submitted nothing.
    std::vector<std::string> names_of(std::int64_t group, std::int64_t version) const;

  private:
    /// A version in the store.
    struct Stored {
        std::int64_t id = 0, group = 0, number = 0;
        std::string part, hash, name;
        Instant received = 0, first = 0, due = 0;  ///< first: when its content came
        bool confirmed = false;                    ///< the time of receipt was corrected or confirmed
        Message reason;                            ///< why it cannot be read
    };
    std::vector<Stored> read(Course& course, const Assignment& assignment);
    void say_what_a_mark_covers(Course& course, const Assignment& assignment, const std::vector<Stored>& versions);
    void date(WorkItem& item, const Stored& version, const Assignment& assignment) const;
    void add(Course& course, const Stored& version, const Assignment& assignment);
    void address(WorkItem& item) const;

    TemporaryFolder files_;
    ClassWork work_;
    std::map<std::int64_t, Group> groups_;
};

}  // namespace dynlab::inline course
