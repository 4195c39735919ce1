#pragma once
#include <string>
#include <vector>

#include "course/intake/arrival_times.h"
#include "course/intake/class_submissions.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

/// A submission of a class, as the course has it now.
struct ReceivedSubmission {
    Submission submission;
    std::int64_t version = 0, group_id = 0;  ///< 0: it could not be kept
    std::string group;                       ///< empty for a student without one, and where it is nobody's
    std::string group_name;                  ///< in the course, where each has one
    std::string content;                     ///< SHA-256 of all of it; of what could not be kept, why
    std::vector<std::size_t> students;       ///< places in lone_students_of(course)
    Message unmatched;                       ///< why it belongs to no student
};
struct ReceivedClass {
    std::vector<ReceivedSubmission> submissions;
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
