// A lesson run part by part, as a live document runs it. Oracle: the same lesson run as one chunk.
#include "scripting/runtime/script_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "figures/gnuplot_renderer.h"
#include "platform/temporary_folder.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/runtime/services.h"
#include "support/environment_variable.h"
#include "support/program.h"
#include "workflow/lesson_catalog.h"

namespace test_script_parts {
using namespace dynlab;
using testing::ElementsAre;

struct LessonRun {
    GnuplotRenderer renderer;
    TemporaryFolder out;
    ReportLanguage language;
    Runtime runtime;
    explicit LessonRun(const PercentScript& script, CallCache* calls = nullptr)
        : runtime(options(script, calls), renderer) {
        runtime.services().language = &language;
    }
    RunOptions options(const PercentScript& script, CallCache* calls) const {
        RunOptions chosen;
        chosen.script_folder = script.file.parent_path();
        chosen.out_folder = out.path();
        chosen.seed = script.header.seed;
        chosen.call_cache = calls;
        return chosen;
    }
};

RunRecord in_parts(const PercentScript& script, CallCache* calls = nullptr) {
    LessonRun run(script, calls);
    run.runtime.begin_parts(script);
    RunRecord record;
    for (const ScriptPart& part : script_parts(script)) {
        record = run.runtime.run_part(script, part);
        if (record.error) break;
    }
    return record;
}

PercentScript script_of(const std::string& source) {
    return parse_percent_script(source, "analysis.lua");
}

class lessons_in_parts : public testing::TestWithParam<const char*> {};

// With the cache of long calls, as a live document has it.
TEST_P(lessons_in_parts, give_the_same_record) {
    const test::EnvironmentVariable cache_home("XDG_CACHE_HOME",
                                               test::Workbench(test::Workbench::Memory::kShared).cache());
    const Cache cache;
    CallCache calls(cache);
    const PercentScript script = read_percent_script(find_lesson(GetParam()).script());
    LessonRun whole(script, &calls);
    const RunRecord expected = whole.runtime.run(script);
    ASSERT_FALSE(expected.error);
    EXPECT_EQ(to_json(in_parts(script, &calls)), to_json(expected));
}

INSTANTIATE_TEST_SUITE_P(all, lessons_in_parts, testing::Values("01", "02", "04"),
                         [](const auto& lesson) { return std::string(lesson.param); });

TEST(script_parts, are_cells_or_what_goes_over_their_ends) {
    const auto parts = script_parts(script_of(
        "-- %% id=a\nlocal x = 1\n-- %% id=b\nfor i = 1, 2 do\n-- %% id=c\nx = x + i\nend\n-- %% id=d\nprint(x)\n"));
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_THAT(parts[0].cells, ElementsAre("a"));
    EXPECT_THAT(parts[1].cells, ElementsAre("b", "c"));
    EXPECT_THAT(parts[2].cells, ElementsAre("d"));
    EXPECT_EQ(parts[1].first_line, 4);
}

TEST(script_parts, share_locals_and_functions) {
    const PercentScript script = script_of(
        "-- %% id=a\nlocal x <const>, y = 1, 2\nlocal function f() y = y + 1 return x + y end\n-- %% id=b\nf()\nlocal "
        "z = f()\n"
        "-- %% id=c\nz\nprint(y)\n");
    const RunRecord record = in_parts(script);
    ASSERT_FALSE(record.error) << record.error->text();
    LessonRun whole(script);
    EXPECT_EQ(to_json(record), to_json(whole.runtime.run(script)));
    EXPECT_THAT(record.outputs.at("c").front().printed, testing::HasSubstr("5"));
}

TEST(script_parts, errors_name_the_line_of_the_script) {
    const RunRecord record = in_parts(script_of("-- %% id=a\nlocal x = 1\n\n-- %% id=b\nprint(x)\nerror(\"no\")\n"));
    ASSERT_TRUE(record.error);
    EXPECT_EQ(record.error->line, 6);
    EXPECT_EQ(record.error->text(), "analysis.lua:6: no");
    EXPECT_EQ(record.outputs.at("b").front().printed, "1\n");
    const RunRecord wrong = in_parts(script_of("-- %% id=a\nprint(1)\n-- %% id=b\nlocal = 3\n"));
    ASSERT_TRUE(wrong.error);
    EXPECT_EQ(wrong.error->line, 4);
}

/// What was run stays when the text below it is another.
TEST(script_parts, go_on_with_a_later_text) {
    const PercentScript first = script_of("-- %% id=a\nlocal x = 1\nprint(x)\n-- %% id=b\nprint(x + 1)\n");
    const PercentScript later =
        script_of("-- %% [markdown]\n-- Text.\n\n-- %% id=a\nlocal x = 1\nprint(x)\n-- %% id=b\nprint(x + 41)\n");
    LessonRun run(first);
    run.runtime.begin_parts(first);
    run.runtime.run_part(first, script_parts(first)[0]);
    const RunRecord record = run.runtime.run_part(later, script_parts(later)[1]);
    EXPECT_EQ(record.outputs.at("a").front().printed, "1\n");
    EXPECT_EQ(record.outputs.at("b").front().printed, "42\n");
}

}  // namespace test_script_parts
