#include "course/office/receive_class.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/error.h"
#include "course/corrections/corrections.h"
#include "course/intake/folder_copy.h"
#include "course/intake/owners.h"
#include "course/intake/staging.h"
#include "course/store/inspection.h"
#include "course/store/senders.h"
#include "course/store/side_by_side.h"
#include "course/store/versions.h"
#include "platform/error.h"
#include "platform/hash.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kPart[] = "pack", kStage[] = "first";

std::string owners_setting(const Assignment& assignment) {
    return fmt::format("owners {}", assignment.id);
}

/// Seconds since 1970 at which a file, or the newest file of a folder, was written.
Instant written(const fs::path& path) {
    const auto seconds = [](const fs::path& file) {
        const auto time = std::chrono::file_clock::to_sys(fs::last_write_time(file));
        return std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
    };
    if (!fs::is_directory(path)) return seconds(path);
    Instant newest = 0;
    for (const fs::path& file : files_below(path)) newest = std::max<Instant>(newest, seconds(file));
    return newest;
}

Instant written(const Submission& submission) {
    if (submission.loose.empty()) return written(submission.path);
    Instant newest = 0;
    for (const LooseFile& file : submission.loose) newest = std::max(newest, written(file.path));
    return newest;
}

bool is_one_archive(const Submission& submission) {
    return submission.archive && submission.loose.empty();
}

class ClassReceiver {
  public:
    ClassReceiver(Course& course, const Assignment& assignment, const ClassSubmissions& submissions,
                  const ArrivalTimes& times, Instant now)
        : course_(course), assignment_(assignment), times_(times), now_(now), students_(lone_students_of(course)) {
        for (const Submission& submission : submissions.all()) received_.items.emplace_back().submission = submission;
        left_out_ = submissions.left_out();
        files_.resize(received_.items.size());
    }

    ReceivedClass run() {
        find_owners();
        side_by_side(files_.size(), [this](std::size_t i) { pack(i); });
        store();
        for (const Message& clause : left_out_) received_.complaints.push_back(Message("{}; left out", clause));
        return std::move(received_);
    }

  private:
    struct File {
        fs::path path;
        std::int64_t bytes = 0;
        Instant at = 0;
        bool by_table = false;  ///< `at` is of the platform's table
        Message error_reason;   ///< why it cannot be kept
    };

    void find_owners() {
        for (const Group& group : groups_of(course_)) groups_[group.name] = group;
        if (students_.empty()) return;
        Owners owners(students_);
        const std::string list = course_.saved_entry(owners_setting(assignment_));
        if (!list.empty()) owners.read_list(course_.file(list));
        std::vector<Submission> all;
        for (WorkItem& one : received_.items) {
            Owners::Found found = owners.find(one.submission);
            one.students = std::move(found.students);
            one.group = std::move(found.group);
            one.unmatched = std::move(found.error_reason);
            all.push_back(one.submission);
        }
        for (const std::string& name : owners.unmatched_names(all))
            received_.complaints.push_back(
                Message("the file for --owners contains \"{}\", but no submission has this name", name));
    }

    /// What goes wrong with one submission stops no other.
    void pack(std::size_t i) {
        WorkItem& one = received_.items[i];
        File& file = files_[i];
        const SubmissionLimits limits;
        try {
            const std::optional<Instant> time = times_.of(one.submission, names_of(one));
            file.at = time ? *time : written(one.submission);
            file.by_table = time.has_value();
            if (is_one_archive(one.submission)) {
                file.path = one.submission.path;
            } else {
                file.path = packed_.path() / fmt::format("{}.zip", i);
                zip_submission(one.submission, file.path, limits);
            }
            if (fs::file_size(file.path) > limits.bytes) throw SubmissionError("The file is too large.");
            file.bytes = static_cast<std::int64_t>(fs::file_size(file.path));
            one.content = sha256_of_file(file.path);
        } catch (const std::exception& error) {
            file.error_reason = message_of(error);
            one.content = message_text(file.error_reason);
        }
    }

    /// By what else than its own name it may be called.
    std::vector<std::string> names_of(const WorkItem& one) const {
        std::vector<std::string> names;
        for (const std::size_t place : one.students)
            for (const std::string& name : known_names_of(students_[place])) names.push_back(name);
        return names;
    }

    void store() {
        std::vector<std::size_t> fresh, moved, corrected;
        std::vector<fs::path> paths;
        bool refused = !left_out_.empty();
        for (std::size_t i = 0; i < files_.size(); ++i) {
            WorkItem& one = received_.items[i];
            if (!files_[i].error_reason.empty()) {
                refused = true;
                if (const Group* const owner = group_of_owner(one)) one.group_id = owner->id;
                continue;
            }
            std::set<Instant> received;  // then, and as it was corrected
            if (is_known(one, received)) {
                if (is_with_other_group(one)) moved.push_back(i);
                if (files_[i].by_table && !received.contains(files_[i].at)) corrected.push_back(i);
                continue;
            }
            fresh.push_back(i);
            paths.push_back(files_[i].path);
        }
        if (fresh.empty() && moved.empty() && corrected.empty() && !refused) return;
        if (!fresh.empty()) course_.keep_files(paths, [](std::size_t, const StoredFile&) {});
        const std::string nothing = refused ? course_.keep("") : "";
        if (refused) course_.settle({nothing});
        Transaction transaction(course_.database());
        for (const std::size_t i : fresh) add(received_.items[i], files_[i]);
        for (const std::size_t i : corrected)
            log_arrival(course_, assignment_, received_.items[i].version, files_[i].at,
                        "according to the platform's table of times", now_);
        for (const std::size_t i : moved) take_from_others(received_.items[i]);
        for (std::size_t i = 0; i < files_.size(); ++i)
            if (!files_[i].error_reason.empty())
                refuse(received_.items[i].submission.name, files_[i].error_reason, files_[i].at, nothing);
        for (const Message& clause : left_out_) refuse("-", clause, now_, nothing);
        if (!fresh.empty()) course_.note(fmt::format("{}: {} received, first", assignment_.name, fresh.size()), now_);
        transaction.commit();
    }

    /// What cannot be taken leaves a trace, once for each reason. `nothing`: hash of an empty file.
    void refuse(const std::string& name, const Message& why, Instant at, const std::string& nothing) {
        const std::string findings = unreadable_inspection(kNotTaken, why).json;
        Rows last = course_.database().query(
            "SELECT ifnull(max(number), 0), ifnull(max(name = ? AND findings = ?), 0) FROM versions WHERE assignment = "
            "? AND group_id IS NULL AND part = ?",
            name, findings, assignment_.id, kUnreadable);
        last.next();
        if (last.integer(1) != 0) return;
        add_version(course_, assignment_,
                    {0, "", kStage, kUnreadable, {}, last.integer(0) + 1, nothing, name, 0, at, findings}, now_);
        course_.note(fmt::format("{}: {} was not taken: {}", assignment_.name, name, message_text(why)), now_);
    }

    /// Under which its file is kept: an archive's with its ending.
    static std::string file_name(const Submission& submission) {
        return is_one_archive(submission) ? submission.path.filename().string() : submission.name;
    }

    /// The group of the student or group that owns the item; null if it has no owner.
    const Group* group_of_owner(const WorkItem& one) const {
        if (one.students.empty()) return nullptr;
        const auto found = groups_.find(one.group.empty() ? students_[one.students.front()].id : one.group);
        return found == groups_.end() ? nullptr : &found->second;
    }

    bool is_known(WorkItem& one, std::set<Instant>& received) {
        const Group* const owner = group_of_owner(one);  // work without an owner has a group without members
        Rows rows = course_.database().query(
            "SELECT id, group_id, received_at, (SELECT w.received_at FROM arrived w WHERE w.id = v.id) FROM versions v "
            "WHERE assignment = ?1 AND name = ?2 AND hash = ?3 AND stage = ?4 AND part = ?5 AND CASE ?6 WHEN 0 THEN "
            "NOT EXISTS (SELECT 1 FROM memberships m WHERE m.group_id = v.group_id) "
            "ELSE group_id = ?6 END ORDER BY id DESC LIMIT 1",
            assignment_.id, file_name(one.submission), one.content, kStage, kPart,
            owner == nullptr ? std::int64_t{0} : owner->id);
        if (!rows.next()) return false;
        one.version = rows.integer(0), one.group_id = rows.integer(1);
        received = {rows.integer(2), rows.integer(3)};
        return true;
    }

    void add(WorkItem& one, const File& file) {
        const std::string name = file_name(one.submission);
        const Group group = group_for(one, name);
        Rows last = course_.database().query(
            "SELECT ifnull(max(number), 0) FROM versions WHERE assignment = ? AND group_id = ? AND stage = ? AND part "
            "= ?",
            assignment_.id, group.id, kStage, kPart);
        last.next();
        NewVersion version{group.id,    group.name, kStage,     kPart,   {}, last.integer(0) + 1,
                           one.content, name,       file.bytes, file.at, {}};
        one.version = add_version(course_, assignment_, version, now_).id;
        one.group_id = group.id;
        keep_participant(course_, assignment_.id, one.submission, group);
        take_from_others(one);
    }

    /// Whether the roster or the list of owners now assigns the item to another owner.
    bool is_with_other_group(const WorkItem& one) {
        return course_.database()
            .query("SELECT 1 FROM standing WHERE assignment = ? AND name = ? AND hash = ? AND group_id <> ?",
                   assignment_.id, file_name(one.submission), one.content, one.group_id)
            .next();
    }
    void take_from_others(const WorkItem& one) {
        course_.database().run(
            "INSERT INTO withdrawals (version, withdrawn, reason, made_at) SELECT id, id <> ?1, 'whose it is was "
            "corrected', ?2 FROM arrived WHERE id = ?1 AND withdrawn OR assignment = ?3 AND name = ?4 AND hash = ?5 "
            "AND group_id <> ?6 AND NOT withdrawn",
            one.version, now_, assignment_.id, file_name(one.submission), one.content, one.group_id);
        // A group that was made for this submission alone is left without work.
        course_.database().run(
            "UPDATE groups SET left_at = CASE id WHEN ?1 THEN NULL ELSE ?2 END, left_reason = 'whose it is was "
            "corrected' WHERE (id = ?1 AND left_reason = 'whose it is was corrected' OR id <> ?1 AND NOT EXISTS "
            "(SELECT 1 FROM memberships m WHERE m.group_id = groups.id)) AND id IN (SELECT group_id FROM versions "
            "WHERE assignment = ?3 AND name = ?4 AND hash = ?5)",
            one.group_id, now_, assignment_.id, file_name(one.submission), one.content);
    }

    /// Of work without an owner: the group of its earlier versions, or a new one.
    Group group_for(const WorkItem& one, const std::string& name) {
        Database& db = course_.database();
        if (const Group* const owner = group_of_owner(one)) return *owner;
        Rows before = db.query(
            "SELECT g.id, g.name FROM versions v JOIN groups g ON g.id = v.group_id WHERE v.assignment = ? AND v.name "
            "= ? AND NOT EXISTS (SELECT 1 FROM memberships m WHERE m.group_id = g.id) ORDER BY v.id DESC LIMIT 1",
            assignment_.id, name);
        if (before.next()) return {before.integer(0), before.text(1), false, {}};
        std::string own = one.submission.name;
        for (int i = 2; db.query("SELECT 1 FROM groups WHERE name = ?", own).next(); ++i)
            own = fmt::format("{} ({})", one.submission.name, i);
        db.run("INSERT INTO groups (name, joined_at) VALUES (?, ?)", own, now_);
        return {db.getLastInsertRowid(), own, false, {}};
    }

    Course& course_;
    const Assignment& assignment_;
    const ArrivalTimes& times_;
    const Instant now_;
    const std::vector<Student> students_;
    std::map<std::string, Group> groups_;
    ReceivedClass received_;
    std::vector<Message> left_out_;
    std::vector<File> files_;  ///< of the submissions
    TemporaryFolder packed_;
};

}  // namespace

std::vector<Student> lone_students_of(Course& course) {
    std::vector<Student> students = students_of(course);
    for (Student& student : students)
        if (student.group == student.id) student.group.clear();
    return students;
}

void set_owners(Course& course, const Assignment& assignment, const fs::path& list) {
    const std::vector<Student> students = lone_students_of(course);
    if (students.empty()) throw EnvironmentError("--owners needs a roster; give --roster CSV");
    Owners(students).read_list(list);
    const std::string hash = course.keep(read_file(list));
    course.settle({hash});
    if (course.saved_entry(owners_setting(assignment)) == hash) return;
    Transaction transaction(course.database());
    course.register_file(hash, static_cast<std::int64_t>(fs::file_size(list)), CourseClock::now());
    course.save_entry(owners_setting(assignment), hash);
    course.note(fmt::format("{}: owners of submissions imported", assignment.name));
    transaction.commit();
}

ReceivedClass receive_class(Course& course, const Assignment& assignment, const ClassSubmissions& submissions,
                            const ArrivalTimes& times, Instant now) {
    return ClassReceiver(course, assignment, submissions, times, now).run();
}

}  // namespace dynlab::inline course
