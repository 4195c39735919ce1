// When submissions came. Oracles: calendar and clock by hand; Moodle's dates in several languages; the bytes of zips,
// whose times have no zone.
#include "course/intake/arrival_times.h"

#include <gmock/gmock.h>

#include <ctime>

#include "course/course_bench.h"
#include "platform/error.h"
#include "support/environment_variable.h"

namespace dynlab::test {
namespace test_arrival_times {
using ::testing::HasSubstr;

constexpr Instant kAfternoon = 1773075000;  // 2026-03-09 17:50 in Paris, 16:50 UTC

class arrival_times : public testing::Test {
  protected:
    arrival_times() { ::tzset(); }
    ArrivalTimes table(const std::string& text) const {
        write_file_atomically(folder_.path() / "times.csv", text);
        return ArrivalTimes(folder_.path() / "times.csv");
    }
    static Submission named(const std::string& name) {
        Submission submission;
        submission.name = name;
        read_lms_name(submission);
        return submission;
    }
    EnvironmentVariable zone_{"TZ", "Europe/Paris"};
    TemporaryFolder folder_;
};

TEST_F(arrival_times, moodle_s_worksheets_are_read_in_their_language) {
    for (const char* text :
         {"Identifier,Last modified (submission),Last modified (grade)\nParticipant 99345,\"Monday, 9 March 2026, 5:50 "
          "PM\",\"Tuesday, 10 March 2026, 5:50 PM\"\n",
          "Identifiant;Dernière modification (note);Dernière modification (travail remis)\nParticipant 99345;mardi 10 "
          "mars 2026, 17:50;lundi 9 mars 2026, 17:50\n",
          "Identificador;Última modificación (entrega)\nParticipante 99345;lunes, 9 de marzo de 2026, 17:50\n",
          "id,time\n99345,2026-03-09 17:50\n", "id,submitted_at\n99345,2026-03-09T16:50:00Z\n"}) {
        const auto time = table(text).of(named("Élise Lefèvre_99345_assignsubmission_file_"));
        ASSERT_TRUE(time) << text;
        EXPECT_EQ(*time, kAfternoon) << text;
    }
    EXPECT_FALSE(table("id,time\n1,-\n").of(named("1")));
    EXPECT_TRUE(table("id,time\ns7,2026-03-09 17:50\n").of(named("work"), {"g1", "s7"}));
    EXPECT_THROW(table("id,time\n1,soon\n"), EnvironmentError);
    EXPECT_THROW(table("id,grade\n1,2\n"), EnvironmentError);
}

/// A zip as Moodle writes it: DOS times alone, which are what a clock on the wall shows.
TEST_F(arrival_times, times_in_zips_are_in_the_course_s_zone) {
    const Workbench work;
    const ChildResult made = work.shell(
        "python3 -c \"import zipfile\nz = zipfile.ZipFile('all.zip', 'w')\n"
        "z.writestr(zipfile.ZipInfo('a/analysis.lua', (2026, 3, 9, 17, 50, 0)), 'x')\nz.close()\"");
    ASSERT_EQ(made.exit_code, 0) << made.error_output;
    const Isolation level = obstacle_to(Isolation::kFull) ? Isolation::kProcess : Isolation::kFull;
    // On 9 March Paris is an hour ahead of UTC, and New York, in summer time since the 8th, four behind.
    for (const auto& [zone, behind] : {std::pair("Europe/Paris", 0), {"UTC", 1}, {"America/New_York", 5}}) {
        const EnvironmentVariable here("TZ", zone);
        ::tzset();
        const std::filesystem::path to = work.path(std::to_string(behind));
        unpack_export(work.path("all.zip"), to, level, DYNLAB_PROGRAM);
        EXPECT_EQ(time_in_archive(to / "a/analysis.lua"), kAfternoon + behind * 3600) << zone;
    }
    ::tzset();
}

TEST_F(arrival_times, a_class_that_is_late_as_a_whole_is_asked_about) {
    const std::vector<std::int64_t> half_an_hour(27, 1800);
    EXPECT_THAT(message_text(doubt_about_zone(half_an_hour, 27)),
                HasSubstr("27 of 27 files are late, half of them by 30 min or less: check the time zone Europe/Paris"));
    EXPECT_TRUE(doubt_about_zone({1800, 1800, 1800}, 27).empty());
    EXPECT_TRUE(doubt_about_zone({1800}, 1).empty());
    EXPECT_TRUE(doubt_about_zone({1800, 1800, 200 * 3600}, 3).empty()) << "no zone explains eight days";
    EXPECT_FALSE(doubt_about_zone(std::vector<std::int64_t>(9, 3600), 10).empty());
}

}  // namespace test_arrival_times
}  // namespace dynlab::test
