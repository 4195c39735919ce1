#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/course_bench.h"
#include "course/store/newest_versions.h"
#include "numerics/error.h"

namespace dynlab::test {
namespace test_group_names {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

/// Two students called Wei Li in different groups, two called Petit in one.
class ClassOfNames {
  public:
    ClassOfNames() {
        Course::create(folder_.path() / "k", "k", "UTC");
        read(
            "id,name,mail,moodle,group\n"
            "221,Íñigo Úbeda,i@uni.eu,901,group-08\n"
            "222,Kim Min-jun,k@uni.eu,902,group-08\n"
            "223,Anne Petit,a@uni.eu,903,group-09\n"
            "224,Paul Petit,p@uni.eu,904,group-09\n"
            "225,Wei Li,w@uni.eu,905,group-10\n"
            "226,Wei Li,x@uni.eu,906,group-11\n"
            "227,D'Arc Élise,d@uni.eu,907,\n");
    }
    void read(const std::string& roster) {
        write_file_atomically(folder_.path() / "roster.csv", roster);
        Course course = open();
        import_roster(course, folder_.path() / "roster.csv");
    }
    Course open() const { return Course(folder_.path() / "k"); }
    std::string meant(const std::string& name) const {
        Course course = open();
        try {
            return group_named(course, name).name;
        } catch (const InvalidArgument& error) {
            return error.what();
        }
    }

  private:
    TemporaryFolder folder_;
};

// oracle: the roster above
TEST(group_names, every_unique_identifier_means_its_group) {
    const ClassOfNames names;
    for (const char* name : {"group-08", "GROUP-08", "Group 8", "gruppe_8", "groupe 08", "221", "Íñigo Úbeda",
                             "Ubeda Inigo", "Kim Min-jun", "minjun kim", "k@uni.eu", "902", "Úbeda"})
        EXPECT_EQ(names.meant(name), "group-08") << name;
    EXPECT_EQ(names.meant("Petit"), "group-09");
    EXPECT_EQ(names.meant("226"), "group-11");
    EXPECT_EQ(names.meant("d'arc"), "227");
}

// oracle: the roster above; an unclear name is assigned to no student
TEST(group_names, ambiguous_and_unknown_names_are_refused) {
    const ClassOfNames names;
    EXPECT_THAT(names.meant("Wei Li"), HasSubstr("matches several groups"));
    EXPECT_THAT(names.meant("Group 80"), HasSubstr("the group \"Group 80\" does not exist"));
    EXPECT_THAT(names.meant(""), HasSubstr("does not exist"));
    EXPECT_THAT(names.meant("gruop-09"), HasSubstr("did you mean group-09?"));
    Course course = names.open();
    EXPECT_EQ(student_named(course, "Paul Petit").id, "224");
    EXPECT_THROW(student_named(course, "Petit"), InvalidArgument);
    EXPECT_THROW(student_named(course, "Wei Li"), InvalidArgument);
}

// oracle: issue found in a term: Moodle's "Groupe 01" and the roster's group-01 became two groups
TEST(group_names, another_spelling_in_a_later_roster_is_the_known_group) {
    ClassOfNames names;
    names.read("id,group\n221,Groupe 8\n222,GROUP_08\n12,\n");
    names.read("id,group\n13,group-12\n");  // not that of student 12, who works alone
    EXPECT_EQ(names.meant("221"), "group-08");
    EXPECT_EQ(names.meant("222"), "group-08");
    EXPECT_EQ(names.meant("13"), "group-12");
    EXPECT_EQ(names.meant("12"), "12");
    names.read("id,group\n221,group-08\n222,Groupe 8\n");  // both in one roster: they are two
    EXPECT_EQ(names.meant("222"), "Groupe 8");
    EXPECT_EQ(names.meant("221"), "group-08");
}

// oracle: the platform writes the family's name first
TEST(group_names, the_same_words_in_another_order_are_no_former_name) {
    ClassOfNames names;
    names.read("id,name,group\n222,Min-jun Kim,group-08\n223,Anne Durand,group-09\n");
    Course course = names.open();
    EXPECT_THAT(student_named(course, "222").former, ::testing::IsEmpty());
    EXPECT_EQ(student_named(course, "223").former.size(), 1u);
}

// oracle: the definition: who was in the group at that instant; the first group counts from the beginning
TEST(group_names, membership_is_the_one_at_the_time) {
    ClassOfNames names;
    Course course = names.open();
    const std::int64_t nine = group_named(course, "group-09").id, eight = group_named(course, "group-08").id;
    const Instant long_ago = 1000;
    EXPECT_THAT(members_at(course, nine, long_ago), ElementsAre("223", "224"));
    course.database().run("UPDATE memberships SET since = 2000");
    course.database().run("UPDATE memberships SET until = 3000 WHERE student = '224'");
    course.database().run("INSERT INTO memberships VALUES ('224', ?, 3000, NULL)", eight);
    EXPECT_THAT(members_at(course, nine, long_ago), ElementsAre("223", "224"));
    EXPECT_THAT(members_at(course, nine, 2999), ElementsAre("223", "224"));
    EXPECT_THAT(members_at(course, nine, 3000), ElementsAre("223"));
    EXPECT_THAT(members_at(course, eight, 2999), ElementsAre("221", "222"));
    EXPECT_THAT(members_at(course, eight, 3000), ElementsAre("221", "222", "224"));
}

// oracle: issue found in a term: Ravi moved from group-01 to group-02 after both had submitted
TEST(group_names, work_belongs_to_the_members_when_it_was_submitted) {
    CourseBench bench(3);
    const auto take = [&](int group, const std::string& at) {
        const std::string file = CourseBench::group(group) + ".pdf";
        CourseBench::expect_done(bench.submit_file(file, small_pdf(file), at));
    };
    take(1, "2026-02-27 12:00");
    take(2, "2026-02-27 12:00");
    bench.bench().write("moved.csv", "id,group\ns1,group-02\n");
    CourseBench::expect_done(bench.course({"import", "moved.csv"}));
    Course course(bench.bench().path("k"));
    const Assignment crane = assignment_named(course, "crane");
    const std::int64_t first = group_named(course, "group-01").id, second = group_named(course, "group-02").id,
                       third = group_named(course, "group-03").id;
    EXPECT_THAT(author_groups(course, crane),
                UnorderedElementsAre(Pair("s1", first), Pair("s2", second), Pair("s3", third)));
}

}  // namespace test_group_names
}  // namespace dynlab::test
