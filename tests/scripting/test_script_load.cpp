// What scripts see of data files. Oracle: what stands in the files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data_io/mat_file.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "script_run.h"

namespace dynlab::test {
namespace test_script_load {

using testing::HasSubstr;

class script_load : public testing::Test {
  protected:
    void write(const std::string& name, const std::string& text) { write_file_atomically(folder_.path() / name, text); }
    RunOptions here() const {
        RunOptions options;
        options.script_folder = folder_.path();
        return options;
    }
    std::string says(const std::string& code) const { return printed(code, here()); }
    std::string complains(const std::string& code) const { return error_of(code, here()); }
    TemporaryFolder folder_;
};

TEST_F(script_load, tells_what_was_guessed_and_feeds_fillmissing) {
    write("a.txt", "time (ms);u [V]\n0;1\n10;\n20;3,5\n");
    EXPECT_EQ(
        says("local d = load(\"a.txt\") print(fillmissing(d.u)[2], d[\"u [V]\"][3], d.units.u)"),
        "a.txt: units from the headers: time in ms, u in V\n"
        "a.txt: numbers are missing, NaN stands for them and fillmissing fills them: 1 of 3 in u (first in line 3)\n"
        "a.txt: numbers are written with a decimal comma, such as 3,5\n"
        "2.25\t3.5\tV\n");
    EXPECT_THAT(complains("print(load(\"a.txt\").y)"), HasSubstr("have no variable 'y'; they have time, u"));
}

TEST_F(script_load, does_as_the_options_say) {
    write("a.dat", "made yesterday, by hand\n0 5\n1 6\n2 7\n");
    EXPECT_EQ(
        says("local d = load(\"a.dat\", {skip = 1, delimiter = \" \", names = {\"clock\", \"y\"}, units = {clock = "
             "\"min\", y = \"m\"}, time = \"clock\"}) print(d.t, d.Ts, d.y, d.units.y)"),
        "[0 60 120]\t60\t[5 6 7]\tm\n");
    EXPECT_THAT(complains("load(\"a.dat\", {skip = 1, time = \"c3\"})"), HasSubstr("the time 'c3' is not a column"));
    EXPECT_THAT(complains("load(\"a.dat\", {delimiter = \"--\"})"), HasSubstr("must be one character"));
    EXPECT_THAT(complains("load(\"a.dat\", {units = {\"V\"}})"), HasSubstr("must be a table like"));
    EXPECT_THAT(complains("load(\"a.dat\", {unit = {}})"), HasSubstr("'unit'"));
    write_mat_file(folder_.path() / "b.mat", {{"y", {Vector{{1, 2}}}}});
    EXPECT_THAT(complains("load(\"b.mat\", {skip = 1})"), HasSubstr("option skip is for tables, not for .mat files"));
}

TEST_F(script_load, data_objects_take_over_the_units_of_columns) {
    write("a.csv", "t (s),u (V),y (rad)\n0,1,2\n1,1,3\n2,0,5\n");
    const auto units = [this](const std::string& call) {
        return says("local d = load(\"a.csv\", {units = {u = \"V\", y = \"rad\"}}) local z = " + call +
                    " print(z.InputUnit[1] .. \"|\" .. z.OutputUnit[1])");
    };
    EXPECT_THAT(units("iddata(d.y, d.u, 1)"), testing::EndsWith("V|rad\n"));
    EXPECT_THAT(units("iddata(d.y, d.u, 1, {InputUnit = \"mV\"})"), testing::EndsWith("mV|rad\n"));
    EXPECT_THAT(units("iddata(1000*d.y, d.u, 1)"), testing::EndsWith("V|\n"));  // no longer in rad
    EXPECT_THAT(units("iddata(d.y, d.u, 1):range(1, 2)"), testing::EndsWith("V|rad\n"));
}

}  // namespace test_script_load
}  // namespace dynlab::test
