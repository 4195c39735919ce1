#include "course/review/returns.h"

#include <fmt/format.h>

#include <algorithm>

#include "course/grading/zip_file.h"
#include "course/store/groups.h"
#include "course/store/hand_ins.h"
#include "data_io/text_table.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/hash.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

struct FileToReturn {
    std::string place;  ///< "to-review/report-07.pdf"
    std::string content, hash;
    std::string name() const { return fs::path(place).filename(); }
};

class Returner {
  public:
    Returner(Course& course, const Assignment& assignment, const ReturnRequest& request)
        : course_(course), assignment_(assignment), request_(request) {
        for (const Student& student : students_of(course)) students_[student.id] = student;
    }

    ReturnOutcome run() {
        if (fs::exists(request_.folder))
            throw InvalidArgument(fmt::format("{} exists already; name a new folder", request_.folder.string()));
        for (const Group& group : groups_of(course_)) collect(group);
        if (outcome_.files.empty()) return std::move(outcome_);
        lay_out();
        remember();
        return std::move(outcome_);
    }

  private:
    void collect(const Group& group) {
        std::vector<FileToReturn> files;
        for (const char* way : {"to-review", "reviews"}) {
            const fs::path folder = course_.folder() / "outbox" / assignment_.name / way / group.name;
            if (!fs::exists(folder)) continue;
            for (const auto& entry : fs::directory_iterator(folder))
                add(files, group, std::string(way) + "/" + entry.path().filename().string(), entry.path());
        }
        for (Rows rows = course_.database().query("SELECT id FROM versions WHERE assignment = ? AND group_id = ?",
                                                  assignment_.id, group.id);
             rows.next();) {
            const fs::path receipt = write_receipt(course_, rows.integer(0));
            add(files, group, "receipts/" + receipt.filename().string(), receipt);
        }
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
        if (request_.all || !newest.next() || newest.text(0) != file.hash) files.push_back(std::move(file));
    }

    void lay_out() {
        const fs::path growing = request_.folder.string() + ".unfinished";
        fs::remove_all(growing);
        TextTable mails;
        mails.names = {"group", "members", "mails", "files"};
        std::map<std::string, std::string> zip;
        for (const auto& [group, files] : groups_) {
            fs::create_directories(growing / group.name);
            for (const FileToReturn& file : files)
                write_file_atomically(growing / group.name / file.name(), file.content);
            add_member_rows(group, files, mails);
            if (request_.moodle) add_moodle_folders(group, files, zip);
        }
        write_file_atomically(growing / "mail.csv", csv_text(mails));
        if (request_.moodle) write_zip(growing / "moodle.zip", zip);
        fs::permissions(growing, fs::perms::owner_all);
        fs::rename(growing, request_.folder);
    }

    void add_member_rows(const Group& group, const std::vector<FileToReturn>& files, TextTable& mails) {
        std::vector<std::string> names, addresses, own;
        for (const std::string& id : group.members) {
            const Student& student = students_[id];
            names.push_back(student.name.empty() ? id : student.name);
            if (!student.mail.empty()) addresses.push_back(student.mail);
        }
        for (const FileToReturn& file : files) own.push_back(group.name + "/" + file.name());
        if (addresses.empty()) outcome_.without_mail.push_back(group.name);
        mails.rows.push_back({group.name, fmt::format("{}", fmt::join(names, "; ")),
                              fmt::format("{}", fmt::join(addresses, "; ")), fmt::format("{}", fmt::join(own, "; "))});
    }

    void add_moodle_folders(const Group& group, const std::vector<FileToReturn>& files,
                            std::map<std::string, std::string>& zip) {
        for (const std::string& id : group.members) {
            const Student& student = students_[id];
            if (student.moodle.empty()) {
                outcome_.without_number.push_back(id);
                continue;
            }
            const std::string folder =
                fmt::format("{}_{}_assignsubmission_file_/", student.name.empty() ? id : student.name, student.moodle);
            for (const FileToReturn& file : files) zip[folder + file.name()] = file.content;
        }
    }

    void remember() {
        Transaction transaction(course_.database());
        std::size_t count = 0;
        for (const auto& [group, files] : groups_)
            for (const FileToReturn& file : files) {
                course_.database().run("INSERT INTO returns (group_id, place, hash, made_at) VALUES (?, ?, ?, ?)",
                                       group.id, assignment_.name + "/" + file.place, file.hash, request_.now);
                ++count;
            }
        course_.note(fmt::format("{}: {} files returned to {} groups", assignment_.name, count, groups_.size()),
                     request_.now);
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

}  // namespace dynlab::inline course
