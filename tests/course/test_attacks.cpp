#include <gmock/gmock.h>

#include <chrono>
#include <set>
#include <span>

#include "course/attacks.h"
#include "course/grading_bench.h"

namespace dynlab::test {
namespace test_attacks {
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr int kLongEnough = 20;  // s: only attacks without an end need a clock

void write_odd_submissions(const Workbench& work) {
    const std::string right = kAttackSolution;
    work.write("in/it's \"quoted\"/analysis.lua", right);
    work.write("in/=1+1 🎉/analysis.lua", right);
    work.write("in/-rf/analysis.lua", right);
    work.write("in/new\nline/analysis.lua", right);
    work.write("in/in a folder/mine/analysis.lua", right);
    work.write("in/two of them/a/analysis.lua", right);
    work.write("in/two of them/b/analysis.lua", right);
    work.write("in/no script/readme.txt", "hello");
    work.write("in/bytecode/analysis.lua", std::string("\x1bLuaT\0\x19\x93", 8));
    work.write("in/not text/analysis.lua", std::string("answer('x', 42) -- \xff\xfe\n"));
    work.write("in/damaged.zip", "PK\x03\x04 this is no archive");
    work.write("in/empty.zip", "");
    work.write("secret.csv", "y\n42\n");
    work.shell("mkdir 'in/script is a folder' && mkdir 'in/script is a folder/analysis.lua'");
    work.shell(
        "mkdir in/linked && ln -s \"$PWD/secret.csv\" in/linked/secret.csv && "
        "echo \"answer('x', load('secret').y[1])\" > in/linked/analysis.lua");
    work.shell(
        "mkdir in/linked_script && ln -s \"$PWD/home/lessons/99_small/lesson.lua\" in/linked_script/analysis.lua");
    work.shell("mkdir in/a_pipe && echo \"answer('x', 42)\" > in/a_pipe/analysis.lua && mkfifo in/a_pipe/pipe.csv");
    // Archives: upwards, absolute, a link that is written through, a bomb, devices.
    work.shell(
        "mkdir z && cd z && echo \"answer('x', 42)\" > analysis.lua && echo pwned > ../pwned_up && "
        "zip -q ../in/upwards.zip analysis.lua ../pwned_up && rm ../pwned_up");
    work.shell("cd z && tar --absolute-names -czf ../in/absolute.tar.gz analysis.lua /etc/hostname");
    work.shell(
        "cd z && ln -s .. out && tar -cf ../in/through_link.tar analysis.lua out && rm out && mkdir out && echo pwned "
        "> out/pwned_link && "
        "tar -rf ../in/through_link.tar out/pwned_link && rm -r out");
    work.shell(
        "cd z && head -c 400M /dev/zero > data.csv && zip -q ../in/bomb.zip analysis.lua data.csv && rm data.csv");
    work.shell("cd z && tar -cf ../in/devices.tar analysis.lua -C / dev/null");
    work.shell("cd z && for i in $(seq 1 3000); do echo > f$i; done && zip -q ../in/many_files.zip *; rm f*");
    work.shell("cd z && zip -q ../in/good.zip analysis.lua");
    work.shell(
        "mkdir in/'Zoe Zip_5_assignsubmission_file_' && cp in/good.zip in/'Zoe Zip_5_assignsubmission_file_'/work.zip");
}

/// What ends an attack. Where the address sanitizer makes everything several times as slow, it may be time.
::testing::Matcher<std::string> has_reason(const char* words) {
#ifdef __SANITIZE_ADDRESS__
    return ::testing::AnyOf(HasSubstr(words), HasSubstr("of processor time"));
#else
    return HasSubstr(words);
#endif
}

/// The state of what no attack may change.
std::string outside_of(const Workbench& work) {
    return work.shell("find home in secret.csv -exec ls -ld --time-style=full-iso {} + | sort; ls -A | grep -v '^out$'")
        .output;
}

/// Grades the attacks and the other submissions. Nothing outside the sandboxes changes, every run ends in time, and
/// every score is the expected one. Returns the exit code.
int grade_attacks(GradingBench& bench, std::span<const Attack> attacks, std::size_t others, int timeout) {
    const Workbench& work = bench.bench();
    for (const Attack& attack : attacks) bench.submit_file(attack.name, attack.script);
    work.write("secret.csv", "y\n42\n");
    const std::string before = outside_of(work);
    const auto start = std::chrono::steady_clock::now();
    const ChildResult graded = bench.grade({"--timeout", std::to_string(timeout)});
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    EXPECT_LT(taken.count(),
              TimeLimits().clock_multiple * (timeout + 1.0) * static_cast<double>(attacks.size() + others));
    EXPECT_EQ(outside_of(work), before) << graded.error_output;
    EXPECT_EQ(work.shell("find / -xdev -name 'pwned*' -newer secret.csv 2>/dev/null").output, "");
    for (const Attack& attack : attacks) {
        const auto result = bench.result(attack.name);
        EXPECT_EQ(GradingBench::score(result), attack.score) << attack.name << ": " << result.dump(1);
        const std::string reported =
            GradingBench::error_reason(result) + " " + result.at("tests").at(0).at("output").get<std::string>();
        EXPECT_THAT(reported, has_reason(attack.reported)) << attack.name;
    }
    return graded.exit_code;
}

// oracle: the earlier state outside the sandboxes, the clock, the expected scores
TEST(attacks, without_an_end_are_ended) {
    GradingBench bench(kAttackAnswers, kAttackChecks, kAttackSolution);
    EXPECT_EQ(grade_attacks(bench, kEndlessAttacks, 0, 1), 0);
}

// oracle: the earlier state outside the sandboxes, the clock, the expected scores
TEST(attacks, none_leaves_its_sandbox_stops_the_batch_or_changes_a_mark) {
    GradingBench bench(kAttackAnswers, kAttackChecks, kAttackSolution);
    bench.submit_file("honest", kAttackSolution);
    write_odd_submissions(bench.bench());
    ASSERT_EQ(grade_attacks(bench, kAttacks, 24, kLongEnough), 1);  // some cannot be read
    for (const char* name :
         {"honest", "it's \"quoted\"", "=1+1 🎉", "-rf", "new\nline", "in a folder", "a_pipe", "upwards", "absolute",
          "through_link", "devices", "good", "Zoe Zip_5_assignsubmission_file_"})
        EXPECT_EQ(GradingBench::score(bench.result(name)), 1) << name << bench.result(name).dump(1);
    for (const auto& [name, reported] :
         {std::pair("two of them", "Several folders"), std::pair("no script", "contains no analysis.lua"),
          std::pair("bytecode", "not text"), std::pair("damaged", "cannot be unpacked"),
          std::pair("empty", "cannot be unpacked"), std::pair("script is a folder", "contains no analysis.lua"),
          std::pair("linked", "secret"), std::pair("linked_script", "analysis.lua is missing"),
          std::pair("bomb", "exceeds 200 MB when unpacked"), std::pair("many_files", "contains more than")}) {
        EXPECT_EQ(GradingBench::score(bench.result(name)), name == std::string("linked") ? 0 : -1)
            << name << bench.result(name).dump(1);
        EXPECT_THAT(GradingBench::error_reason(bench.result(name)), HasSubstr(reported)) << name;
    }
}

// oracle: the kernel refuses paths of more than 4096 letters; the others' marks
TEST(attacks, a_folder_that_cannot_even_be_read_stops_no_other) {
    GradingBench bench(kAttackAnswers, kAttackChecks, kAttackSolution);
    bench.submit_file("bottomless", kAttackSolution);
    bench.submit_file("honest", kAttackSolution);
    const Workbench& work = bench.bench();
    work.shell(
        "cd in/bottomless; n=$(printf 'd%.0s' $(seq 250)); for i in $(seq 24); do mkdir $n && cd $n; done; echo x > y");
    const ChildResult graded = bench.grade();
    EXPECT_EQ(graded.exit_code, 1);
    EXPECT_THAT(graded.error_output, HasSubstr("\"bottomless\" could not be graded"));
    EXPECT_EQ(GradingBench::score(bench.result("honest")), 1);
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr(",bottomless,partly ungraded,,"));
    work.shell("cd in && mv bottomless/d* . && rm -rf d*");
}

// oracle: a file whose words must appear nowhere
TEST(attacks, reports_read_no_files_and_run_no_commands) {
    GradingBench bench(kAttackAnswers,
                       "check{id = 'report', document = true, test = function() return no_finding() end}\n",
                       "answer('x', 42)\nreport.value('x', 42)\n");
    const Workbench& work = bench.bench();
    work.write("home/lessons/99_small/report.en.md", "---\ntitle: Mine\n---\n\nIt is `x`{.value}.\n");
    work.write("canary.tex", "thecanarysings");
    const std::string canary = work.path("canary.tex").string();
    const std::pair<const char*, std::string> reports[] = {
        {"sound", "It is `x`{.value}.\n"},
        {"input", "\\input{" + canary + "}\n"},
        {"input_in_mathematics", "$$ \\input{" + canary + "} $$\n"},
        {"raw_attribute", "`\\input{" + canary + "}`{=latex}\n"},
        {"raw_block", "```{=latex}\n\\input{" + canary + "}\n```\n"},
        {"write18", "\\immediate\\write18{touch " + work.path("pwned").string() + "}\n"},
        {"write18_in_mathematics", "$$ \\immediate\\write18{touch " + work.path("pwned").string() + "} $$\n"},
        {"picture", "![A](" + canary + ")\n"},
        {"endless_macro", "$$ \\def\\x{\\x}\\x $$\n"},
    };
    for (const auto& [name, text] : reports) {
        bench.submit_file(name, "answer('x', 42)\nreport.value('x', 42)\n");
        work.write("in/" + std::string(name) + "/report.md", "---\ntitle: Mine\n---\n\n" + text);
    }
    bench.submit_file("includes", "answer('x', 42)\n");
    work.write("in/includes/report.md", "---\ntitle: Mine\nheader-includes: \\input{" + canary + "}\n---\n\nText.\n");
    const ChildResult graded = bench.grade();
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_EQ(GradingBench::score(bench.result("sound")), 1) << bench.result("sound").dump(1);
    EXPECT_EQ(work.shell("grep -rl thecanarysings out; ls pwned").output, "");
    for (const char* name : {"input_in_mathematics", "write18_in_mathematics", "picture", "endless_macro", "includes"})
        EXPECT_EQ(GradingBench::score(bench.result(name)), 0) << name;
}

// Oracle: the bytes that a terminal obeys, of which none may come out.
TEST(attacks, names_and_messages_of_students_reach_no_terminal_as_commands) {
    GradingBench bench(kAttackAnswers, kAttackChecks, kAttackSolution);
    Workbench& work = bench.bench();
    const std::string red = "\x1B[31m", name = "pi" + red + "pe", turned = "\u202Egpj.exe";
    const auto reported = [&work, &red](const std::vector<std::string>& words, const std::string& shown) {
        const ChildResult result = work.dynlab(words);
        const std::string all = result.output + result.error_output;
        EXPECT_THAT(all, HasSubstr(shown)) << words.front();
        EXPECT_THAT(all, ::testing::Not(AnyOf(HasSubstr(red), HasSubstr("\u202E")))) << words.front();
    };
    work.write("mine/analysis.lua", "error('bad" + red + "')\n");
    work.write("mine/report.md", "---\ntitle: Mine\n---\n\nText.\n");
    work.write("mine/" + turned, "x");
    work.shell("mkfifo 'mine/" + name + "'");
    reported({"pack", "mine"}, "pi?[31mpe");
    reported({"pack", "mine"}, "?gpj.exe");
    reported({"report", "mine"}, "bad?[31m");
    reported({"run", "mine/analysis.lua"}, "bad?[31m");
    work.write("in/one" + red + "/report.md", "no analysis");
    work.write("out/results/one" + red + "/results.json", "no result of ours");
    reported({"grade", "in", "--lesson", "99", "--out", "out", "--isolation", GradingBench::level(), "--no-pdf",
              "--only", "two" + red},
             "two?[31m");
}

}  // namespace test_attacks
}  // namespace dynlab::test
