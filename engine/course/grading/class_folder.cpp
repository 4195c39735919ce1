#include "course/grading/class_folder.h"

#include <algorithm>

#include "course/intake/course_clock.h"
#include "platform/error.h"

namespace dynlab::inline course {

namespace fs = std::filesystem;

ClassFolder::ClassFolder(const ClassSources& sources, const fs::path& results, const GradingSetup& setup)
    : late_(results, sources.accept_late) {
    if (!sources.timezone.empty()) CourseClock(sources.timezone);  // sets the zone of the process
    std::vector<Message> left_out;
    fs::path folder = sources.submissions;
    if (fs::is_regular_file(folder)) {
        folder = unpacked_.path() / "all";
        left_out = unpack_export(sources.submissions, folder, setup.isolation, setup.program);
    }
    const std::vector<Submission> submissions = submissions_in(folder, left_out, results);
    read_students(sources);
    if (sources.deadlines) deadlines_ = Deadlines(*sources.deadlines);
    if (sources.times) deadlines_.set_times(ArrivalTimes(*sources.times));
    work_.deadlines = sources.deadlines.has_value();
    work_.newest_counts = sources.newest_counts;
    for (const Submission& submission : submissions) {
        WorkItem item;
        item.submission = submission;
        address(item);
        date(item);
        work_.items.push_back(std::move(item));
    }
    late_.conclude(work_);
    for (const Message& clause : left_out) work_.complaints.push_back(Message("{}; it is left out", clause));
    complain_of_unused_rows(submissions);
    work_.chosen = chosen(sources.only);
}

void ClassFolder::read_students(const ClassSources& sources) {
    if (sources.owners && !sources.roster)
        throw EnvironmentError("--owners says who of a roster submitted what; give --roster CSV, too");
    if (!sources.roster) return;
    const Roster roster(*sources.roster);
    work_.roster = true;
    work_.students = roster.students();
    owners_.emplace(work_.students);
    if (sources.owners) owners_->read_list(*sources.owners);
    if (roster.converted())
        work_.complaints.push_back(
            Message("{} is not UTF-8; it was read as Latin-1 (Windows-1252)", sources.roster->string()));
}

/// Whose it is, and in which language the feedback is.
void ClassFolder::address(WorkItem& item) const {
    item.addressee = item.submission.person;
    if (!owners_) return;
    const Owners::Found owner = owners_->find(item.submission);
    item.students = owner.students;
    item.group = owner.group;
    item.unmatched = owner.trouble;
    if (!owner.group.empty()) item.addressee = owner.group;
    for (const std::size_t place : owner.students) {
        const Student& student = work_.students[place];
        if (owner.group.empty()) item.addressee = student.name.empty() ? student.id : student.name;
        if (!student.language.empty()) item.language = student.language;
    }
    if (!owner.students.empty()) item.seed = work_.students[owner.students.front()].seed;
}

/// When it was received, and what that costs. What cannot be looked into is found out when it is graded.
void ClassFolder::date(WorkItem& item) {
    try {
        const std::vector<std::string> names = names_of(item);
        item.lateness = late_.counted(item.submission.name, deadlines_.of(item.submission, names));
        if (work_.newest_counts) item.received = deadlines_.received(item.submission, names);
    } catch (const fs::filesystem_error&) {
    }
}

/// By what else than its own name it is known.
std::vector<std::string> ClassFolder::names_of(const WorkItem& item) const {
    std::vector<std::string> names;
    for (const std::size_t place : item.students)
        for (const std::string& name : known_names_of(work_.students[place])) names.push_back(name);
    return names;
}

/// Most likely slips of the pen.
void ClassFolder::complain_of_unused_rows(const std::vector<Submission>& submissions) {
    std::vector<std::string> known;
    for (const Student& student : work_.students)
        for (const std::string& name : known_names_of(student)) known.push_back(name);
    for (const std::string& name : deadlines_.unmatched_names(submissions, known))
        work_.complaints.push_back(Message("the deadline of \"{}\": there is no such submission", name));
    if (!owners_) return;
    for (const std::string& name : owners_->unmatched_names(submissions))
        work_.complaints.push_back(Message("the owner of \"{}\": there is no such submission", name));
}

bool ClassFolder::matches(const WorkItem& item, const std::string& name) const {
    const Submission& submission = item.submission;
    if (submission.name == name || submission.lms_id == name || submission.person == name ||
        submission.path.filename() == name)
        return true;
    if (!owners_) return false;
    Submission wanted;
    wanted.name = name;
    const std::vector<std::size_t> students = owners_->find(wanted).students;
    return !students.empty() && students == item.students;
}

std::vector<std::size_t> ClassFolder::chosen(const std::vector<std::string>& names) const {
    std::vector<bool> wanted(work_.items.size(), names.empty());
    for (const std::string& name : names) {
        bool found = false;
        for (std::size_t i = 0; i < wanted.size(); ++i)
            if (matches(work_.items[i], name)) wanted[i] = found = true;
        if (!found)
            throw EnvironmentError("there is no submission \"{}\", nor one of a group or student of that name", name);
    }
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (wanted[i]) places.push_back(i);
    return places;
}

}  // namespace dynlab::inline course
