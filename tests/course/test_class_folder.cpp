// The list of work that a folder and its tables make. Oracle: the tables.
#include "course/grading/class_folder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <ctime>
#include <optional>

#include "base/reader.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "support/environment_variable.h"

namespace dynlab::test {
namespace test_class_folder {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class class_folder : public testing::Test {
  protected:
    class_folder() {
        zone_.emplace("TZ", "UTC");
        ::tzset();
        for (const char* name : {"group-1", "Ben Lee", "stranger"})
            write(std::string("in/") + name + "/analysis.lua", "");
        write("roster.csv",
              "id,name,group,seed,language\n1,Anna Müller,group-1,7,fr\n2,Zoë Ade,group-1,7,fr\n3,Ben Lee,,,\n");
        sources_.submissions = folder_.path() / "in";
    }
    ~class_folder() override {
        zone_.reset();
        ::tzset();
    }
    void write(const std::string& name, const std::string& text) {
        fs::create_directories((folder_.path() / name).parent_path());
        write_file_atomically(folder_.path() / name, text);
    }
    const WorkItem& item(const ClassWork& work, const std::string& name) {
        const auto found =
            std::ranges::find_if(work.items, [&](const WorkItem& one) { return one.submission.name == name; });
        return found == work.items.end() ? throw EnvironmentError("no {}", name) : *found;
    }

    TemporaryFolder folder_;
    ClassSources sources_;

  private:
    std::optional<EnvironmentVariable> zone_;
};

TEST_F(class_folder, without_a_roster_has_submissions_and_nobody) {
    const ClassFolder folder(sources_, folder_.path() / "out", {});
    const ClassWork& work = folder.work();
    EXPECT_FALSE(work.roster);
    EXPECT_THAT(work.chosen, ElementsAre(0, 1, 2));
    for (const WorkItem& one : work.items) {
        EXPECT_THAT(one.students, IsEmpty());
        EXPECT_EQ(one.lateness.percent, 0);
        EXPECT_TRUE(one.unmatched.empty());
    }
}

TEST_F(class_folder, knows_whose_each_is_and_how_they_are_addressed) {
    sources_.roster = folder_.path() / "roster.csv";
    const ClassFolder folder(sources_, folder_.path() / "out", {});
    const WorkItem &group = item(folder.work(), "group-1"), &ben = item(folder.work(), "Ben Lee");
    EXPECT_THAT(group.students, ElementsAre(0, 1));
    EXPECT_EQ(group.addressee, "group-1");
    EXPECT_EQ(group.language, "fr");
    EXPECT_EQ(group.seed, 7u);
    EXPECT_THAT(ben.students, ElementsAre(2));
    EXPECT_EQ(ben.addressee, "Ben Lee");
    EXPECT_FALSE(ben.seed);
    EXPECT_FALSE(item(folder.work(), "stranger").unmatched.empty());
}

TEST_F(class_folder, knows_what_lateness_costs_and_which_rows_match_nothing) {
    sources_.roster = folder_.path() / "roster.csv";
    sources_.deadlines = folder_.path() / "deadlines.csv";
    write("deadlines.csv",
          "submission,deadline,received\n*,2096-03-01 18:00,\nBen Lee,,2096-03-02 19:00\nNemo,2096-03-02 18:00,\n");
    const ClassFolder folder(sources_, folder_.path() / "out", {});
    EXPECT_EQ(item(folder.work(), "group-1").lateness.percent, 0);
    EXPECT_EQ(item(folder.work(), "Ben Lee").lateness.hours, 25);
    EXPECT_EQ(item(folder.work(), "Ben Lee").lateness.percent, 20);
    ASSERT_EQ(folder.work().complaints.size(), 1u);
    EXPECT_THAT(message_text(folder.work().complaints[0]), HasSubstr("\"Nemo\""));
}

TEST_F(class_folder, owners_need_a_roster) {
    write("owners.csv", "submission,id\nstranger,3\n");
    sources_.owners = folder_.path() / "owners.csv";
    EXPECT_THROW(ClassFolder(sources_, folder_.path() / "out", {}), EnvironmentError);
    sources_.roster = folder_.path() / "roster.csv";
    const ClassFolder folder(sources_, folder_.path() / "out", {});
    EXPECT_THAT(item(folder.work(), "stranger").students, ElementsAre(2));
}

}  // namespace test_class_folder
}  // namespace dynlab::test
