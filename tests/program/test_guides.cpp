// Guides whose commands are run as written. Oracle: exit codes, and for messages the output that the guide prints
// below.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "platform/atomic_file.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_guides {
using testing::HasSubstr;

/// The contents of the guide's fenced code blocks, in order.
std::vector<std::string> blocks_of(const std::string& guide) {
    const std::string text = read_file(DYNLAB_SOURCE_DIR "/engine/scripting/reference/guides/guide-" + guide + ".md");
    static const std::regex fenced("\n```(?:sh)?\n([^`]*)\n```\n");
    std::vector<std::string> blocks;
    for (std::sregex_iterator it(text.begin(), text.end(), fenced), end; it != end; ++it) blocks.push_back((*it)[1]);
    return blocks;
}

/// The program is called dynlab, as where it is installed.
ChildResult typed(const Workbench& bench, const std::string& command) {
    return bench.shell("PATH=$(dirname $DYNLAB):$PATH; " + command);
}

TEST(guides, the_first_hour_runs_as_printed) {
    const Workbench bench(Workbench::Memory::kShared);
    int commands = 0;
    for (const std::string& block : blocks_of("first-hour")) {
        std::istringstream lines(block);
        for (std::string line; std::getline(lines, line); ++commands) {
            const ChildResult result = typed(bench, line);
            EXPECT_EQ(result.exit_code, 0) << line << '\n' << result.error_output;
            EXPECT_FALSE(result.output.empty()) << line;
        }
    }
    EXPECT_EQ(commands, 13);
    EXPECT_TRUE(std::filesystem::exists(bench.path("my-work/report.pdf")));
}

TEST(guides, messages_are_those_that_are_explained) {
    const Workbench bench;
    bench.write("bad.csv", "t,u,y\n0,0,0\n0.1,1,x\n");
    bench.write("analysis.lua", "print(1)\n");
    bench.write("my-work/kept", "");
    int messages = 0;
    for (const std::string& block : blocks_of("trouble")) {
        ASSERT_TRUE(block.starts_with("$ ")) << block;
        const std::size_t end = block.find('\n');
        const ChildResult result = typed(bench, block.substr(2, end - 2));
        EXPECT_EQ(result.exit_code, 1) << block;
        EXPECT_THAT(result.error_output, testing::StartsWith(block.substr(end + 1) + "\n"));
        ++messages;
    }
    EXPECT_EQ(messages, 7);
}

}  // namespace test_guides
}  // namespace dynlab::test
