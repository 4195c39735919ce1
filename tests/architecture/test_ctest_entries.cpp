// Every test of every test program runs in exactly one entry of ctest. Oracles: the file that ctest reads, and what the
// programs list themselves.
#include <fnmatch.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "platform/atomic_file.h"
#include "platform/child_process.h"

namespace test_ctest_entries {
using namespace dynlab;

struct Entry {
    std::string name, filter;
    int tests = 0;
};

/// Whether GoogleTest's filter, patterns between colons, selects the test.
bool selects(const std::string& filter, const std::string& test) {
    std::istringstream patterns(filter);
    for (std::string pattern; std::getline(patterns, pattern, ':');)
        if (fnmatch(pattern.c_str(), test.c_str(), 0) == 0) return true;
    return false;
}

/// The entries of each program.
std::map<std::string, std::vector<Entry>> entries() {
    // Runs the tests of another entry again, at every place of a fault.
    const std::string repeated = "course_faults.every_place";
    const std::regex entry(
        R"re(add_test\((?:\[=\[)?([\w.]+)(?:\]=\])? "([^"]*/tests_\w+)" "--gtest_filter=([^"]*)"\))re");
    const std::string text = read_file(DYNLAB_CTEST_ENTRIES);
    std::map<std::string, std::vector<Entry>> of_program;
    for (std::sregex_iterator found(text.begin(), text.end(), entry), end; found != end; ++found)
        if ((*found)[1] != repeated) of_program[(*found)[2]].push_back({(*found)[1], (*found)[3]});
    return of_program;
}

std::vector<std::string> tests_in(const std::string& program) {
    ChildOptions options;
    options.command = {program, "--gtest_list_tests"};
    const ChildResult listed = run_child(options, "scripts/test, which builds it");
    EXPECT_EQ(listed.exit_code, 0) << program << ": " << listed.error_output;
    std::vector<std::string> tests;
    std::istringstream lines(listed.output);
    std::string suite;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("Running main()")) continue;
        const std::string name = line.substr(0, line.find("  #"));  // a comment: the parameter
        if (name.starts_with("  "))
            tests.push_back(suite + name.substr(2));
        else
            suite = name;
    }
    return tests;
}

TEST(ctest_entries, cover_every_test_exactly_once) {
    auto programs = entries();
    EXPECT_GT(programs.size(), 20u);
    for (auto& [program, of_program] : programs) {
        for (const std::string& test : tests_in(program)) {
            std::vector<std::string> covering;
            for (Entry& entry : of_program) {
                if (!selects(entry.filter, test)) continue;
                covering.push_back(entry.name);
                ++entry.tests;
            }
            EXPECT_EQ(covering.size(), 1u) << program << ", " << test << ": " << testing::PrintToString(covering);
        }
        for (const Entry& entry : of_program) EXPECT_GT(entry.tests, 0) << entry.name << " runs no test";
    }
}

}  // namespace test_ctest_entries
