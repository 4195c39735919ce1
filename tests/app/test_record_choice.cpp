// What is chosen of a data file becomes code; names of files and of columns never do. Oracles: the script's own parser,
// and what the script gives when it is run.
#include "app/workbench/data_choice.h"

#include <gmock/gmock.h>

#include <fstream>

#include "documents/percent_script.h"
#include "platform/error.h"
#include "support/program.h"
#include "support/thrown_message.h"
#include "support/workbench.h"

namespace test_record_choice {
using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;
using testing::Not;

class record_choice : public workbench_page {};

TEST_F(record_choice, a_file_s_name_ends_no_line_of_the_script) {
    const std::string text = new_session("Identification from a\n-- ---\nprint('RAN') --.csv", "", "en");
    EXPECT_EQ(parse_percent_script(text, "session.lua").header.title,
              "Identification from a -- --- print('RAN') --.csv");
    EXPECT_THAT(text, Not(HasSubstr("\nprint")));
    EXPECT_THROW(expect_plain_name("a\nb.csv"), EnvironmentError);
    EXPECT_THROW(expect_plain_name(std::string("evil.lua\0.csv", 13)), EnvironmentError);
    expect_plain_name("été \"1\" %.csv");
}

TEST_F(record_choice, orders_that_are_no_records_are_refused) {
    write("plant.csv", "# Ts: 0.1\nu,y\n1,2\n0,3\n1,2\n");
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const DataSelection good = suggested_order(describe_data("plant.csv"));
    EXPECT_THAT(loading_lines(good), HasSubstr("data = iddata(data_file.y, data_file.u, "));
    DataSelection code = good, word = good, without_input = good, without_output = good;
    word.name = "end";
    code.name = "x = 1\nfoo()\nz";
    without_input.inputs.clear();
    without_output.outputs.clear();
    for (const DataSelection& order : {code, word, without_input, without_output})
        EXPECT_THROW(loading_lines(order), EnvironmentError);
    std::filesystem::current_path(before);
}

/// All that sounds like a channel is one, but for those of another experiment in the same file.
TEST_F(record_choice, all_channels_of_one_experiment_are_offered) {
    const auto channels = [&](const std::string& head) {
        write("plant.csv", "# Ts: 0.1\n" + head + "\n1,2,5,3,4,6\n0,3,4,7,5,3\n1,2,6,4,8,4\n");
        const DataSelection order = suggested_order(describe_data(file("plant.csv").string(), false));
        return std::pair(order.inputs, order.outputs);
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(channels("voltage,theta,x,note,speed,y2"),
              std::pair(Names{"voltage"}, Names({"theta", "x", "speed", "y2"})));
    EXPECT_EQ(channels("u,y,u_val,y_val,u_high,y_high"), std::pair(Names{"u"}, Names{"y"}));
}

/// Experiments in structs. The same data set replaces its cell; another data set follows it.
TEST_F(record_choice, a_record_takes_the_place_of_itself) {
    const DataSelection order{"crane", {"estimation.u"},       {"estimation.theta", "estimation.x"}, "estimation.t", 0,
                              "data",  {{"estimation.x", "m"}}};
    const std::string lines = loading_lines(order);
    EXPECT_THAT(lines,
                HasSubstr("matrix{data_file.estimation.theta, data_file.estimation.x}, data_file.estimation.u, 0.02,"));
    EXPECT_THAT(lines, HasSubstr("OutputName = {\"theta\", \"x\"}, OutputUnit = {\"\", \"m\"}"));
    const std::string first = with_data("-- ---\n-- title: Session\n-- language: fr\n-- ---\n", order, lines);
    EXPECT_THAT(first, HasSubstr("-- language: fr\n"));
    const std::string later = first + "\n-- %% id=G1\nG1 = tfsrivc(estimation, 2, 0)\n";
    EXPECT_EQ(with_data(later, order, lines), later);
    DataSelection other = order;
    other.name = "second1";
    const std::string both = with_data(later, other, loading_lines(other));
    EXPECT_LT(both.find("data = iddata("), both.find("-- %% id=second1\n"));
    EXPECT_LT(both.find("second1 = iddata("), both.find("-- %% id=preparation"));
    EXPECT_THAT(both, HasSubstr("-- %% id=G1\n"));
}

}  // namespace test_record_choice
