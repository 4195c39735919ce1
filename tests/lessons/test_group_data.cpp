// The data that a lesson loads, and the data sets of groups. Oracles: Lua's simulated plants and save_mat(), whose file
// must be the same bytes; the meaning of each script's spelling in Lua.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "figures/gnuplot_renderer.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "scripting/interpreter/runtime.h"
#include "support/environment_variable.h"
#include "workflow/lesson_data.h"
#include "workflow/student_copy.h"
#include "workflow/variant_data.h"

namespace dynlab::test {
namespace test_group_data {
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class group_data : public testing::Test {
  protected:
    Lesson lesson(const std::string& code) {
        const Lesson made{"99_small", work_.path() / "99_small"};
        fs::create_directories(made.folder);
        write_file_atomically(made.script(), "-- ---\n-- title: Small\n-- lesson: 99_small\n-- ---\n" + code + "\n");
        return made;
    }
    std::vector<std::string> data_of(const std::string& code) { return simulated_data_of(lesson(code)); }
    fs::path path(const std::string& name) const { return work_.path() / name; }

  private:
    TemporaryFolder work_;
    EnvironmentVariable cache_home_{"XDG_CACHE_HOME", work_.path() / "cache"};
};

TEST_F(group_data, is_found_however_a_script_spells_its_name) {
    for (const char* code :
         {"local c = load(\"crane\")", "local c = load('crane')", "local c = load \"crane\"", "local c = load 'crane'",
          "local c = load [[crane]]", "local c = load([==[crane]==])", "local name = 'crane'\nlocal c = load(name)",
          "for _, name in ipairs{'crane'} do load(name) end", "local c = load('cra' .. 'ne')",
          "local read = load\nlocal c = read(\n  'crane')", "local c = load(\"cr\\97ne\")",
          "local c = load('data/crane/crane.mat')", "local c = _G['load'] --[[of a]] ( 'crane' )"}) {
        EXPECT_THAT(data_of(code), ElementsAre("crane")) << code;
    }
    EXPECT_THAT(data_of("local t, c = load('thruster'), load('crane')\nlocal again = load('thruster')"),
                ElementsAre("crane", "thruster"));
}

TEST_F(group_data, is_not_what_a_script_only_speaks_of) {
    for (const char* code : {"-- load(\"crane\")", "print('load(\"crane\")')", "if false then load('crane') end",
                             "local w = load('winning_times')", "local r = plant('crane')", "local text = 'crane'"})
        EXPECT_THAT(data_of(code), IsEmpty()) << code;
}

TEST_F(group_data, of_a_lesson_that_stops_are_not_guessed) {
    try {
        data_of("local c = load('crane')\nerror('no further')");
        FAIL();
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("the data of lesson 99_small are unknown"));
        EXPECT_THAT(error.what(), HasSubstr("no further"));
    }
}

TEST_F(group_data, are_found_again_for_an_edited_lesson) {
    EXPECT_THAT(data_of("local c = load('crane')"), ElementsAre("crane"));
    EXPECT_THAT(data_of("local c = load('crane')"), ElementsAre("crane"));  // as kept
    EXPECT_THAT(data_of("local c = load('suspension')"), ElementsAre("suspension"));
}

TEST_F(group_data, records_are_the_bytes_that_lua_saves) {
    for (const Plant& plant : plant_catalog()) {
        const fs::path ours = path("ours"), theirs = path("theirs");
        fs::create_directories(ours);
        fs::create_directories(theirs);
        write_variant_data(plant.name, {.variant_number = 5, .seed = 6}, ours);
        RunOptions options;
        options.out_folder = theirs;
        GnuplotRenderer renderer;
        Runtime runtime(options, renderer);
        const std::string file = plant.name + ".mat";
        const RunRecord run = runtime.run_code(
            "save_mat('" + file + "', plant('" + plant.name + "', {variant = 5, seed = 6}), {digits = 7})", "made.lua");
        ASSERT_FALSE(run.error) << run.error->text();
        EXPECT_TRUE(read_file(ours / file) == read_file(theirs / file)) << plant.name;
    }
    EXPECT_THROW(write_variant_data("hairdryer", {}, path("ours")), InvalidArgument);
}

TEST_F(group_data, stand_in_the_copy_of_a_group_and_of_no_other) {
    const Lesson spelt = lesson("local name = 'suspension'\nlocal d = load(name)");
    make_student_copy(spelt, path("group"), 7);
    write_variant_data("suspension", {.variant_number = 7, .seed = 7}, path("."));
    EXPECT_TRUE(read_file(path("group/data/suspension/suspension.mat")) == read_file(path("suspension.mat")));
    EXPECT_FALSE(fs::exists(path("group/data/crane")));
    EXPECT_EQ(group_seed_of(path("group/data")), 7u);
    make_student_copy(spelt, path("all"));
    EXPECT_TRUE(fs::is_symlink(path("all/data")));
    EXPECT_EQ(group_seed_of(path("all/data")), std::nullopt);
}

}  // namespace test_group_data
}  // namespace dynlab::test
