#include "data_io/csv_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <limits>
#include <random>

#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_csv_file {

using testing::ElementsAre;
using testing::HasSubstr;

class csv_file : public testing::Test {
  protected:
    CsvTable read(const std::string& text) {
        write_file_atomically(file_, text);
        return read_csv_file(file_);
    }
    /// The message without the file it begins with.
    std::string complaint(const std::string& text) {
        try {
            read(text);
        } catch (const EnvironmentError& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.rfind(file_.string(), 0), 0u) << message;
            return message.substr(file_.string().size());
        }
        return "no error";
    }
    static std::vector<double> numbers(const Vector& column) { return {column.begin(), column.end()}; }

    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "x.csv";
};

// Oracle of all readings: what stands in the text.
TEST_F(csv_file, reads_comments_names_numbers_and_texts) {
    const CsvTable table = read(
        "# title: step: first\n# unit t: s\n# unit y: deg C\n# Ts: 0.01\n# a plain remark\n\n"
        "t,y,label\n0,20.5,start\n0.01,-1e-3,\"a, \"\"b\"\"\"\n");
    EXPECT_THAT(table.names, ElementsAre("t", "y", "label"));
    EXPECT_THAT(numbers(table.columns[0]), ElementsAre(0, 0.01));
    EXPECT_THAT(numbers(table.columns[1]), ElementsAre(20.5, -1e-3));
    EXPECT_EQ(table.columns[2].size(), 0);
    EXPECT_THAT(table.texts.at("label"), ElementsAre("start", "a, \"b\""));
    EXPECT_EQ(table.units.at("t"), "s");
    EXPECT_EQ(table.units.at("y"), "deg C");
    EXPECT_EQ(table.Ts, 0.01);
    EXPECT_EQ(table.remarks.at("title"), "step: first");
    EXPECT_EQ(table.remarks.size(), 1u);
}

TEST_F(csv_file, accepts_what_spreadsheets_write) {
    const CsvTable european = read("\xEF\xBB\xBFt;y\r\n0,5;1,25\r\n1;+2e-1\r\n\r\n");
    EXPECT_THAT(european.names, ElementsAre("t", "y"));
    EXPECT_THAT(numbers(european.columns[0]), ElementsAre(0.5, 1));
    EXPECT_THAT(numbers(european.columns[1]), ElementsAre(1.25, 0.2));
    const CsvTable tabs = read("t\ty, filtered\n 1 \t 2.5");
    EXPECT_THAT(tabs.names, ElementsAre("t", "y, filtered"));
    EXPECT_THAT(numbers(tabs.columns[1]), ElementsAre(2.5));
    const CsvTable quoted = read("\"t\",\"y\"\n\"1\",\"2.5\"\n");
    EXPECT_THAT(numbers(quoted.columns[1]), ElementsAre(2.5));
    EXPECT_THAT(numbers(read("y\n1\n2\n").columns[0]), ElementsAre(1, 2));
    EXPECT_THAT(read("a,b\n1,\"two\nlines\"\n2,x\n").texts.at("b"), ElementsAre("two\nlines", "x"));
}

TEST_F(csv_file, does_not_depend_on_the_locale) {
    const std::string before = std::setlocale(LC_NUMERIC, nullptr);
    for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8"}) std::setlocale(LC_NUMERIC, locale);
    EXPECT_THAT(numbers(read("y\n1.5\n").columns[0]), ElementsAre(1.5));
    std::setlocale(LC_NUMERIC, before.c_str());
}

TEST_F(csv_file, names_line_and_column_of_what_is_wrong) {
    EXPECT_EQ(complaint("t,y\n0,1\n1,abc\n"), ", line 3, column y: wanted a number, given \"abc\"");
    EXPECT_EQ(complaint("# Ts: 1\n\nt,y\n0,1\n1,\n"), ", line 5, column y: wanted a number, given an empty cell");
    EXPECT_EQ(complaint("t,y\n0,NaN\n"), ", line 2, column y: wanted a finite number, given \"NaN\"");
    EXPECT_EQ(complaint("t,y\n0,1\n-inf,1\n"), ", line 3, column t: wanted a finite number, given \"-inf\"");
    EXPECT_EQ(complaint("t\n1e999\n"),
              ", line 2, column t: wanted a number that fits double precision, given \"1e999\"");
    EXPECT_EQ(complaint("t,y\n0,1\n1\n"), ", line 3: wanted 2 cells as in the header line, given 1");
    EXPECT_EQ(complaint("t,y\n0,1,2\n"), ", line 2: wanted 2 cells as in the header line, given 3");
    EXPECT_EQ(complaint("t,y\n0,1.5.2\n1,2\n2,3\n"), "no error");  // the first row decides: a text column
    EXPECT_EQ(complaint("t,y\n0,1\n1,1 2\n"), ", line 3, column y: wanted a number, given \"1 2\"");
    EXPECT_EQ(complaint("t;y\n0;1\n1;1.234,5\n"), ", line 3, column y: wanted a number, given \"1.234,5\"");
    EXPECT_EQ(complaint("a,b\n\"two\nlines\",1\nx,y\n"), ", line 4, column b: wanted a number, given \"y\"");
    EXPECT_EQ(complaint("a,b\nx,1\n\"never closed,2\ny,3\n"), ", line 3: a quotation mark is opened and never closed");
    EXPECT_EQ(complaint("a,b\n\"x\"y,1\n"), ", line 2: there is text after a closing quotation mark");
    EXPECT_EQ(complaint("y\n1\n" + std::string(60, 'z') + "\n"),
              ", line 3, column y: wanted a number, given \"" + std::string(40, 'z') + "...\"");
}

TEST_F(csv_file, names_what_is_wrong_above_the_rows) {
    EXPECT_EQ(complaint(""), ": there is no header line with the names of the columns");
    EXPECT_EQ(complaint("# only: remarks\n"), ": there is no header line with the names of the columns");
    EXPECT_EQ(complaint("t,y\n\n"), ": there are no rows below the header line");
    EXPECT_EQ(complaint("0,1\n1,2\n"), ", line 1: wanted a header line with the names of the columns, given numbers");
    EXPECT_EQ(complaint("t,y,t\n1,2,3\n"), ", line 1: two columns have the name t");
    EXPECT_EQ(complaint("t,,y\n1,2,3\n"), ", line 1: column 2 has no name");
    EXPECT_EQ(complaint("\n# Ts: fast\nt\n1\n"),
              ", line 2: the sampling time Ts must be a positive number of seconds, given \"fast\"");
    EXPECT_EQ(complaint("# Ts: -1\nt\n1\n"),
              ", line 1: the sampling time Ts must be a positive number of seconds, given \"-1\"");
    EXPECT_EQ(complaint("# unit z: m\nt,y\n1,2\n"),
              ": a unit is given for z, but there is no such column; the columns are t, y");
    EXPECT_EQ(complaint("\xFF\xFEt\0,\0"), ": the text is in UTF-16; save it as UTF-8");
}

TEST_F(csv_file, missing_file_is_named) {
    EXPECT_THROW(read_csv_file(folder_.path() / "none.csv"), EnvironmentError);
}

// Oracle: 17 significant digits determine a double (IEEE 754), so every bit must come back.
TEST_F(csv_file, keeps_every_bit_with_17_digits) {
    std::mt19937_64 random(1);
    CsvTable table;
    table.names = {"x", "name, of y", "text"};
    table.columns = {Vector(1000), Vector(1000), Vector()};
    std::vector<std::string>& texts = table.texts["text"];
    for (Index i = 0; i < 1000; ++i) {
        table.columns[0][i] = std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 1900) - 1000);
        table.columns[1][i] = -static_cast<double>(i) / 7;
        texts.push_back("\"t\",\n; " + std::to_string(i));
    }
    table.columns[0][0] = std::numeric_limits<double>::max();
    table.columns[0][1] = std::numeric_limits<double>::denorm_min();
    table.units = {{"x", "m/s"}};
    table.Ts = 0.1;
    table.remarks = {{"title", "a: b"}};
    write_csv_file(file_, table, 17);
    const CsvTable back = read_csv_file(file_);
    EXPECT_EQ(back.names, table.names);
    EXPECT_EQ(back.columns[0], table.columns[0]);
    EXPECT_EQ(back.columns[1], table.columns[1]);
    EXPECT_EQ(back.texts, table.texts);
    EXPECT_EQ(back.units, table.units);
    EXPECT_EQ(back.Ts, table.Ts);
    EXPECT_EQ(back.remarks, table.remarks);
}

TEST_F(csv_file, writes_seven_digits) {
    CsvTable table;
    table.names = {"x"};
    table.columns = {Vector{{1.0 / 3, 1e9, 2}}};
    write_csv_file(file_, table);
    EXPECT_EQ(read_file(file_), "x\n0.3333333\n1e+09\n2\n");
}

TEST_F(csv_file, refuses_to_write_what_cannot_be_read) {
    CsvTable table;
    table.names = {"x", "y"};
    table.columns = {Vector::Ones(3), Vector::Ones(2)};
    EXPECT_THROW(write_csv_file(file_, table), InvalidArgument);
    table.columns[1] = Vector::Constant(3, std::nan(""));
    EXPECT_THROW(write_csv_file(file_, table), InvalidArgument);
    table.columns[1] = Vector::Ones(3);
    EXPECT_THROW(write_csv_file(file_, table, 0), InvalidArgument);
    table.names.push_back("z");
    EXPECT_THROW(write_csv_file(file_, table), InvalidArgument);
    EXPECT_THROW(write_csv_file(file_, CsvTable()), InvalidArgument);
    EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(csv_file, refuses_two_columns_of_one_name) {
    CsvTable table;
    table.names = {"t", "y1", "y1"};
    table.columns = {Vector::Ones(2), Vector::Ones(2), Vector::Ones(2)};
    EXPECT_THROW(write_csv_file(file_, table), InvalidArgument);
    EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(csv_file, reads_a_million_rows) {
    std::string text = "t,u,y\n";
    for (int i = 0; i < 1000000; ++i) {
        const std::string number = std::to_string(i);
        text += number + ",1.234567," + "-0.0" + number + "\n";
    }
    write_file_atomically(file_, text);
    const CsvTable table = read_csv_file(file_);
    ASSERT_EQ(table.columns[2].size(), 1000000);
    EXPECT_EQ(table.columns[0].sum(), 499999500000.0);
    EXPECT_EQ(table.columns[2][999999], -0.0999999);
}

}  // namespace test_csv_file
}  // namespace dynlab
