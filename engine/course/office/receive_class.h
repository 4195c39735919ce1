#pragma once
#include <string>
#include <vector>

#include "course/grading/work_item.h"
#include "course/intake/arrival_times.h"
#include "course/intake/class_submissions.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

/// The submissions of a class as the course has them now.
struct ReceivedClass {
    std::vector<WorkItem> items;      ///< not addressed and dated yet; students: places in lone_students_of(course)
    std::vector<Message> complaints;  ///< what is no submission, and rows of the list of owners that match none
};

/// All students of the course; those who are a group alone have none.
std::vector<Student> lone_students_of(Course& course);

/// From now on this list says whose submissions are (Owners::read_list). Throws EnvironmentError as that does, and for
/// a course without students.
void set_owners(Course& course, const Assignment& assignment, const std::filesystem::path& list);

/// Receives a class's submissions into a lab as versions, in one transaction. Each version is one file: an archive as
/// it arrived, or a zip of loose files or of a folder, with equal bytes for equal files. A submission that the course
/// already has under this name adds nothing. The submission's name identifies the student or group; each unmatched
/// submission becomes a separate group. The time of receipt comes from `times`, else from the newest file. Submissions
/// that cannot be kept are noted, too.
ReceivedClass receive_class(Course& course, const Assignment& assignment, const ClassSubmissions& submissions,
                            const ArrivalTimes& times, Instant now);

}  // namespace dynlab::inline course
