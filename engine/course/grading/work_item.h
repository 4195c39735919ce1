#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "course/intake/roster.h"
#include "course/intake/submission.h"

namespace dynlab::inline course {

/// What lateness costs a submission.
struct Lateness {
    double hours = 0, percent = 0;  ///< of the points earned; 0 in time
    Message reason;                 ///< "received ..., 20 min after the deadline of ..."; empty in time
    std::int64_t late = 0;          ///< seconds after the deadline
    double waiting_percent = 0;     ///< not applied until the instructor confirms it (late_penalties.h)
};

/// Points that the instructor gave, and why.
struct ManualMark {
    double points = 0;
    std::string reason;  ///< which the student reads; may be empty
};

/// A submission to grade, with what a course knows of it.
struct WorkItem {
    Submission submission;                    ///< its name, which no other in the class has, and its files
    Message unreadable;                       ///< why it cannot be graded, a sentence; as a rule empty
    std::string content;                      ///< SHA-256 of all that was submitted; empty where that is not known
    std::int64_t version = 0;                 ///< its id in the store of the course; 0: it could not be kept
    std::int64_t group_id = 0;                ///< of that version
    std::vector<std::size_t> students;        ///< whose it is: places in ClassWork::students
    std::string group;                        ///< empty for a student without one
    Message unmatched;                        ///< why it belongs to no student; empty where it does
    std::string addressee;                    ///< whom the feedback is for; the submission's name where empty
    std::string language;                     ///< of the feedback; that of the work where empty
    std::optional<std::uint32_t> seed;        ///< of the group's own data sets; nothing for the data of all
    std::map<std::string, ManualMark> given;  ///< by check, or by * for the whole submission
    std::int64_t received = 0;                ///< seconds since 1970; needed where the newest counts
    Lateness lateness;
};

/// What a student has for the work of a class, as the course counts it.
struct CountedMark {
    std::optional<std::size_t> item;  ///< place of the submission that counts in ClassWork::items
    std::optional<double> points;     ///< penalty taken off; nothing where something is not graded yet
    std::optional<double> possible;   ///< nothing before anything is graded
    double penalty = 0;
    std::vector<std::pair<std::string, std::optional<double>>> checks;  ///< id, and points where it is graded
    std::string own_reason;                                             ///< of marks of this student alone
};

/// All work of a class on one assignment: what the grading pipeline is given (office/course_work.h).
struct ClassWork {
    std::vector<WorkItem> items;
    bool roster = false;              ///< the students are known: one row of marks for each of them, else for each item
    std::vector<Student> students;    ///< in the order of the gradebook
    bool deadlines = false;           ///< there are some: the gradebook has the reason of each penalty
    bool newest_counts = false;       ///< of several submissions of one student; else the best one
    std::vector<std::size_t> chosen;  ///< places of the items that are graded now; earlier results count for the others
    std::vector<Message> complaints;  ///< for the instructor, about rows that match no submission and the like
    std::vector<Message> late;        ///< a clause for each late submission, with what it costs
    int unconfirmed = 0;              ///< penalties that wait for the instructor (late_penalties.h)
    std::vector<Message> attention;   ///< what else needs attention, sentences for the terminal and the summary
    std::vector<Message> notes;       ///< for the terminal only
};

}  // namespace dynlab::inline course
