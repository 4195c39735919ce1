// What students download. Oracles: unzip; the lesson's own files; the roster.
#include <gmock/gmock.h>

#include <set>

#include "course/export/bundle.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_student_bundles {
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Student student(const std::string& id, const std::string& group, std::optional<std::uint32_t> seed = {},
                const std::string& language = "") {
    Student one;
    one.id = id, one.group = group, one.seed = seed, one.language = language;
    return one;
}

TEST(student_bundles, groups_without_a_seed_get_one_that_stays) {
    std::vector<Student> roster = {student("1", "g1", 7), student("2", "g2"), student("3", "g2", {}, "fr"),
                                   student("4", "")};
    const std::vector<BundleOwner> owners = bundle_owners(roster, {});
    ASSERT_EQ(owners.size(), 3u);
    EXPECT_EQ(owners[0].seed, 7u);
    EXPECT_EQ(owners[1].language, "fr");
    EXPECT_EQ(owners[2].name, "4");
    std::set<std::uint32_t> seeds;
    for (const BundleOwner& one : owners) seeds.insert(one.seed);
    EXPECT_FALSE(seeds.contains(0));
    EXPECT_EQ(seeds.size(), 3u);
    EXPECT_EQ(roster[1].seed, owners[1].seed);
    EXPECT_EQ(roster[2].seed, owners[1].seed);
    // The file of the first call gives the same seeds to the same roster, and others to a group that came later.
    const TemporaryFolder folder;
    write_file_atomically(folder.path() / "roster.csv", roster_text(roster));
    std::vector<Student> again = {student("5", "g9"), student("2", "g2"), student("4", ""), student("1", "g1", 7)};
    const std::vector<BundleOwner> later = bundle_owners(again, Roster(folder.path() / "roster.csv").students());
    EXPECT_EQ(later[1].seed, owners[1].seed);
    EXPECT_EQ(later[2].seed, owners[2].seed);
    EXPECT_FALSE(seeds.contains(later[0].seed));
    std::vector<Student> different = {student("1", "g1", 7), student("2", "g1", 8)};
    EXPECT_THROW(bundle_owners(different, {}), EnvironmentError);
}

TEST(student_bundles, are_in_the_language_that_is_asked_for) {
    const Workbench work;
    const Lesson lesson = find_lesson("03_crane");
    work.write("03_crane_sheet.pdf", "%PDF-1.4 tasks");
    const std::vector<std::string> names =
        bundle_lesson(lesson, work.path("fr.zip"), {{}, "fr", work.path("03_crane_sheet.pdf")});
    EXPECT_THAT(names, Contains("03_crane_sheet.pdf"));
    EXPECT_THAT(names, Contains("03_crane_README.md"));
    EXPECT_THAT(names, Not(Contains(HasSubstr("solution"))));
    EXPECT_THAT(work.shell("unzip -p fr.zip 03_crane/analysis.lua").output,
                HasSubstr("-- title: Identification d'une"));
    EXPECT_THAT(work.shell("unzip -p fr.zip 03_crane/report.md").output, HasSubstr("lang: fr"));
    const std::string readme = work.shell("unzip -p fr.zip 03_crane_README.md").output;
    EXPECT_THAT(readme, HasSubstr("    dynlab pack 03_crane\n"));
    EXPECT_THAT(readme, HasSubstr("apt install"));
    EXPECT_THAT(readme, HasSubstr("dynlab help guide-first-hour\n"));
    EXPECT_THAT(readme, Not(HasSubstr("Write your analysis")));
}

}  // namespace test_student_bundles
}  // namespace dynlab::test
