// The data sets that scripts/make_data makes. Oracles: equality of bytes with what lies in data/; what was saved.
#include <gtest/gtest.h>

#include <algorithm>

#include "platform/atomic_file.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_make_data {
namespace fs = std::filesystem;

std::vector<std::string> made_sets() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / "scripts/make_data"))
        if (entry.path().extension() == ".lua") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

TEST(make_data, repeats_what_is_stored) {
    const fs::path source = DYNLAB_SOURCE_DIR;
    for (const std::string& name : made_sets()) {
        const Workbench bench;
        const ChildResult result =
            bench.dynlab({"run", (source / "scripts/make_data" / (name + ".lua")).string(), "--out", "."});
        ASSERT_EQ(result.exit_code, 0) << result.error_output;
        fs::remove(bench.path("record.json"));
        const std::vector<std::string> files = bench.files();
        EXPECT_GE(files.size(), 2u);
        for (const std::string& file : files)
            EXPECT_TRUE(bench.read(file) == read_file(source / "data" / name / file)) << name << "/" << file;
    }
}

TEST(make_data, writes_tables_as_structs_that_load_gives_back) {
    const Workbench bench;
    bench.write("a.lua",
                "save_mat('a.mat', {run = {x = linspace(1, 3, 3), note = 'two', inner = {k = 4}}, n = 5})\n"
                "local a = load('a.mat')\n"
                "print(#a.run.x, a.run.x[3], a.run.note, a.run.inner.k, a.n)\n"
                "local loop = {}; loop.loop = loop\n"
                "print(pcall(save_mat, 'b.mat', {loop = loop}))\n");
    const ChildResult result = bench.dynlab({"run", "a.lua"});
    EXPECT_EQ(result.output.substr(0, result.output.find('\n')), "3\t3\ttwo\t4\t5") << result.error_output;
    EXPECT_NE(result.output.find("nested at most 16 levels"), std::string::npos) << result.output;
}

}  // namespace test_make_data
}  // namespace dynlab::test
