// Data files as scripts see them. Oracle: the content of the files.
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

TEST_F(script_load, save_csv_writes_the_selected_columns_of_a_data_object) {
    RunOptions options = here();
    options.out_folder = folder_.path();
    const std::string data =
        "local d = iddata({1, 2, 4}, {1, 0, 1}, 0.1, {InputName = 'voltage', OutputName = 'speed', InputUnit = 'V', "
        "OutputUnit = 'rad/s'})\n";
    EXPECT_EQ(printed(data + "save_csv('d.csv', d, {columns = {'speed', 't'}})", options), "");
    EXPECT_EQ(read_text(folder_.path() / "d.csv"),
              "# Ts: 0.1\n# unit speed: rad/s\n# unit t: s\nspeed,t\n1,0\n2,0.1\n4,0.2\n");
    EXPECT_EQ(error_of(data + "save_csv('d.csv', d, {columns = {'zz'}})", options),
              "lesson.lua:2: save_csv: the data object has no column 'zz'; its columns are t, voltage, speed");
}

TEST_F(script_load, save_csv_refuses_units_of_unknown_columns_and_an_invalid_sampling_time) {
    RunOptions options = here();
    options.out_folder = folder_.path();
    EXPECT_EQ(error_of("save_csv('a.csv', {t = {1, 2}}, {units = {zz = 's'}})", options),
              "lesson.lua:1: save_csv: option 'units' contains the name 'zz', but the columns of the file are t");
    EXPECT_EQ(error_of("save_csv('a.csv', {t = {1, 2}}, {Ts = -1})", options),
              "lesson.lua:1: save_csv: the sampling time must be a positive number of seconds, but it is -1");
    EXPECT_FALSE(exists(folder_.path() / "a.csv"));
}

TEST_F(script_load, reports_what_was_assumed_and_feeds_fillmissing) {
    write("a.txt", "time (ms);u [V]\n0;1\n10;\n20;3,5\n");
    EXPECT_EQ(
        says("local d = load(\"a.txt\") print(fillmissing(d.u)[2], d[\"u [V]\"][3], d.units.u)"),
        "a.txt: units from the headers: time in ms, u in V\na.txt: missing numbers were replaced with NaN: 1 of 3 in u "
        "(first on line 3). Use fillmissing(u, {method = \"previous\"}) for an input that is logged only when it "
        "changes, "
        "and fillmissing(y) for an output\na.txt: the numbers have a decimal comma, as in 3,5\n2.25\t3.5\tV\n");
    EXPECT_THAT(complains("print(load(\"a.txt\").y)"), HasSubstr("have no variable 'y'; the variables are time, u"));
}

TEST_F(script_load, names_the_file_and_the_line_that_cannot_be_read) {
    write("cut.mat", std::string("MATLAB 5.0 MAT-file").append(140, ' '));
    write("ragged.csv", "t,y\n0,1\n1\n");
    write("word.csv", "t,y\n0,1\n1,two\n");
    write("inf.csv", "t,y\n0,1\n1,Inf\n");
    EXPECT_THAT(complains("load('cut.mat')"), HasSubstr("cut.mat"));
    for (const char* name : {"ragged.csv", "word.csv", "inf.csv"})
        EXPECT_THAT(complains("load('" + std::string(name) + "')"), HasSubstr(std::string(name) + ", line 3"));
    EXPECT_THAT(complains("load('nowhere.mat')"), HasSubstr("nowhere.mat"));
    EXPECT_THAT(complains("\nload('winning_tmies')"),
                testing::AllOf(HasSubstr("lesson.lua:2"), HasSubstr("winning_times")));
}

TEST_F(script_load, data_of_no_use_are_refused_or_doubted_in_words) {
    write("uneven.csv", "t,u,y\n0,1,2\n0.1,2,3\n0.3,3,4\n0.31,1,2\n0.5,1,2\n");
    const std::string crane = "local e = load('crane').estimation ";
    const std::pair<std::string, std::string> refused[] = {
        {"local d = load('uneven.csv') iddata(d.y, d.u, d.t)", "{SamplingInstants = t}"},
        {"local d = load('uneven.csv') arx(iddata(d.y, d.u, nil, {SamplingInstants = d.t}), {1, 1, 1})", "regular"},
        {"srivc(iddata({0, 1, 0.5, 0.2, 1}, {1, 0, 0, 1, 0}, 0.1), {2, 2, 0})", "at least 12 samples are needed"},
        {crane + "iddata(e, 0.02)", "the table contains t, theta, u, x"},
    };
    for (const auto& [code, words] : refused) EXPECT_THAT(complains(code), HasSubstr(words)) << code;
    const std::pair<std::string, std::string> doubted[] = {
        {"e.theta*180/math.pi, e.u, 0.02, {OutputUnit = 'rad'}", "probably degrees"},
        {"e.u, e.theta, 0.02", "probably exchanged"},
        {"ones(#e.u), e.u, 0.02", "stays at 1 throughout"},
    };
    for (const auto& [data, words] : doubted)
        EXPECT_THAT(says(crane + "advice(iddata(" + data + "))"), HasSubstr(words)) << data;
}

TEST_F(script_load, does_as_the_options_say) {
    write("a.dat", "made yesterday, by hand\n0 5\n1 6\n2 7\n");
    EXPECT_EQ(
        says("local d = load(\"a.dat\", {skip = 1, delimiter = \" \", names = {\"clock\", \"y\"}, units = {clock = "
             "\"min\", y = \"m\"}, time = \"clock\"}) print(d.t, d.Ts, d.y, d.units.y)"),
        "[0 60 120]\t60\t[5 6 7]\tm\n");
    EXPECT_THAT(complains("load(\"a.dat\", {skip = 1, time = \"c3\"})"), HasSubstr("'c3' is not a numeric column"));
    EXPECT_THAT(complains("load(\"a.dat\", {delimiter = \"--\"})"), HasSubstr("must be one character"));
    EXPECT_THAT(complains("load(\"a.dat\", {units = {\"V\"}})"),
                HasSubstr("must be a table of column names and their units, such as"));
    EXPECT_THAT(complains("load(\"a.dat\", {unit = {}})"), HasSubstr("'unit'"));
    write_mat_file(folder_.path() / "b.mat", {{"y", {Vector{{1, 2}}}}});
    EXPECT_THAT(complains("load(\"b.mat\", {skip = 1})"),
                HasSubstr("option 'skip' applies only to tables, not to .mat files"));
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
