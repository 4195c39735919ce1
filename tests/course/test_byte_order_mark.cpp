#include <gmock/gmock.h>

#include "course/grading_bench.h"
#include "documents/text_lines.h"

namespace dynlab::test {
namespace test_byte_order_mark {
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kByteOrderMark = "\xEF\xBB\xBF";  // what Notepad and PowerShell put before UTF-8

// oracle: the same texts without the mark, whose points follow from the checks
TEST(byte_order_mark, costs_no_points) {
    const std::string solution = "answer('x', 42)\n";
    const std::string checks = "check{id = 'x', test = function(a) return a.x == 42 end}\n";
    GradingBench bench("--   x: number\n", kByteOrderMark + checks, solution);
    const Workbench& work = bench.bench();
    work.write("home/lessons/99_small/lesson.lua",
               kByteOrderMark + GradingBench::header("--   x: number\n") + solution);
    work.write("more/extra.lua", kByteOrderMark + "check{id = 'half', test = function(a) return a.x == 42 end}\n");
    work.write("roster.csv", kByteOrderMark + "id,group\n1,marked\n");
    bench.submit_file("marked", kByteOrderMark + solution);
    bench.submit_file("stops", kByteOrderMark + "error('no more')\n");
    bench.submit_file("slip", kByteOrderMark + "local = 3\n");
    const ChildResult graded = bench.grade({"--checks", "more", "--roster", "roster.csv"});
    ASSERT_EQ(graded.exit_code, 1) << graded.error_output;  // two match no student in the roster
    EXPECT_EQ(GradingBench::score(bench.result("marked")), 2);
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr("marked,graded,2,2"));
    EXPECT_THAT(GradingBench::error_reason(bench.result("stops")), HasSubstr("analysis.lua:1: no more"));
    EXPECT_THAT(GradingBench::error_reason(bench.result("slip")), StartsWith("analysis.lua:1: "));
    EXPECT_EQ(GradingBench::error_reason(bench.result("slip")).find("239"), std::string::npos);
}

// oracle: iconv, and the points of the same script in UTF-8
TEST(byte_order_mark, of_utf_16_costs_no_points_either) {
    const std::string solution = "-- Température\nanswer('x', 42)\n";
    GradingBench bench("--   x: number\n", "check{id = 'x', test = function(a) return a.x == 42 end}\n", solution);
    const Workbench& work = bench.bench();
    work.write("script.lua", solution);
    for (const char* order : {"LE", "BE"}) {  // PowerShell's > writes the first
        const std::string folder = std::string("in/") + order;
        const std::string made = "mkdir -p " + folder +
                                 " && printf '\\357\\273\\277' | cat - script.lua | iconv -f UTF-8 -t UTF-16" + order +
                                 " > " + folder + "/analysis.lua";
        ASSERT_EQ(work.shell(made).exit_code, 0);
    }
    work.write("in/half/analysis.lua", std::string("\xFF\xFE\x00\x00\x01\x00", 6));
    bench.grade();
    for (const char* order : {"LE", "BE"}) EXPECT_EQ(GradingBench::score(bench.result(order)), 1) << order;
    EXPECT_FALSE(bench.result("half").contains("score"));
    EXPECT_THAT(GradingBench::error_reason(bench.result("half")), HasSubstr("analysis.lua is not text"));
}

/// A student's folder, each of its texts with `start` before it.
void write_student_folder(const Workbench& bench, const std::string& folder, const std::string& start) {
    bench.write(folder + "/analysis.lua", start +
                                              "-- ---\n-- title: The sum\n-- answers:\n--   s: number\n-- ---\n"
                                              "local s = sum(load('values.csv').y)\nanswer('s', s)\nprint(s)\n"
                                              "report.value('sum', s, '%.0f')\n");
    bench.write(folder + "/report.md",
                start +
                    "---\ntitle: A sum\npages: 1\n---\n\nThe sum of the values is `sum`{.value}, "
                    "and it is the one that was to be found.\n");
    bench.write(folder + "/group.toml", start + "members = [\"Zoe Unlikely\"]\nseed = 3\n");
    bench.write(folder + "/values.csv", start + "y\n1\n2\n");
}

// oracle: what the same folder without marks gives, byte for byte
TEST(byte_order_mark, changes_nothing_of_a_student_s_folder) {
    const Workbench bench;
    write_student_folder(bench, "a/work", "");
    write_student_folder(bench, "b/work", kByteOrderMark);
    for (const std::string command :
         {"run work/analysis.lua", "check work", "report work -o report.pdf", "weave work/analysis.lua -o woven.pdf"}) {
        SCOPED_TRACE(command);
        const ChildResult plain = bench.shell("cd a && $DYNLAB " + command),
                          marked = bench.shell("cd b && $DYNLAB " + command);
        EXPECT_EQ(plain.exit_code, 0) << plain.error_output;
        EXPECT_EQ(marked.exit_code, 0) << marked.error_output;
        EXPECT_EQ(replaced(marked.output, "work/b/", "work/a/"), plain.output);
    }
    for (const std::string pdf : {"report.pdf", "woven.pdf"}) EXPECT_EQ(bench.read("b/" + pdf), bench.read("a/" + pdf));
}

TEST(byte_order_mark, is_passed_over_in_statements_from_a_pipe) {
    const Workbench bench;
    bench.write("statements.lua", kByteOrderMark + "print(1 + 1)\nerror('no more')\n");
    const ChildResult result = bench.shell("$DYNLAB < statements.lua");
    EXPECT_EQ(result.output, "2\n");
    EXPECT_THAT(result.error_output, HasSubstr(":2: no more"));
}

}  // namespace test_byte_order_mark
}  // namespace dynlab::test
