#include "data_io/data_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_data_file {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Oracle of all spacings: the instants themselves.
TEST(data_file, knows_how_instants_follow_each_other) {
    const InstantSpacing even = spacing_of(Vector{{0, 0.1, 0.2, 0.30001, 0.4}});
    EXPECT_TRUE(even.even);
    EXPECT_NEAR(even.step, 0.1, 1e-15);
    const InstantSpacing gap = spacing_of(Vector{{0, 1, 2, 5, 6, 7, 9, 10}});
    EXPECT_FALSE(gap.even);
    EXPECT_EQ(gap.step, 1);
    EXPECT_THAT(gap.gaps, ElementsAre(2, 5));
    EXPECT_EQ(spacing_of(Vector{{0, 1, 1, 2}}).disorder, 1);
    EXPECT_EQ(spacing_of(Vector{{0, 1, std::nan(""), 2}}).disorder, 1);
    const InstantSpacing uneven = spacing_of(Vector{{0, 1, 2.2, 3.1, 4}});
    EXPECT_FALSE(uneven.even);
    EXPECT_THAT(uneven.gaps, IsEmpty());
}

TEST(data_file, finds_the_column_of_the_time) {
    const Vector three{{0.1, 0.2, 0.3}};
    const auto found = [&](const std::vector<std::pair<std::string, std::string>>& columns) -> std::string {
        LoadedData data;
        for (const auto& [name, unit] : columns) {
            data.variables[name] = {three};
            if (!unit.empty()) data.units[name] = unit;
        }
        const auto clock = find_clock(data, 3, {}).clock;
        return clock ? fmt::format("{} {:.3g}", clock->name, clock->spacing.step) : "none";
    };
    EXPECT_EQ(found({{"t", ""}, {"u", ""}}), "t 0.1");
    EXPECT_EQ(found({{"Time", "ms"}, {"u", "V"}}), "Time 0.0001");
    EXPECT_EQ(found({{"t_ms", ""}, {"u", "V"}}), "t_ms 0.0001");
    EXPECT_EQ(found({{"clock", "min"}, {"u", "V"}}), "clock 6");
    EXPECT_EQ(found({{"t", "s"}, {"t_val", "s"}}), "t 0.1");
    EXPECT_EQ(found({{"start", "s"}, {"u", "V"}}), "start 0.1");
    EXPECT_EQ(found({{"u", "V"}, {"T", ""}}), "none");
    LoadedData short_one;
    short_one.variables["t"] = {three};
    EXPECT_FALSE(find_clock(short_one, 4, {}).clock);
}

TEST(data_file, takes_the_column_that_is_named_for_the_time) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "x.tsv";
    ImportOptions options;
    options.time = "clock";
    const auto read = [&](const std::string& text) {
        write_file_atomically(file, text);
        return read_data_file(file, true, options);
    };
    const LoadedData data = read("clock (min)\ty\n1\t5\n1.5\t6\n2\t7\n");
    EXPECT_EQ(std::get<Vector>(data.variables.at("t").value), (Vector{{60, 90, 120}}));
    EXPECT_EQ(std::get<double>(data.variables.at("Ts").value), 30);
    EXPECT_EQ(data.units.at("t"), "s");
    EXPECT_EQ(read("clock\ty\n1\t5\n2\t6\n4\t7\n").variables.count("Ts"), 0u);
    for (const auto& [text, expected] :
         {std::pair{"clock\ty\n1\t5\n1\t6\n", "must increase, but sample 1 is 1 and the next sample is 1"},
          {"clock\ty\na\t5\nb\t6\n", "is not a numeric column"},
          {"clock (V)\ty\n1\t5\n2\t6\n", "has the unit V, which is not a unit of time"}}) {
        try {
            read(text);
            ADD_FAILURE() << text;
        } catch (const EnvironmentError& error) {
            EXPECT_THAT(error.what(), HasSubstr(expected));
        }
    }
    const LoadedData beside_t = read("clock (min)\tt\n1\t20\n1.5\t21\n");
    EXPECT_EQ(std::get<Vector>(beside_t.variables.at("clock").value), (Vector{{60, 90}})) << "t is a temperature";
    EXPECT_TRUE(is_data_file("a.lvm") && is_data_file("A.XLSX") && is_data_file("a.dat"));
    EXPECT_FALSE(is_data_file("a.doc"));
}

}  // namespace test_data_file
}  // namespace dynlab
