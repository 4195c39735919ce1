// The guides for instructors run as they are printed: their commands are read out of the help pages themselves and run
// in a folder with made-up submissions. Oracle: what the guides print below them, and exit codes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "course/course_bench.h"
#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_instructor_guides {
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin), to = text.find(end, from + begin.size());
    EXPECT_NE(from, std::string::npos) << begin;
    return text.substr(from, to - from);
}

std::string guide(const std::string& name) {
    return read_file(DYNLAB_SOURCE_DIR "/engine/scripting/reference/guides/guide-" + name + ".md");
}

/// The contents of the fenced code blocks, in order.
std::vector<std::string> blocks_in(const std::string& text) {
    static const std::regex fenced("\n```(?:sh)?\n([^`]*)\n```\n");
    std::vector<std::string> blocks;
    for (std::sregex_iterator it(text.begin(), text.end(), fenced), end; it != end; ++it) blocks.push_back((*it)[1]);
    return blocks;
}

std::vector<std::string> lines_in(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::vector<std::string> words_in(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

/// The commands in `...` of the running text that are whole, with a reason where the guide has three dots.
std::vector<std::string> commands_in_text(const std::string& text) {
    static const std::regex span("`(dynlab [^`]+)`"), fences("\n```(?:sh)?\n[^`]*\n```\n");
    const std::string prose = std::regex_replace(text, fences, "\n");
    std::vector<std::string> commands;
    for (std::sregex_iterator it(prose.begin(), prose.end(), span), end; it != end; ++it)
        commands.push_back(std::regex_replace((*it)[1].str(), std::regex(R"(\.\.\.$)"), "'as was said'"));
    return commands;
}

/// The program is called dynlab, as where it is installed.
ChildResult in_shell(const Workbench& work, const std::string& folder, const std::string& command) {
    return work.shell("PATH=$(dirname $DYNLAB):$PATH; cd " + (folder.empty() ? "." : folder) + " && " + command);
}

struct PrintedCommand {
    std::string command, output;
};

std::vector<PrintedCommand> printed_in(const std::string& block) {
    std::vector<PrintedCommand> commands;
    for (const std::string& line : lines_in(block))
        if (line.starts_with("$ "))
            commands.push_back({line.substr(2), ""});
        else
            commands.back().output += line + "\n";
    return commands;
}

TEST(instructor_guide_marks, of_a_class_are_made_as_it_is_printed) {
    if (obstacle_to(Isolation::kFull))
        GTEST_SKIP() << "the guide shows marks made in boxes, which are not to be had here";
    const std::string whole = guide("instructor"), part = whole.substr(whole.find("## Grade without a course"));
    const std::vector<PrintedCommand> commands = printed_in(blocks_in(part).at(0));
    const Workbench work;
    const std::string solution = quick_solution_of("04_estimators");
    work.write("one/analysis.lua", solution);
    ASSERT_EQ(work.shell("mkdir handed-in && $DYNLAB pack one -o handed-in/group-01.zip").exit_code, 0);
    work.write("handed-in/group-02/analysis.lua", read_file(lesson_folder("04_estimators") / "wrong_biased_final.lua"));
    // In the guide it is an endless loop, which ends the same way, a minute later.
    work.write("handed-in/group-03/analysis.lua",
               solution.substr(0, solution.find("\n-- %%")) + "\nerror('stopped')\n");
    work.write("secret.txt", "of a test");
    const auto roster = std::find_if(commands.begin(), commands.end(),
                                     [](const PrintedCommand& command) { return command.command == "cat roster.csv"; });
    ASSERT_NE(roster, commands.end());
    work.write("roster.csv", roster->output);
    int graded = 0;
    for (const PrintedCommand& printed : commands) {
        const ChildResult result = in_shell(work, "", printed.command);
        EXPECT_EQ(result.exit_code, 0) << printed.command << '\n' << result.error_output;
        EXPECT_EQ(words_in(result.output), words_in(printed.output)) << printed.command;
        graded += printed.command.starts_with("dynlab grade ");
    }
    EXPECT_EQ(graded, 1);
    // The feedback that is quoted below.
    const std::string feedback = work.read("marks/results/group-02/feedback.md");
    int quoted = 0;
    for (const std::string& line : lines_in(part))
        if (line.starts_with("> ")) {
            EXPECT_THAT(feedback, HasSubstr(line.substr(2)));
            ++quoted;
        }
    EXPECT_EQ(quoted, 3);
    EXPECT_TRUE(std::filesystem::exists(work.path("marks/results/group-02/feedback.pdf")));
    // A check of the instructor's own, for the command that tries some.
    work.write("my-checks/more.lua",
               "check{id = 'own_there', points = 1, about = 'There is a result', hint = 'Look at it again.',\n"
               "  test = function(a) return a.own ~= nil end}\n");
    for (const std::string& command : commands_in_text(part)) {
        if (command == "dynlab pack") continue;  // the command's name alone
        const ChildResult result = in_shell(work, "", command);
        EXPECT_EQ(result.exit_code, 0) << command << '\n' << result.error_output << result.output;
    }
}

// oracle: the program itself knows every command of the first page, and there are 20
TEST(instructor_guides, a_term_in_20_commands_has_commands_that_there_are) {
    const Workbench work;
    const std::vector<std::string> commands = lines_in(blocks_in(guide("instructor")).at(0));
    EXPECT_EQ(commands.size(), 20u);
    for (const std::string& line : commands) {
        const std::string command = line.substr(0, std::min(line.find("  #"), line.find(" &&")));
        const ChildResult help = in_shell(work, "", command + " --help");
        EXPECT_EQ(help.exit_code, 0) << command << help.error_output;
        EXPECT_EQ(help.error_output, "") << command << " is an old name";
    }
}

/// Seven groups with a student each, whose files a platform exports.
class MadeUpCourse {
  public:
    static constexpr int kGroups = 7;

    explicit MadeUpCourse(const Workbench& work) : work_(work) {}

    /// What the instructor has beside the course when this line is typed.
    void prepare(const std::string& line) const {
        if (line.find("course import") != std::string::npos) {
            std::string roster = "id,name,group,email,moodle\n", worksheet = "full name,time\n";
            for (int i = 1; i <= kGroups; ++i) {
                roster += fmt::format("s{0},Student {0},{1},s{0}@course.example,90000{0}\n", i, CourseBench::group(i));
                worksheet += fmt::format("Student {},2026-02-28 12:0{}\n", i, i);
            }
            work_.write("signals/roster.csv", roster);
            work_.write("signals/worksheet.csv", worksheet);
            write_export("Crane-export.zip", "report.pdf", "first");
        } else if (line.find("reviews.zip") != std::string::npos) {
            write_reviews();
        } else if (line.find("final.zip") != std::string::npos) {
            write_export("final.zip", "report.pdf", "final");
        }
    }

  private:
    static std::string folder_of(int i) { return fmt::format("Student {0}_90000{0}_assignsubmission_file_/", i); }

    void zip(const std::string& name) const {
        EXPECT_EQ(work_.shell("cd export && zip -qr ../signals/" + name + " . && cd .. && rm -r export").exit_code, 0);
    }

    void write_export(const std::string& name, const std::string& file, const std::string& text) const {
        for (int i = 1; i <= kGroups; ++i)
            work_.write("export/" + folder_of(i) + file, small_pdf(fmt::format("{} {}", text, i * 13)));
        zip(name);
    }

    void write_reviews() const {
        std::string scores = "reviewer,report,data,steps,conclusions,strength,suggestions\n";
        static const std::regex pair("group-0(\\d) +(report-\\d+) +group-0\\d +.* sent");
        const std::string pairs = in_shell(work_, "signals", "dynlab course review pairs crane").output;
        for (std::sregex_iterator it(pairs.begin(), pairs.end(), pair), end; it != end; ++it) {
            const std::string reviewer = (*it)[1], report = (*it)[2];
            work_.write("export/" + folder_of(std::stoi(reviewer)) + "review-" + report + ".pdf",
                        small_pdf("seen of " + report));
            scores += fmt::format("group-0{},{},3,4,4,5,2\n", reviewer, report);
        }
        work_.write("signals/scores.csv", scores);
        zip("reviews.zip");
    }

    const Workbench& work_;
};

TEST(instructor_guides, a_course_with_reviews_and_its_corrections_run_as_printed) {
    const std::string course = guide("peer-review");
    const std::vector<std::string> blocks = blocks_in(course);
    ASSERT_EQ(blocks.size(), 2u);
    const Workbench work;
    const MadeUpCourse made_up(work);
    const bool sandboxed = !obstacle_to(Isolation::kFull);
    const auto run = [&](std::string command) {
        if (!sandboxed && std::regex_search(command, std::regex(" (submit|collect) ")))
            command += " --isolation process";
        const ChildResult result =
            in_shell(work, std::filesystem::exists(work.path("signals")) ? "signals" : "", command);
        const bool findings = command.find(" issues ") != std::string::npos;  // they are there: rules are broken
        EXPECT_EQ(result.exit_code, findings ? 1 : 0) << command << '\n' << result.error_output << result.output;
        return result;
    };
    std::string status;
    for (const std::string& line : lines_in(blocks[0])) {
        const std::string command = line.substr(0, line.find("  #"));
        made_up.prepare(command);
        const ChildResult result = run(command);
        if (command.starts_with("dynlab course status")) status = result.output;
        if (std::regex_search(command, std::regex(" (submit|collect) "))) {
            EXPECT_THAT(result.output, HasSubstr("group-07"));
        }
    }
    // The table and the next step have the form that the guide shows.
    const std::vector<std::string> shown = lines_in(blocks[1]), had = lines_in(status);
    std::vector<std::vector<std::string>> lines;
    for (const std::string& line : had) lines.push_back(words_in(line));
    EXPECT_THAT(lines, Contains(words_in(shown.front()))) << status;
    EXPECT_THAT(had, Contains(shown.back()));
    EXPECT_THAT(in_shell(work, "signals", "cat marks.csv").output, HasSubstr("group-07"));
    EXPECT_THAT(in_shell(work, "signals", "ls monday changes").output,
                AllOf(HasSubstr("mail.csv"), HasSubstr("moodle.zip"), HasSubstr("group-01")));

    int corrections = 0;
    for (std::string command : commands_in_text(course)) {
        for (const auto& [placeholder, word] :
             std::map<std::string, std::string>{{" [FILE]", ""},
                                                {"RECEIPT", "receipts/crane/00001-*.txt"},
                                                {"GROUP", "group-05"},
                                                {"DIR", "review-form"}})
            if (const auto at = command.find(placeholder); at != std::string::npos)
                command.replace(at, placeholder.size(), word);
        if (command.find(" carne --remove") != std::string::npos)
            run("dynlab course assignment carne --first '2026-02-28 13:00' --review '2026-03-04 13:00' --final "
                "'2026-03-07 14:00'");
        run(command);
        corrections += command.find("--reason") != std::string::npos;
    }
    EXPECT_GE(corrections, 7);
}

}  // namespace test_instructor_guides
}  // namespace dynlab::test
