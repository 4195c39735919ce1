// The submissions of a folder in the course that grade makes of them. Oracle: the tables, and the files.
#include "course/office/receive_class.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "base/reader.h"
#include "course/office/course_work.h"
#include "course/office/deadline_import.h"
#include "course/store/newest_versions.h"
#include "course/store/store_check.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_receive_class {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class received_class : public testing::Test {
  protected:
    received_class() {
        for (const char* name : {"group-1", "Ben Lee", "stranger"})
            write(std::string("in/") + name + "/analysis.lua", "");
        write("roster.csv",
              "id,name,group,seed,language\n1,Anna Müller,group-1,7,fr\n2,Zoë Ade,group-1,7,fr\n3,Ben Lee,,,\n");
        Course::create(folder_.path() / "k", "k", "UTC");
        course_.emplace(folder_.path() / "k");
        Assignment lab;
        lab.name = lab.lesson = "04", lab.kind = "lab", lab.costs.late_day = 10;
        set_assignment(*course_, lab);
    }
    void write(const std::string& name, const std::string& text) {
        fs::create_directories((folder_.path() / name).parent_path());
        write_file_atomically(folder_.path() / name, text);
    }
    Assignment lab() { return assignment_named(*course_, ""); }
    ReceivedClass receive(const ArrivalTimes& times = {}) {
        const ClassSubmissions submissions(folder_.path() / "in", Isolation::kProcess, DYNLAB_PROGRAM);
        return receive_class(*course_, lab(), submissions, times, 1'800'000'000);
    }
    ClassWork work(const ReceivedClass& received) { return CourseWork(*course_, lab(), received).work(); }
    static const WorkItem& item(const ClassWork& work, const std::string& name) {
        const auto found =
            std::ranges::find_if(work.items, [&](const WorkItem& one) { return one.submission.name == name; });
        return found == work.items.end() ? throw EnvironmentError("no {}", name) : *found;
    }
    std::int64_t count(const std::string& what) {
        Rows rows = course_->database().query("SELECT count(*) FROM " + what);
        return rows.next() ? rows.integer(0) : -1;
    }
    void import() { import_roster(*course_, folder_.path() / "roster.csv", true); }

    TemporaryFolder folder_;
    std::optional<Course> course_;
};

TEST_F(received_class, without_a_roster_has_submissions_without_owners) {
    const ClassWork all = work(receive());
    EXPECT_FALSE(all.roster);
    ASSERT_EQ(all.items.size(), 3u);
    for (const WorkItem& one : all.items) {
        EXPECT_THAT(one.students, IsEmpty());
        EXPECT_EQ(one.lateness.percent, 0);
        EXPECT_TRUE(one.unmatched.empty());
        EXPECT_NE(one.version, 0);
    }
    EXPECT_EQ(count("groups"), 3);
}

TEST_F(received_class, knows_whose_each_is_and_how_they_are_addressed) {
    import();
    const ClassWork all = work(receive());
    const WorkItem &group = item(all, "group-1"), &ben = item(all, "Ben Lee");
    EXPECT_THAT(group.students, ElementsAre(0u, 1u));
    EXPECT_EQ(group.addressee, "group-1");
    EXPECT_EQ(group.language, "fr");
    EXPECT_EQ(group.seed, 7u);
    EXPECT_THAT(ben.students, ElementsAre(2u));
    EXPECT_EQ(ben.addressee, "Ben Lee");
    EXPECT_FALSE(ben.seed);
    EXPECT_FALSE(item(all, "stranger").unmatched.empty());
}

TEST_F(received_class, knows_what_lateness_costs_and_which_rows_match_nothing) {
    import();
    const ReceivedClass received = receive();
    write("deadlines.csv",
          "submission,deadline,received\n*,2096-03-01 18:00,\nBen Lee,,2096-03-02 19:00\nNemo,2096-03-02 18:00,\n");
    const DeadlineImport done = import_deadlines(*course_, lab(), folder_.path() / "deadlines.csv", 1'800'000'000);
    const ClassWork all = work(received);
    EXPECT_EQ(item(all, "group-1").lateness.percent, 0);
    EXPECT_EQ(item(all, "Ben Lee").lateness.hours, 25);
    EXPECT_EQ(item(all, "Ben Lee").lateness.percent, 20);
    ASSERT_EQ(done.complaints.size(), 1u);
    EXPECT_THAT(message_text(done.complaints[0]), HasSubstr("\"Nemo\""));
}

TEST_F(received_class, list_of_owners_needs_students_and_stays) {
    write("owners.csv", "submission,id\nstranger,3\n");
    EXPECT_THROW(set_owners(*course_, lab(), folder_.path() / "owners.csv"), EnvironmentError);
    import();
    set_owners(*course_, lab(), folder_.path() / "owners.csv");
    fs::remove(folder_.path() / "owners.csv");
    EXPECT_THAT(item(work(receive()), "stranger").students, ElementsAre(2u));
}

// oracle: the store, row by row
TEST_F(received_class, equal_folder_adds_nothing_and_a_changed_one_a_version) {
    import();
    const std::int64_t first = item(work(receive()), "group-1").version;
    fs::rename(folder_.path() / "in", folder_.path() / "moved");
    for (const char* name : {"stranger", "Ben Lee", "group-1"})  // in another order, and at another time
        write(std::string("in/") + name + "/analysis.lua", "");
    const std::int64_t journal = count("journal");
    EXPECT_EQ(item(work(receive()), "group-1").version, first);
    EXPECT_EQ(count("versions"), 3);
    EXPECT_EQ(count("journal"), journal);
    write("in/group-1/analysis.lua", "-- better");
    EXPECT_GT(item(work(receive()), "group-1").version, first);
    EXPECT_EQ(count("versions"), 4);
    EXPECT_THAT(check_store(*course_).error_list, IsEmpty());
}

// oracle: unzip, another program
TEST_F(received_class, keeps_all_files_of_a_folder_in_one_zip) {
    write("in/group-1/notes/ü.txt", "u");
    import();
    const std::int64_t version = item(work(receive()), "group-1").version;
    const auto kept = standing_file(*course_, version);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->name, "group-1");
    EXPECT_EQ(Workbench().shell("unzip -Z1 " + course_->file(kept->hash).string()).output,
              "analysis.lua\nnotes/ü.txt\n");
}

TEST_F(received_class, what_cannot_be_kept_leaves_a_trace) {
    fs::create_symlink("/etc/passwd", folder_.path() / "in/link.lua");
    receive();
    ASSERT_EQ(count("versions WHERE part = 'unreadable'"), 1);
    EXPECT_EQ(count("versions WHERE part = 'unreadable' AND findings LIKE '%link.lua%'"), 1);
    receive();
    EXPECT_EQ(count("versions WHERE part = 'unreadable'"), 1);
}

// oracle: whose it is by the list that was given last
TEST_F(received_class, submission_goes_to_the_owner_of_the_newest_list) {
    import();
    receive();
    write("owners.csv", "submission,id\nstranger,3\n");
    set_owners(*course_, lab(), folder_.path() / "owners.csv");
    receive();
    EXPECT_EQ(count("standing WHERE name = 'stranger'"), 1);
    write("owners.csv", "submission,group\nstranger,group-1\n");
    set_owners(*course_, lab(), folder_.path() / "owners.csv");
    EXPECT_THAT(item(work(receive()), "stranger").group, "group-1");
    write("owners.csv", "submission,id\nstranger,3\n");
    set_owners(*course_, lab(), folder_.path() / "owners.csv");
    EXPECT_THAT(item(work(receive()), "stranger").students, ElementsAre(2u));
    EXPECT_EQ(count("standing WHERE name = 'stranger'"), 1);
}

// oracle: the platform's table goes before the times of files
TEST_F(received_class, was_received_as_the_platform_s_table_says) {
    write("times.csv", "id,time\n3,2026-03-09 17:50\n");
    import();
    const std::string times = (folder_.path() / "times.csv").string();
    const Instant reported = 1773078600;  // date -u -d '2026-03-09 17:50' +%s
    EXPECT_EQ(item(work(receive(ArrivalTimes(times))), "Ben Lee").received, reported);
    write("times.csv", "id,time\n3,2026-03-09 18:50\n");
    EXPECT_EQ(item(work(receive(ArrivalTimes(times))), "Ben Lee").received, reported + 3600);
    EXPECT_EQ(item(work(receive()), "Ben Lee").received, reported + 3600);
    EXPECT_GT(item(work(receive()), "group-1").received, reported);
}

}  // namespace test_receive_class
}  // namespace dynlab::test
