#include "course/office/folder_grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <map>
#include <thread>

#include "base/error.h"
#include "course/corrections/corrections.h"
#include "course/office/deadline_import.h"
#include "course/store/groups.h"
#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/interrupt.h"
#include "platform/locks/complete_folder.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kMemory[] = "grade", kCourse[] = "course";

/// An input that marks depend on: as it was named, and a hash of its content.
struct GradingInput {
    std::string name, hash;
};
/// What the results were made with, and how they are made.
struct GradingInputs {
    std::map<std::string, GradingInput> inputs;
    std::string isolation = "full";
    int timeout = 60;  ///< s
};

DYNLAB_DESCRIBE(GradingInput, name, hash)
DYNLAB_DESCRIBE(GradingInputs, inputs, isolation, timeout)

/// The name of this machine's time zone, as the course needs one.
std::string machine_zone() {
    const fs::path zones = "/usr/share/zoneinfo";
    std::error_code none;
    const char* const set = std::getenv("TZ");
    std::string zone = set != nullptr ? set : fs::canonical("/etc/localtime", none).lexically_relative(zones).string();
    if (zone.starts_with(':')) zone.erase(0, 1);
    return !zone.empty() && fs::is_regular_file(zones / zone, none) ? zone : "UTC";
}

/// One process at a time has the course of `out` open, on whatever machine: a database on a shared disk needs that. It
/// is made where there is none.
void with_course(const FolderRequest& request, const std::function<void(Course&)>& work) {
    const fs::path folder = request.out / kCourse;
    for (;;) {
        throw_if_interrupted();
        if (const FileLock lock(request.out / ".course.lock"); lock.held()) {
            if (!is_graded_folder(request.out))
                make_complete_folder(folder, [&](const fs::path& growing) {
                    fs::permissions(growing, fs::perms::owner_all);
                    Course::create(growing, fs::weakly_canonical(request.out).filename().string(),
                                   request.timezone.empty() ? machine_zone() : request.timezone);
                });
            Course course(folder);
            return work(course);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

const std::map<std::string, Message>& input_names() {
    static const std::map<std::string, Message> names = {{"lesson checks", Message("the lesson's checks")},
                                                         {"checks", Message("your own checks")},
                                                         {"secret", Message("the secret")},
                                                         {"deadlines", Message("the deadlines")},
                                                         {"keep", Message("the choice of the submission that counts")},
                                                         {"timezone", Message("the time zone")}};
    return names;
}

Message shown(const GradingInput& input) {
    return input.name.empty() ? Message("none") : Message("{}", input.name);
}

/// What differs so that marks of both kinds would be side by side, a clause each: "your own checks (own1 then, none
/// now)".
void refuse_differences(const GradingInputs& then, const GradingInputs& now, const FolderRequest& request) {
    std::vector<Message> clauses;
    for (const auto& [key, what] : input_names()) {
        const auto before = then.inputs.find(key), requested = now.inputs.find(key);
        if (before == then.inputs.end() || before->second.hash == requested->second.hash) continue;
        const GradingInput &a = before->second, &b = requested->second;
        if (a.name == b.name)
            clauses.push_back(Message("{} ({} has changed)", what, b.name));
        else
            clauses.push_back(Message("{} ({} then, {} now)", what, shown(a), shown(b)));
    }
    if (clauses.empty()) return;
    const MessageList all{std::move(clauses)};
    if (request.grading.only.empty())
        throw EnvironmentError(
            "the marks in {} were computed with other inputs: {}. Omit these inputs to continue with the earlier "
            "inputs, give --again to grade all submissions with the new inputs, or give another --out",
            request.out.string(), all);
    throw EnvironmentError(
        "the marks in {} were computed with other inputs: {}. Omit these inputs to continue with the earlier inputs, "
        "or give another --out",
        request.out.string(), all);
}

void save_entry(Course& course, const char* key, const std::string& value) {
    Transaction transaction(course.database());
    course.save_entry(key, value);
    transaction.commit();
}

/// The lab, as it is or as it is new, with what the options say of it.
Assignment wanted_assignment(Course& course, const FolderRequest& request) {
    Assignment a;
    a.kind = "lab";
    a.costs.late_day = 10;
    if (const std::vector<Assignment> all = assignments_of(course); !all.empty()) a = all.front();
    if (!request.lesson.empty()) {
        const Lesson lesson = find_lesson(request.lesson);
        if (!a.lesson.empty() && a.name != lesson.slug)
            throw EnvironmentError("{} contains the results of lesson {}; give another folder with --out",
                                   request.out.string(), a.name);
        a.name = lesson.slug, a.lesson = lasting_name(lesson);
    }
    if (a.lesson.empty())
        throw EnvironmentError("{} has no results yet: give the lesson with --lesson NN", request.out.string());
    const auto path = [](const std::string& given, std::string& kept) {
        if (given == kNoFile) kept.clear();
        if (!given.empty() && given != kNoFile) kept = fs::absolute(given).lexically_normal().string();
    };
    path(request.checks, a.checks);
    path(request.secret, a.secret);
    if (!request.keep.empty()) a.keep = request.keep;
    return a;
}

}  // namespace

bool is_graded_folder(const fs::path& out) {
    return fs::exists(out / kCourse / "course.db");
}

FolderGrading::FolderGrading(FolderRequest request) : request_(std::move(request)) {
    if (request_.again && !request_.grading.only.empty())
        throw EnvironmentError("--again grades the complete class again; omit --only");
    fs::create_directories(request_.out);
    if (!request_.part) lock_ = lock_results(request_.out);  // each result is written by one part, and whole
    with_course(request_, [this](Course& course) { prepare(course); });
    const GradingSetup& setup = options_.setup;
    submissions_.emplace(request_.submissions, setup.isolation, setup.program, request_.out);
    with_course(request_, [this](Course& course) { receive(course); });
}

/// Options, rules and students.
void FolderGrading::prepare(Course& course) {
    assignment_ = wanted_assignment(course, request_);
    const std::string memory = course.saved_entry(kMemory);
    const GradingInputs then = memory.empty() ? GradingInputs() : from_json<GradingInputs>(memory);
    GradingInputs now = then;
    if (!request_.isolation.empty()) now.isolation = request_.isolation;
    if (request_.timeout > 0) now.timeout = request_.timeout;
    request_.grading.setup.isolation = now.isolation == "process" ? Isolation::kProcess : Isolation::kFull;
    request_.grading.setup.time.processor = std::chrono::seconds(now.timeout);
    options_ = grading_options(course, assignment_, request_.grading, request_.out);
    const auto shown_path = [](const std::string& path) { return path.empty() ? path : fs::proximate(path).string(); };
    now.inputs["lesson checks"] = {assignment_.name + "/checks.lua",  // wherever it is installed
                                   sha256_of_file(options_.setup.lesson.folder / "checks.lua")};
    now.inputs["checks"] = {shown_path(assignment_.checks),
                            fs::is_directory(assignment_.checks) ? digest_of_folder(assignment_.checks).hex() : ""};
    now.inputs["secret"] = {shown_path(assignment_.secret),  // the file's own hash would help an attacker
                            options_.setup.secret.empty() ? "" : sha256_of("dynlab grade:" + options_.setup.secret)};
    now.inputs.try_emplace("deadlines");
    if (!request_.deadlines.empty()) now.inputs["deadlines"] = {request_.deadlines, sha256_of_file(request_.deadlines)};
    now.inputs["keep"] = {assignment_.keep, assignment_.keep};
    const std::string zone = request_.timezone.empty() ? course.clock().zone() : request_.timezone;
    now.inputs["timezone"] = {zone, zone};
    tried_.emplace(options_);  // what is wrong with the checks is said first
    if (!request_.again) refuse_differences(then, now, request_);
    if (!request_.roster.empty() && import_roster(course, request_.roster, true).converted)
        complaints_.push_back(
            Message("{} is not UTF-8, so dynlab read the file as Windows-1252; check names with accents, "
                    "or save the file as UTF-8",
                    request_.roster));
    set_assignment(course, assignment_, assignments_of(course).empty() ? "" : "dynlab grade");
    assignment_ = assignment_named(course, assignment_.name);
    if (!request_.owners.empty()) set_owners(course, assignment_, request_.owners);
    if (zone != course.clock().zone()) course.save_entry("zone", CourseClock(zone).zone());
    memory_ = json_of(now);
}

void FolderGrading::receive(Course& course) {
    const Instant now = CourseClock::now();
    const ArrivalTimes times = request_.times.empty() ? ArrivalTimes() : ArrivalTimes(request_.times);
    ReceivedClass received = receive_class(course, assignment_, *submissions_, times, now);
    std::ranges::move(complaints_, std::back_inserter(received.complaints));
    if (!request_.deadlines.empty()) {
        std::map<std::string, std::int64_t> groups;
        for (const WorkItem& item : received.items)
            for (const std::string& name : {item.submission.name, item.submission.lms_id, item.submission.person})
                if (!name.empty() && item.group_id != 0) groups[name] = item.group_id;
        const DeadlineImport done = import_deadlines(course, assignment_, request_.deadlines, now, groups);
        std::ranges::copy(done.complaints, std::back_inserter(received.complaints));
        assignment_ = assignment_named(course, assignment_.name);
    }
    work_.emplace(course, assignment_, received);
    if (request_.accept_late && confirm_late(course)) work_.emplace(course, assignment_, received);
    work_->choose(course, request_.grading.only);
    if (!request_.part) join_marks(course, assignment_, *work_, *tried_, options_, true);
    if (course.saved_entry(kMemory) != memory_) save_entry(course, kMemory, memory_);
}

/// The times of receipt are confirmed as they are.
bool FolderGrading::confirm_late(Course& course) {
    const std::vector<const WorkItem*> waiting = work_->waiting();
    if (waiting.empty()) return false;
    Transaction transaction(course.database());
    for (const WorkItem* item : waiting)
        log_arrival(course, assignment_, item->version, item->received, "--accept-late", CourseClock::now());
    course.note(fmt::format("{}: {} times of receipt confirmed", assignment_.name, waiting.size()));
    transaction.commit();
    return true;
}

GradingOutcome FolderGrading::grade() {
    return grade_class(work_->work(), *tried_, options_, [this] {
        std::vector<CountedMark> marks;
        with_course(request_, [&](Course& course) {
            save_results(course, assignment_, *work_, request_.out);
            marks = counted_marks(course, assignment_, work_->work());
        });
        return marks;
    });
}

}  // namespace dynlab::inline course
