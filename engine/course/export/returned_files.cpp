#include "course/export/returned_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/reader.h"
#include "course/export/mailing.h"
#include "course/export/platform_sheet.h"
#include "course/store/newest_versions.h"
#include "course/store/receipts.h"
#include "course/store/senders.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/locks/complete_folder.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

struct FileToReturn {
    std::string place;  ///< "to-review/report-07.pdf"
    std::string content, hash;
    bool is_new = true;
    std::string name() const { return fs::path(place).filename(); }
};

class Returner {
  public:
    Returner(Course& course, const Assignment& assignment, const ReturnRequest& request)
        : course_(course), assignment_(assignment), request_(request) {
        for (const Student& student : students_of(course)) students_[student.id] = student;
        if (request.moodle) settle_numbers();
    }

    ReturnOutcome run() {
        if (fs::exists(request_.folder))
            throw InvalidArgument("{} already exists; give the name of a new folder", request_.folder.string());
        for (const Group& group : groups_of_authors(course_, assignment_)) collect(group);
        if (outcome_.files.empty()) return std::move(outcome_);
        lay_out();
        save_entry();
        return std::move(outcome_);
    }

  private:
    void settle_numbers() {
        if (!request_.worksheet.empty() &&
            PlatformSheet(request_.worksheet, "").platform() != PlatformSheet::Platform::kMoodle)
            throw InvalidArgument(
                "{} is Canvas's gradebook: the zip file for Moodle requires Moodle's grading worksheet",
                request_.worksheet.string());
        const std::map<std::string, std::string> numbers = participants_for(course_, assignment_, request_.worksheet);
        for (const auto& [id, number] : numbers)
            if (const Student& student = students_[id]; !student.moodle.empty() && student.moodle != number)
                ++outcome_.other_numbers;
        for (auto& [id, student] : students_) {
            const auto found = numbers.find(id);
            if (found != numbers.end())
                student.moodle = found->second;
            else if (outcome_.other_numbers > 0 || !request_.worksheet.empty())
                student.moodle.clear();
        }
    }

    void collect(const Group& group) {
        std::vector<FileToReturn> files;
        for (const char* way : {"to-review", "reviews"}) {
            const fs::path folder = course_.folder() / "outbox" / assignment_.name / way / group.name;
            if (!fs::exists(folder)) continue;
            for (const auto& entry : fs::directory_iterator(folder))
                add(files, group, std::string(way) + "/" + entry.path().filename().string(), entry.path());
        }
        std::vector<std::int64_t> versions;
        for (Rows rows = course_.database().query("SELECT id FROM versions WHERE assignment = ? AND group_id = ?",
                                                  assignment_.id, group.id);
             rows.next();)
            versions.push_back(rows.integer(0));
        for (const fs::path& receipt : write_receipts(course_, versions))
            add(files, group, "receipts/" + receipt.filename().string(), receipt);
        if (files.empty()) return;
        std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.place < b.place; });
        for (const FileToReturn& file : files) outcome_.files[group.name].push_back(file.name());
        groups_.emplace_back(group, std::move(files));
    }

    void add(std::vector<FileToReturn>& files, const Group& group, const std::string& place, const fs::path& from) {
        FileToReturn file{place, read_file(from), {}};
        file.hash = sha256_of(file.content);
        Rows newest = course_.database().query(
            "SELECT hash FROM returns WHERE group_id = ? AND place = ? ORDER BY id DESC LIMIT 1", group.id,
            assignment_.name + "/" + place);
        file.is_new = !newest.next() || newest.text(0) != file.hash;
        if (request_.all || file.is_new) files.push_back(std::move(file));
    }

    void lay_out() {
        make_complete_folder(request_.folder, [this](const fs::path& growing) {
            fs::permissions(growing, fs::perms::owner_all);
            std::vector<Mailing> mailings;
            MoodleFeedback moodle;
            for (const auto& [group, files] : groups_) {
                fs::create_directories(growing / group.name);
                for (const FileToReturn& file : files)
                    write_file_atomically(growing / group.name / file.name(), file.content);
                address(group, files, mailings, moodle);
            }
            write_file_atomically(growing / "mail.csv", csv_text(mailing_list(mailings)));
            if (request_.moodle) moodle.write(growing / "moodle.zip");
        });
    }

    void address(const Group& group, const std::vector<FileToReturn>& files, std::vector<Mailing>& mailings,
                 MoodleFeedback& moodle) {
        bool reached = false;
        for (const std::string& id : group.members) {
            const Student& student = students_[id];
            Mailing mailing{{id, student.name, group.name, student.mail, student.moodle}, {}, false};
            reached = reached || !student.mail.empty();
            if (request_.moodle && student.moodle.empty()) outcome_.without_number.push_back(id);
            for (const FileToReturn& file : files) {
                mailing.files.push_back(group.name + "/" + file.name());
                mailing.is_new = mailing.is_new || file.is_new;
                moodle.add(mailing.to, file.name(), file.content);
            }
            mailings.push_back(std::move(mailing));
        }
        if (!reached) outcome_.without_mail.push_back(group.name);
    }

    void save_entry() {
        Transaction transaction(course_.database());
        std::int64_t count = 0;
        for (const auto& [group, files] : groups_)
            for (const FileToReturn& file : files) {
                course_.database().run("INSERT INTO returns (group_id, place, hash, made_at) VALUES (?, ?, ?, ?)",
                                       group.id, assignment_.name + "/" + file.place, file.hash, request_.now);
                ++count;
            }
        const Message files = plural(count, "{} file", "{} files"),
                      groups = plural(static_cast<std::int64_t>(groups_.size()), "{} group", "{} groups");
        course_.note(message_text(Message("{}: {} delivered to {}", assignment_.name, files, groups)), request_.now);
        transaction.commit();
    }

    Course& course_;
    const Assignment& assignment_;
    const ReturnRequest& request_;
    std::map<std::string, Student> students_;
    std::vector<std::pair<Group, std::vector<FileToReturn>>> groups_;
    ReturnOutcome outcome_;
};

}  // namespace

ReturnOutcome return_files(Course& course, const Assignment& assignment, const ReturnRequest& request) {
    return Returner(course, assignment, request).run();
}

std::map<std::string, std::string> participants_for(Course& course, const Assignment& assignment,
                                                    const fs::path& table) {
    std::map<std::string, std::string> all = participants_of(course, assignment.id), reported;
    if (table.empty()) return all;
    try {
        if (const PlatformSheet sheet(table, ""); sheet.platform() == PlatformSheet::Platform::kMoodle) {
            const std::vector<Student> students = students_of(course);
            std::vector<SoughtPerson> sought;
            for (const Student& student : students) {
                const auto number = all.find(student.id);
                sought.push_back({student.id, student.mail, student.name, number == all.end() ? "" : number->second});
            }
            for (const auto& [place, person] : rows_of(sheet, sought)) reported[students[place].id] = person.number;
        }
    } catch (const EnvironmentError&) {  // a table of something else
    }
    reported.merge(all);
    return reported;
}

}  // namespace dynlab::inline course
