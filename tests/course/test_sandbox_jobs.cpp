// Jobs for sandboxes and their results. Oracles: the input; the contract for bytes from a sandbox, which a submission
// may have written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "course/checks/check_descriptions.h"
#include "course/review/version_description.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "documents/text_lines.h"
#include "platform/program_lookup.h"
#include "support/program.h"

namespace dynlab {
namespace test_sandbox_jobs {

using ::testing::ElementsAre;

GradedRun sample_run() {
    GradedRun run;
    run.answers["gain"] = {"number", R"({"kind":"number","value":2.0})"};
    run.figures = {"raw", "fit"};
    run.values = {"fit"};
    run.printed = "93.2\n";
    run.error = Message("{}:{}: no", "analysis.lua", 3);
    run.seconds = 0.25;
    return run;
}

ChecksJob sample_checks() {
    ChecksJob job;
    job.files = {{"checks.lua", "check{id = 'a'}", true}, {"more.lua", "", false}};
    job.hidden_folder = "/box/hidden";
    job.time_ms = 10000;
    job.most_ms = 60000;
    job.only = 1;
    const CheckedSubmission work{{{"main", sample_run()}},
                                 {{"pages", Severity::kHint, 7, "", Message("Too many pages."), Message("Cut.")}},
                                 "answer('G', 1)",
                                 AnswerChange{"G", 1.5}};
    job.submissions = {{work, "/box/home-1", {{"hidden", {{"crane", 4'000'000'001u}}}}}, {}};
    job.data_sets = {{"rc", 5, 6}};
    return job;
}

// Writing what was read gives the same bytes, so that no member is lost or changed.
template <class T>
void expect_to_come_back(const T& value) {
    const std::string bytes = cbor_of(value);
    EXPECT_TRUE(cbor_of(from_cbor<T>(bytes, sandbox_limits())) == bytes);
}

TEST(sandbox_jobs, come_back) {
    expect_to_come_back(sample_run());
    expect_to_come_back(sample_checks());
    expect_to_come_back(ChecksJob());
    expect_to_come_back(RunJob{"/box/submission/analysis.lua", 7, {{"gain", "number"}}, 60000, 1ull << 30});
    expect_to_come_back(UnpackJob{"/box/archive", "/box/to", 200ull << 20, 2000, true});
    expect_to_come_back(
        Unpacked{{Message("\"{}\" points outside the archive", "../x")}, Message("the archive is damaged")});
    expect_to_come_back(VersionJob{"/box/submission", "/box/made", true});
    const CheckDescription check{"a", "about", "hint", 2, "seed", true, true, "rubric", false};
    const EvaluatedCheck tried{check, 0.5, Message("no"), Message("why")};
    expect_to_come_back(CheckResults{{tried},
                                     {{{tried}, {}, 0.5}, {{}, Message("the run crashed (signal {})", 11), 60}},
                                     {"rc"},
                                     {{{"u", {1, 2}}}},
                                     Message("error")});
    const ChecksJob back = from_cbor<ChecksJob>(cbor_of(sample_checks()));
    EXPECT_EQ(back.hidden_folder, "/box/hidden");
    EXPECT_EQ(back.time_ms, 10000);
    EXPECT_EQ(back.most_ms, 60000);
    EXPECT_EQ(back.only, 1);
    EXPECT_EQ(back.files.at(0).source, "check{id = 'a'}");
    EXPECT_TRUE(back.files.at(0).visible);
    EXPECT_EQ(back.submissions.at(0).variants.at("hidden").at("crane"), 4'000'000'001u);
    EXPECT_EQ(back.submissions.at(0).work.findings.at(0).severity, Severity::kHint);
    EXPECT_EQ(back.submissions.at(0).work.runs.at("main").error, Message("{}:{}: no", "analysis.lua", 3));
    EXPECT_THAT(back.submissions.at(0).work.runs.at("main").figures, ElementsAre("raw", "fit"));
}

// oracle: written by hand
TEST(sandbox_jobs, message_from_a_sandbox_names_files_of_the_work_and_keeps_its_id) {
    const Message said("{}: file not found: {}", "/box/submission/analysis.lua:3", "/box/submission/data/x.csv");
    EXPECT_EQ(without_sandbox_paths(said, "/box/submission"),
              Message("{}: file not found: {}", "analysis.lua:3", "data/x.csv"));
    EXPECT_EQ(shortened_error(said), said);
    const auto as_capitals = [](const std::string& text) { return text == "b" ? "B" : replaced(text, "a b", "A B"); };
    EXPECT_EQ(with_changed_text(Message("a {}", "b"), as_capitals), Message::verbatim("A B"))
        << "its format changes too";
}

TEST(sandbox_jobs, texts_from_a_sandbox_are_utf8) {
    GradedRun run = sample_run();
    run.printed = "a\xFF";
    run.error = Message::verbatim("\xC3");
    const GradedRun back = from_cbor<GradedRun>(cbor_of(run), sandbox_limits());
    EXPECT_EQ(back.printed, "a\xEF\xBF\xBD");
    EXPECT_EQ(back.error, Message::verbatim("\xEF\xBF\xBD"));
}

TEST(sandbox_jobs, any_bytes_from_a_sandbox_are_a_result_or_refused) {
    std::mt19937 random(5);
    const std::string bytes = cbor_of(sample_run());
    int refused = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::string wrong = bytes;
        for (unsigned k = 0; k <= random() % 4; ++k) wrong[random() % wrong.size()] = static_cast<char>(random());
        try {
            from_cbor<GradedRun>(wrong, sandbox_limits(1u << 20));
        } catch (const ValueError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 5000);
    EXPECT_LT(refused, 20000);
    EXPECT_THROW(from_cbor<GradedRun>("{\"answers\": {}}", sandbox_limits()), ValueError);
    EXPECT_THROW(from_cbor<GradedRun>("", sandbox_limits()), ValueError);
}

// oracle: the libraries that a run needs
TEST(sandbox_jobs, work_in_sandboxes_has_a_program_that_starts_quickly) {
    const std::filesystem::path dynlab = DYNLAB_PROGRAM, small = dynlab.parent_path() / kSandboxProgram;
    for (const char* work : {"run", "checks", "unpack", "document"}) EXPECT_EQ(program_for(work, dynlab), small);
    EXPECT_EQ(program_for("version", dynlab), dynlab.parent_path() / kCourseProgram);
    const test::Workbench work;
    const std::string libraries = work.shell("ldd " + small.string()).output;
    EXPECT_THAT(libraries, ::testing::HasSubstr("liblua"));
    for (const char* of_documents : {"poppler", "qpdf", "sqlite"})
        EXPECT_THAT(libraries, ::testing::Not(::testing::HasSubstr(of_documents)));
}

}  // namespace test_sandbox_jobs
}  // namespace dynlab
