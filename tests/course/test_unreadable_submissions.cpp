#include <fmt/format.h>
#include <gmock/gmock.h>

#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_unreadable_submissions {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kAnswers = "--   x: number\n";
constexpr const char* kSolution = "answer('x', 42)\n";
constexpr const char* kWrong = "answer('x', 1)\n";
constexpr const char* kChecks =
    "check{id = 'x', points = 2, test = function(a) return near(a.x, 42, {rel = 0.01}) end}\n";

// oracle: what each of them holds instead of a file that may be taken
TEST(unreadable_submissions, that_are_left_out_have_a_reported_reason) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    work.write("make.py",
               "import zipfile\n"
               "with zipfile.ZipFile('in/absolute.zip', 'w') as z: z.writestr('/tmp/analysis.lua', '')\n"
               "with zipfile.ZipFile('in/bytes.zip', 'w') as z: z.writestr('\u00e9.lua', '')\n"
               "data = open('in/bytes.zip', 'rb').read().replace(b'\\xc3\\xa9', b'\\x82\\x82')\n"
               "open('in/bytes.zip', 'wb').write(data)\n");
    ASSERT_EQ(work.shell("mkdir -p in/pipe in/link && python3 make.py && mkfifo in/pipe/analysis.lua && "
                         "ln -s /etc/passwd in/link/analysis.lua")
                  .exit_code,
              0);
    EXPECT_EQ(bench.grade().exit_code, 1);
    for (const auto& [name, reported] :
         {std::pair("absolute", "Left out: \"/tmp/analysis.lua\" points outside the archive."),
          std::pair("bytes", "Left out: the name of a file in the archive cannot be read."),
          std::pair("pipe", "Left out: \"analysis.lua\" is a link or not a regular file."),
          std::pair("link", "Left out: \"analysis.lua\" is a link or not a regular file.")})
        EXPECT_THAT(GradingBench::error_reason(bench.result(name)), AllOf(HasSubstr(reported), Not(HasSubstr("empty"))))
            << name;
}

// oracle: the submitted files, and that a missing mark is not the mark 0
TEST(unreadable_submissions, have_no_marks_and_are_reported_by_name) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    bench.submit_file("right", kSolution);
    bench.submit_file("silent", "local y = 1\n");
    bench.submit_file("crane", "-- ---\n-- title: Crane\n-- lesson: 03_crane\n-- ---\nanswer('x', 42)\n");
    bench.submit_file("cannot begin", "-- ---\n-- nonsense\n-- ---\n");
    work.write("in/pdf/report.pdf", "%PDF");
    work.write("in/disguised/analysis.lua", "%PDF-1.4 a report");
    work.write("in/bytes/analysis.lua", std::string("\0\1\2", 3));
    work.write("in/encoded/my%20analysis.lua", kSolution);
    work.write("in/two/analysis (1).lua", kSolution);
    work.write("in/two/analysis (2).lua", kSolution);
    work.write("in/capital/Analysis.lua", kSolution);
    work.write("in/copy/my analysis (2).lua", kSolution);
    work.write("in/text/analysis.lua.txt", kSolution);
    work.write("in/seven/work.7z", "7z");
    work.write("in/notebook/analysis.ipynb", "{}");
    work.write("in/group-9.rar", "Rar!");
    work.shell("mkdir in/nothing; mkdir z; printf 'PK\\5\\6%018d' 0 | tr 0 '\\0' > in/hollow.zip");
    work.shell("mkdir in/movie && cp in/right/analysis.lua in/movie/ && truncate -s 300M in/movie/movie.mp4");
    const ChildResult graded = bench.grade();
    EXPECT_EQ(graded.exit_code, 1);
    EXPECT_THAT(graded.output, HasSubstr("17 notes need attention:\n"));
    const std::string book = work.read("out/gradebook.csv");
    for (const auto& [name, reported] :
         {std::pair("crane", "the script of lesson 03_crane, not of 99_small"), std::pair("pdf", "only \"report.pdf\""),
          std::pair("disguised", "The file analysis.lua is a PDF, despite its extension"),
          std::pair("bytes", "The file analysis.lua is not text"),
          std::pair("two", "no analysis.lua, but \"analysis (1).lua\", \"analysis (2).lua\""),
          std::pair("seven", ".7z archives cannot be opened"),
          std::pair("notebook", "the file is JSON, but not a Jupyter notebook"),
          std::pair("group-9.rar", ".rar archives cannot be opened"),
          std::pair("nothing", "The submission is empty: it contains no analysis.lua."),
          std::pair("hollow", "The submission is empty: it contains no analysis.lua."),
          std::pair("movie", "at most 2000 files and 200 MB")}) {
        EXPECT_FALSE(bench.result(name).contains("score")) << name;
        EXPECT_THAT(GradingBench::error_reason(bench.result(name)), HasSubstr(reported)) << name;
        EXPECT_THAT(graded.output, HasSubstr(fmt::format("  \"{}\" cannot be read: ", name)));
        EXPECT_THAT(book, HasSubstr(fmt::format(",{},unreadable,,0,0,", name)));
        EXPECT_THAT(work.read(fmt::format("out/results/{}/feedback.md", name)), HasSubstr("has no marks yet"));
    }
    // Names that browsers and systems change are taken, with a notice.
    for (const auto& [name, file] :
         {std::pair("capital", "Analysis.lua"), std::pair("copy", "my analysis (2).lua"),
          std::pair("text", "analysis.lua.txt"), std::pair("encoded", "my%20analysis.lua")}) {
        EXPECT_EQ(bench.result(name).at("score"), bench.result("right").at("score")) << name;
        EXPECT_THAT(work.read("out/summary.md"), HasSubstr(fmt::format("{}\u201D was used as analysis.lua", file)));
    }
    EXPECT_THAT(graded.output, HasSubstr("  \"silent\" ran to completion but submitted no answer\n"));
    EXPECT_THAT(graded.output, Not(HasSubstr("right")));
    const std::string summary = work.read("out/summary.md");
    EXPECT_THAT(summary, HasSubstr("11 unreadable"));
    EXPECT_THAT(summary, HasSubstr("could not be started"));
    const std::string feedback = work.read("out/results/cannot begin/feedback.md");
    EXPECT_THAT(feedback, HasSubstr("Your script could not be started"));
    EXPECT_THAT(feedback, Not(HasSubstr("submission"))) << "where it lay in the box is nothing to its author";
    EXPECT_THAT(summary, HasSubstr("the mean is 1.43"));  // 2 five times, 0 and 0
    // The instructor may mark them all the same.
    work.write("out/marks.csv", "who,check,points,reason\npdf,x,1,from the PDF\n");
    bench.grade();
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr(",pdf,graded,1,2,"));
}

// oracle: the content of each file
TEST(unreadable_submissions, scripts_are_found_wherever_they_lie_and_the_newest_is_taken) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    work.write("right/analysis.lua", kSolution);
    work.write("wrong/analysis.lua", kWrong);
    work.shell(
        "cd right && zip -qr ../right.zip . && cd ../wrong && zip -qr ../wrong.zip . && cd .. && zip -q nested.zip "
        "right.zip && zip -q twice.zip nested.zip");
    work.write("in/deep/a/b/c/d/analysis.lua", kSolution);
    work.shell("mkdir in/versions in/browser in/times in/unclear in/both in/nested in/twice");
    work.shell("cp wrong.zip in/versions/work.zip; cp right.zip in/versions/work_v2.zip");
    work.shell("cp wrong.zip in/browser/work.zip; cp right.zip 'in/browser/work (1).zip'");
    work.shell("cp nested.zip in/nested/; cp twice.zip in/twice/");
    work.shell("cp -r wrong in/both/old; cp right.zip in/both; cp -r wrong in/times/first; cp -r right in/times/final");
    work.shell("touch -d '2026-03-01 10:00' in/times/first/*; touch -d '2026-03-02 10:00' in/times/final/*");
    work.shell("cp -r wrong in/unclear/one; cp -r right in/unclear/other; touch -d '2026-03-01 10:00' in/unclear/*/*");
    const ChildResult graded = bench.grade();
    for (const char* name : {"deep", "versions", "browser", "nested", "twice", "times"})
        EXPECT_EQ(GradingBench::score(bench.result(name)), 2) << name << bench.result(name).dump(1);
    EXPECT_EQ(GradingBench::score(bench.result("both")), 0);  // archives beside a script are not opened
    EXPECT_THAT(GradingBench::error_reason(bench.result("unclear")),
                AllOf(HasSubstr("Several folders"), HasSubstr("\"one\", \"other\"")));
    EXPECT_THAT(graded.output, AllOf(HasSubstr("\"unclear\" cannot be read"), HasSubstr(", the newest file")));
    EXPECT_THAT(work.read("out/summary.md"), AllOf(HasSubstr("work_v2.zip"), HasSubstr(", the newest file")));
}

// oracle: what the platform put before the names
TEST(unreadable_submissions, loose_files_of_one_sender_are_one_submission) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    const char* computes = "answer('x', sum(load('mine.csv').y))\n";
    work.write("in/lovelaceada_11_901_analysis.lua", computes);
    work.write("in/lovelaceada_11_902_mine.csv", "y\n40\n2\n");
    work.write("in/hoppergrace_LATE_12_903_analysis-1.lua", kSolution);
    work.write("in/Emmy Noether_13_assignsubmission_file_analysis.lua", kSolution);
    work.write("in/Emmy Noether_13_assignsubmission_file_report.pdf", "%PDF");
    work.write("in/Mary Some_14_assignsubmission_file_report.pdf", "%PDF");
    work.write("roster.csv", "id,name\n1,Ada Lovelace\n2,Grace Hopper\n3,Emmy Noether\n4,Mary Some\n");
    const ChildResult graded = bench.grade({"--roster", "roster.csv"});
    EXPECT_EQ(graded.exit_code, 1);
    EXPECT_THAT(graded.output, HasSubstr("4 submissions: 4 graded now"));
    const std::string book = work.read("out/gradebook.csv");
    EXPECT_THAT(book, HasSubstr("1,Ada Lovelace,lovelaceada_11,graded,2,2,"));
    EXPECT_THAT(book, HasSubstr("2,Grace Hopper,hoppergrace_LATE_12_903_analysis-1.lua,graded,2,2,"));
    EXPECT_THAT(book, HasSubstr("3,Emmy Noether,Emmy Noether_13,graded,2,2,"));
    EXPECT_THAT(book, HasSubstr("4,Mary Some,Mary Some_14_assignsubmission_file_report.pdf,unreadable,,"));
}

}  // namespace test_unreadable_submissions
}  // namespace dynlab::test
