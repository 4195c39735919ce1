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

/// Takes a class's submissions into a lab as versions, in one transaction: each is one file, an archive as it came, or
/// a zip of what was loose or in a folder, of equal bytes for equal files. One that the course has under this name
/// already adds nothing. It is the student's or group's whom its name means; each of the others is a group of its own.
/// It was received as `times` say, else when its newest file was written. What cannot be kept leaves a trace, too.
ReceivedClass receive_class(Course& course, const Assignment& assignment, const ClassSubmissions& submissions,
                            const ArrivalTimes& times, Instant now);

}  // namespace dynlab::inline course
