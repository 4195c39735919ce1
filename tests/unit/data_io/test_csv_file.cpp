#include "data_io/csv_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "support/message_texts.h"
#include "support/peak_memory.h"

namespace dynlab {
namespace test_csv_file {

using test::texts_of;
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

// Oracle of all readings: the content of the text.
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
    const std::string remedy = "; leave the cell of a missing sample empty, or write NaN";
    EXPECT_EQ(complaint("t,y\n0,1\n1,abc\n"), ", line 3, column y: expected a number, got \"abc\"" + remedy);
    EXPECT_EQ(complaint("t,y\n0,1\n-inf,1\n"), ", line 3, column t: expected a finite number, got \"-inf\"" + remedy);
    EXPECT_EQ(complaint("t\n1e999\n"),
              ", line 2, column t: expected a number within the range of double precision, got \"1e999\"");
    EXPECT_EQ(complaint("t,y\n0,1\n1\n"), ", line 3: expected 2 cells as in the lines above, got 1");
    EXPECT_EQ(complaint("t,y\n0,1\n0,1,2\n1,2\n"), ", line 3: expected 2 cells as in the lines above, got 3");
    EXPECT_EQ(
        complaint("t,y\n0,1,2\n"),
        ", line 1: the line has 2 names, but the rows below it have 3 cells; if the line is not part of the table, use "
        "load(file, {skip = 1})");
    EXPECT_EQ(complaint("t,y\n0,1.5.2\n1,2\n2,3\n"), ", line 2, column y: expected a number, got \"1.5.2\"" + remedy);
    EXPECT_EQ(complaint("t,y\n0,1\n1,1 2\n"), ", line 3, column y: expected a number, got \"1 2\"" + remedy);
    EXPECT_EQ(complaint("t;y\n0;1.5\n1;1.234,5\n"),
              ", line 3, column y: expected a number, got \"1.234,5\"; write it without thousands separators");
    EXPECT_EQ(complaint("t,y\n0,1\n1,3.2 V\n2,3\n3,4\n"),
              ", line 3, column y: expected a number, got \"3.2 V\"; write the unit in the header, not in the cell");
    EXPECT_EQ(complaint("t,y\n0,3.2 V\n1,3.2 V\n2,150 mV\n3,4 V\n"),
              ", line 4, column y: expected a number with the unit V as in the other rows, got \"150 mV\"");
    EXPECT_EQ(complaint("a,b\n\"two\nlines\",1\nx,y\n"), ", line 4, column b: expected a number, got \"y\"" + remedy);
    EXPECT_EQ(complaint("a,b\nx,1\n\"never closed,2\ny,3\n"), ", line 3: a quotation mark is not closed");
    EXPECT_EQ(complaint("t,y\n0,\"1\n1,2\n"), ", line 2: a quotation mark is not closed");
    EXPECT_EQ(complaint("a,b\n\"x\"y,1\n"), ", line 2: text follows a closing quotation mark");
    EXPECT_EQ(complaint("y\n1\n" + std::string(60, 'z') + "\n2\n3\n4\n"),
              ", line 3, column y: expected a number, got \"" + std::string(40, 'z') + "...\"" + remedy);
}

// Oracle: file, line and counts of this table.
TEST_F(csv_file, error_has_the_file_and_the_line_as_arguments) {
    write_file_atomically(file_, "t,y\n0,1\n1\n");
    try {
        read_csv_file(file_);
        FAIL() << "the last row is too short";
    } catch (const EnvironmentError& error) {
        EXPECT_EQ(error.message(), Message("{}, line {}: expected {} as in the lines above, got {}", file_.string(), 3,
                                           plural(2, "{} cell", "{} cells"), 1));
    }
}

TEST_F(csv_file, names_what_is_wrong_above_the_rows) {
    EXPECT_EQ(complaint(""),
              ": the file contains no table; expected a header line with the names of the columns, followed by rows of "
              "numbers");
    EXPECT_EQ(complaint("# only: remarks\n"),
              ": the file contains no table; expected a header line with the names of the columns, followed by rows of "
              "numbers");
    EXPECT_EQ(complaint("t,y\n\n"), ": the table has no rows below the header line");
    EXPECT_EQ(complaint("\n# Ts: fast\nt\n1\n"),
              ", line 2: the sampling time Ts must be a positive number of seconds, but \"fast\" was given");
    EXPECT_EQ(complaint("# Ts: -1\nt\n1\n"),
              ", line 1: the sampling time Ts must be a positive number of seconds, but \"-1\" was given");
    EXPECT_EQ(complaint("# unit z: m\nt,y\n1,2\n"),
              ": a unit is given for z, which is not a column; the columns are t, y");
    EXPECT_EQ(complaint(std::string("t,y\n1,\0\n", 8)),
              ": the file contains bytes that are not text; export the table as CSV in UTF-8");
}

/// What a table says: names, then the rows, one line each.
std::string shown_table(const CsvTable& table) {
    std::string text = fmt::format("{}", fmt::join(table.names, "|"));
    const auto texts_of_first = table.texts.find(table.names.front());
    const std::size_t rows = texts_of_first != table.texts.end()
                                 ? texts_of_first->second.size()
                                 : static_cast<std::size_t>(table.columns.front().size());
    for (std::size_t i = 0; i < rows; ++i) {
        text += '\n';
        for (std::size_t j = 0; j < table.names.size(); ++j) {
            const auto texts = table.texts.find(table.names[j]);
            text += j > 0 ? "|" : "";
            text += texts != table.texts.end() ? texts->second[i]
                                               : fmt::format("{}", table.columns[j][static_cast<Index>(i)]);
        }
    }
    return text;
}

// Every separator with every number format that goes with it gives the same table.
TEST_F(csv_file, finds_the_separator) {
    const std::string expected = "t|u|y\n0|-1|2.5\n0.1|1e-05|3\n0.2|3|-4.5";
    for (const char* text :
         {"t,u,y\n0,-1,2.5\n0.1,1e-5,3\n0.2,3,-4.5\n",          //
          "t;u;y\n0;-1;2,5\n0,1;1e-5;3\n0,2;3;-4,5\n",          //
          "t;u;y\n0;-1;2.5\n0.1;1e-5;3\n0.2;3;-4.5\n",          //
          "t\tu\ty\n0\t-1\t2,5\n0,1\t1e-5\t3\n0,2\t3\t-4,5\n",  //
          "t | u | y\n0 | -1 | 2.5\n0.1|1e-5|3\n0.2|3|-4.5",    //
          "t u y\n0 -1 2.5\n0.1 1e-5 3\n0.2 3 -4.5\n",          //
          "  t    u \t y  \r\n 0   -1   2,5 \r\n 0,1  1.0D-05 3\r\n\r\n 0,2\t3   -4,5\r\n",
          "t, u, y\n0, -1, 2.5\n0.1, 1e-5, 3\n0.2, 3, -4.5\n",  //
          "\"t\",\"u\",\"y\"\n\"0\",\"-1\",\"2,5\"\n\"0,1\",\"1e-5\",\"3\"\n\"0,2\",\"3\",\"-4,5\"\n",
          "sep=;\nt;u;y\n0;-1;2,5\n0,1;1e-5;3\n0,2;3;-4,5\n",
          "t,u,y,\n0,-1,2.5,\n0.1,1e-5,3,\n0.2,3,-4.5,\n",  // rows end in a separator
          "t,u,y\n0,-1,2.5,\n0.1,1e-5,3,\n0.2,3,-4.5,\n"})
        EXPECT_EQ(shown_table(read(text)), expected) << text;
    EXPECT_EQ(shown_table(read("y\n1,5\n2,5\n")), "y\n1.5\n2.5");
    EXPECT_THAT(texts_of(read("t;u\n0;1,5\n").notes), ElementsAre("the numbers have a decimal comma, as in 1,5"));
    EXPECT_THAT(read("t,u\n0,1.5\n").notes, testing::IsEmpty());
}

TEST_F(csv_file, passes_over_what_is_around_a_table) {
    const std::string expected = "t|y\n0|1\n1|2";
    for (const char* text : {"% made by hand\nt,y\n0,1\n# changed the probe\n1,2\n% end\n",
                             "LabVIEW Measurement\nDate;2024/01/31\n\nt;y\n0;1\n1;2\n",
                             "Model,TDS 210\nRecord Length,2500\nSample Interval,0.001\nt,y\n0,1\n1,2\n",
                             "# t,y\n0,1\n1,2\n", "% t  y\n0 1\n1 2\n"})
        EXPECT_EQ(shown_table(read(text)), expected) << text;
    EXPECT_THAT(texts_of(read("A\nB\n\nt;y\n0;1\n1;2\n").notes),
                ElementsAre("the table starts at line 4; 2 lines above it are skipped"));
    EXPECT_THAT(texts_of(read("# t,y\n0,1\n1,2\n").notes),
                ElementsAre("the column names are read from the comment above the numbers"));
}

TEST_F(csv_file, takes_missing_numbers_for_nan_and_says_so) {
    const std::string expected = "t|y\n0|nan\n1|2\n2|nan\n3|4";
    for (const char* missing : {"", "NaN", "nan", "NA", "N/A", "#N/A", "null", "-", "\"\"", " "}) {
        const CsvTable table = read(fmt::format("t,y\n0,{0}\n1,2\n2,{0}\n3,4\n", missing));
        EXPECT_EQ(shown_table(table), expected) << missing;
        EXPECT_THAT(
            texts_of(table.notes),
            ElementsAre(
                "missing numbers were replaced with NaN: 2 of 4 in y (first on line 2). Use fillmissing(u, {method = "
                "\"previous\"}) for an input that is logged only when it changes, and fillmissing(y) for an output"));
    }
    const CsvTable benchmark = read("u,y,Ts,\n0,1,4,\n1,2,,\n2,3,,\n");
    EXPECT_EQ(benchmark.columns[2], (Vector{{4}}));
    EXPECT_THAT(texts_of(benchmark.notes),
                ElementsAre("the only number in column Ts, in its first row, is used as the sampling time"));
    EXPECT_EQ(shown_table(read("y,t\n#N/A,0\n1,2\n")), "y|t\nnan|0\n1|2");
    EXPECT_EQ(shown_table(read("name,score\nAnna,\nBob,3\n")), "name|score\nAnna|nan\nBob|3");
}

TEST_F(csv_file, gives_names_where_there_are_none) {
    const CsvTable pandas = read(",t,y\n0,0,1\n1,0.1,2\n");
    EXPECT_EQ(shown_table(pandas), "index|t|y\n0|0|1\n1|0.1|2");
    EXPECT_THAT(texts_of(pandas.notes), ElementsAre("columns without a name in the header: column 1 is named index"));
    EXPECT_EQ(shown_table(read("\"t\" \"y\"\n\"1\" 0 1\n\"2\" 0.1 2\n")), "index|t|y\n1|0|1\n2|0.1|2");  // as R does
    EXPECT_EQ(shown_table(read("t,,y\n1,2,3\n")), "t|column_2|y\n1|2|3");
    const CsvTable twice = read("t,y,y,y_2,y\n1,2,3,4,5\n");
    EXPECT_THAT(twice.names, ElementsAre("t", "y", "y_3", "y_2", "y_4"));
    EXPECT_THAT(texts_of(twice.notes), ElementsAre("columns with the same name are numbered: y_3, y_4"));
    const CsvTable bare = read("0 1\n1 2\n");
    EXPECT_EQ(shown_table(bare), "c1|c2\n0|1\n1|2");
    EXPECT_THAT(texts_of(bare.notes),
                ElementsAre(HasSubstr("the file has no header line, so the columns are named c1, c2")));
}

TEST_F(csv_file, finds_units) {
    const CsvTable row = read("t,u,y,label\ns,V,deg C,\n0,1,2,a\n1,2,3,b\n");
    EXPECT_EQ(shown_table(row), "t|u|y|label\n0|1|2|a\n1|2|3|b");
    EXPECT_EQ(row.units, (std::map<std::string, std::string>{{"t", "s"}, {"u", "V"}, {"y", "deg C"}}));
    EXPECT_THAT(texts_of(row.notes), ElementsAre("line 2 is read as units: t in s, u in V, y in deg C"));
    EXPECT_EQ(read("t\ty\n(ms)\t[m/s^2]\n0\t1\n").units.at("y"), "m/s^2");
    const CsvTable scope = read("x-axis,1,2\nsecond,Volt,Volt\n-0.1,0.5,0.25\n0,0.6,0.3\n");
    EXPECT_EQ(shown_table(scope), "x-axis|1|2\n-0.1|0.5|0.25\n0|0.6|0.3");
    EXPECT_EQ(scope.units.at("x-axis"), "second");
    const CsvTable header = read("time (s);u [V];y (filtered);z(2)\n0;1;2;3\n");
    EXPECT_THAT(header.names, ElementsAre("time", "u", "y (filtered)", "z(2)"));
    EXPECT_EQ(header.units, (std::map<std::string, std::string>{{"time", "s"}, {"u", "V"}}));
    EXPECT_EQ(header.headers, (std::map<std::string, std::string>{{"time (s)", "time"}, {"u [V]", "u"}}));
    EXPECT_THAT(texts_of(header.notes), ElementsAre("units from the headers: time in s, u in V"));
    EXPECT_THAT(read("y (V),y (m)\n0,1\n").names, ElementsAre("y (V)", "y (m)"));
    EXPECT_EQ(read("# unit u (V): mV\nt,u (V)\n0,1\n").units.at("u"), "mV");
}

// Families of cells that programs write; the same numbers in each.
TEST_F(csv_file, switches_are_ones_and_zeros) {
    for (const auto& [on, off] : {std::pair{"ON", "OFF"},
                                  {"On", "Off"},
                                  {"TRUE", "FALSE"},
                                  {"true", "false"},
                                  {"high", "low"},
                                  {"HIGH", "LOW"},
                                  {"yes", "no"},
                                  {"open", "closed"},
                                  {"EIN", "AUS"},
                                  {"wahr", "falsch"},
                                  {"vrai", "faux"},
                                  {"VRAI", "FAUX"},
                                  {"oui", "non"},
                                  {"ja", "nein"},
                                  {"marche", "arr\u00EAt"},
                                  {"enabled", "disabled"}}) {
        const CsvTable table = read(fmt::format("t,heater\n0,{0}\n1,{0}\n2,{1}\n3,\n4,{0}\n", on, off));
        ASSERT_EQ(table.columns[1].size(), 5) << on;
        EXPECT_EQ(table.columns[1].head(3), (Vector{{1, 1, 0}})) << on;
        EXPECT_TRUE(std::isnan(table.columns[1][3])) << on;
        EXPECT_THAT(texts_of(table.notes), testing::Contains(HasSubstr("read as 1 and 0"))) << on;
    }
    EXPECT_THAT(read("t,name\n0,on\n1,left\n").texts.at("name"), ElementsAre("on", "left"));
    std::string late = "t,h\n";
    for (int i = 0; i < 400; ++i) late += fmt::format("{},{}\n", i, i == 350 ? "broken" : i % 2 == 0 ? "ON" : "OFF");
    EXPECT_EQ(complaint(late), ", line 352, column h: expected on or off as in the other rows, got \"broken\"");
}

TEST_F(csv_file, units_in_cells_become_the_columns_units) {
    for (const auto& [cells, unit] : {std::pair{"50%|12.5%|-3%", "%"},
                                      {"50 %|12.5 %|-3 %", "%"},
                                      {"50 V|12.5 V|-3 V", "V"},
                                      {"50V|12.5V|-3V", "V"},
                                      {"50 \u00B0C|12.5 \u00B0C|-3 \u00B0C", "\u00B0C"},
                                      {"50 rpm|12.5 rpm|-3 rpm", "rpm"},
                                      {"50 m/s|12.5 m/s|-3 m/s", "m/s"},
                                      {"50 kPa|12.5 kPa|-3 kPa", "kPa"},
                                      {"50 l/min|12.5 l/min|-3 l/min", "l/min"},
                                      {"50,0 mA|12,5 mA|-3 mA", "mA"}}) {
        std::string text = "t;y\n";
        int row = 0;
        std::istringstream list(cells);
        for (std::string cell; std::getline(list, cell, '|');) text += fmt::format("{};{}\n", row++, cell);
        const CsvTable table = read(text);
        EXPECT_EQ(table.columns[1], (Vector{{50, 12.5, -3}})) << cells;
        EXPECT_EQ(table.units.at("y"), unit) << cells;
    }
    EXPECT_EQ(read("t (ms),y\n0 ms,1\n20 ms,2\n").columns[0], (Vector{{0, 20}}));
    EXPECT_THAT(texts_of(read("t,y\n0,5 pieces\n1,6 pieces\n").notes),
                testing::Contains(HasSubstr("contains text, not numbers")));
}

TEST_F(csv_file, signs_between_thousands_are_read_where_they_are_certain) {
    const Vector expected{{1234.5, 12345.25, 1234567}};
    for (const char* text :
         {"t;y\n0;1.234,5\n1;12.345,25\n2;1.234.567\n", "t\ty\n0\t1,234.5\n1\t12,345.25\n2\t1,234,567\n",
          "t,y\n0,\"1,234.5\"\n1,\"12,345.25\"\n2,\"1,234,567\"\n", "t;y\n0;1 234,5\n1;12 345,25\n2;1 234 567\n",
          "t;y\n0;1\u202F234,5\n1;12\u202F345,25\n2;1\u202F234\u202F567\n",
          "t;y\n0;1\u00A0234,5\n1;12\u00A0345,25\n2;1\u00A0234\u00A0567\n",
          "t;y\n0;1\u2009234.5\n1;12\u2009345.25\n2;1\u2009234\u2009567\n",
          "t;y\n0;1'234.5\n1;12'345.25\n2;1'234'567\n",
          "t;y\n0;1\u2019234.5\n1;12\u2019345.25\n2;1\u2019234\u2019567\n"}) {
        const CsvTable table = read(text);
        EXPECT_EQ(table.columns[1], expected) << text;
        EXPECT_THAT(texts_of(table.notes), testing::Contains(HasSubstr("contains thousands"))) << text;
    }
    // One sign before three digits is what the other numbers leave.
    EXPECT_EQ(read("t;y\n0,5;1.234\n1,0;2.500\n").columns[1], (Vector{{1234, 2500}}));
    EXPECT_EQ(read("t\ty\n0.5\t1,234\n1.0\t2,500\n").columns[1], (Vector{{1234, 2500}}));
    EXPECT_EQ(read("t,y\n0,\"1,234\"\n1,\"2,500\"\n").columns[1], (Vector{{1234, 2500}}));
    EXPECT_EQ(read("t;y\n0,5;1,234\n1,0;2,5\n").columns[1], (Vector{{1.234, 2.5}}));
    EXPECT_EQ(read("t;y\n0.5;1.234\n1.0;2.5\n").columns[1], (Vector{{1.234, 2.5}}));
    EXPECT_EQ(read("t;y\n0;0,125\n1;0,250\n").columns[1], (Vector{{0.125, 0.25}}));
}

TEST_F(csv_file, lines_below_a_table_are_left_out) {
    std::string rows = "t;u;y\n", expected = "t|u|y";
    for (int i = 0; i < 12; ++i)
        rows += fmt::format("{};{};{}\n", i, i + 1, i + 2), expected += fmt::format("\n{}|{}|{}", i, i + 1, i + 2);
    for (const char* footer : {"END\n", "\nEND", "END;;\n", "Mean;2;3\nMax;3;4\n", "\nStatistics\nMean;2;3\n",
                               "Samples: 3\n", ";;\n;;\n", ";;\nTotal;6;9\n", "# end\n", "--- end of file ---\n",
                               "Comment;made by hand;\n", ";;Mean 3\n", "*** 3 samples ***\nDuration;2 s\n"}) {
        EXPECT_EQ(shown_table(read(rows + footer)), expected) << footer;
    }
    EXPECT_THAT(texts_of(read(rows + "END\n").notes),
                ElementsAre("dynlab ignores line 14 and the lines after it, which are below the table: \"END\""));
    EXPECT_THAT(complaint(rows + "broken;1;2\n4;5;6\n"), HasSubstr("line 14, column t: expected a number"));
    EXPECT_THAT(complaint(rows + "3;4\n"), HasSubstr("line 14: expected 3 cells")) << "a file that was cut off";
}

TEST_F(csv_file, empty_columns_at_the_end_are_columns_where_they_have_a_name) {
    EXPECT_EQ(shown_table(read("a,b,c,d\n0,1,2,3\n1,2,,\n2,3,,\n3,4,,\n")),
              "a|b|c|d\n0|1|2|3\n1|2|nan|nan\n2|3|nan|nan\n3|4|nan|nan");
    for (const char* text : {"a,b,,\n0,1,,\n1,2,,\n", "a,b\n0,1,,\n1,2,,\n", "a,b,,,\n0,1,,,\n1,2,,,\n",
                             "a;b;;\n0;1;;\n1;2;;\n", "a\tb\t\t\n0\t1\t\t\n1\t2\t\t\n"})
        EXPECT_EQ(shown_table(read(text)), "a|b\n0|1\n1|2") << text;
    EXPECT_EQ(shown_table(read("a,b,note\n0,1,\n1,2,\n")), "a|b|note\n0|1|nan\n1|2|nan");
}

TEST_F(csv_file, instruments_exports_are_read) {
    const CsvTable labview = read(
        "LabVIEW "
        "Measurement\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t,\nX_Columns\tOne\nDate\t2025/03/11\n"
        "***End_of_Header***\t\n\t\nChannels\t2\t\t\nSamples\t2\t2\t\nY_Unit_Label\tV\trpm\nX_Dimension\tTime\tTime\n"
        "X0\t0,0E+0\t0,0E+0\nDelta_X\t0,01\t0,01\n***End_of_Header***\t\t\t\nX_Value\tvalve\ttacho\tComment\n"
        "0,00\t1,5\t2,5\n0,01\t-1,0\t3,5\n");
    EXPECT_EQ(shown_table(labview), "X_Value|valve|tacho\n0|1.5|2.5\n0.01|-1|3.5");
    EXPECT_EQ(labview.units, (std::map<std::string, std::string>{{"X_Value", "s"}, {"valve", "V"}, {"tacho", "rpm"}}));
    const std::string again =
        "LabVIEW Measurement\nX_Columns\tOne\n***End_of_Header***\nX_Dimension\tTime\n***End_of_Header***\n"
        "X_Value\ty\tComment\n0\t1\n1\t2\nX_Dimension\tTime\n***End_of_Header***\n0\t1\n";
    EXPECT_THAT(complaint(again), HasSubstr(", line 10: another recording starts here"));
    const CsvTable rigol =
        read("X,CH1,CH2,Start,Increment,\nSequence,Volt,Volt,-5.0e-03,4.0e-06\n0,1.00,0.5,,\n1,1.25,0.6,,\n");
    EXPECT_THAT(rigol.names, ElementsAre("X", "CH1", "CH2"));
    EXPECT_NEAR(rigol.columns[0][1], -0.004996, 1e-15);
    EXPECT_EQ(rigol.columns[1], (Vector{{1, 1.25}}));
    EXPECT_EQ(rigol.units.at("X"), "s");
    const CsvTable newer = read("CH1,CH2,t0 = -5.0e-03, tInc = 4e-06,\n1.00,0.5,,,\n1.25,0.6,,,\n");
    EXPECT_EQ(shown_table(newer), "CH1|CH2\n1|0.5\n1.25|0.6");
    EXPECT_EQ(newer.Ts, 4e-6);
    const CsvTable tektronix = read(
        "Record Length,2.500e+03,,-0.0050,0.25,\nSample Interval,4.0e-06,,-0.0048,0.5,\nVertical "
        "Units,V,,-0.0046,0.75,\n"
        ",,,-0.0044,1.00,\n,,,-0.0042,1.25,\n");
    EXPECT_EQ(shown_table(tektronix), "time|CH1\n-0.005|0.25\n-0.0048|0.5\n-0.0046|0.75\n-0.0044|1\n-0.0042|1.25");
    EXPECT_EQ(tektronix.units.at("CH1"), "V");
    EXPECT_EQ(shown_table(read("Model,MSO2024\nSample Interval,1e-06,,\nHorizontal "
                               "Units,s,,\n\nTIME,CH1,CH2\n-2e-3,0.1,0.2\n-1e-3,0.2,0.3\n")),
              "TIME|CH1|CH2\n-0.002|0.1|0.2\n-0.001|0.2|0.3");
    const CsvTable pico = read("Time,Channel A,Channel B\n(ms),(V),(mV)\n\n-0.02,0.1,5\n0.00,0.2,6\n0.02,0.3,7\n");
    EXPECT_EQ(shown_table(pico), "Time|Channel A|Channel B\n-0.02|0.1|5\n0|0.2|6\n0.02|0.3|7");
    EXPECT_EQ(pico.units.at("Time"), "ms");
    EXPECT_THAT(complaint("Time,A\n(ms),(V)\n0,1\n1,\u221E\n2,3\n"),
                HasSubstr("line 4, column A: expected a finite number"));
    const CsvTable monitor = read("10:12:05.000 -> 100,83.33\n10:12:05.500 -> 100,95.87\n10:12:06.000 -> 50,96\n");
    EXPECT_THAT(numbers(monitor.columns[0]), ElementsAre(36725, 36725.5, 36726));
    EXPECT_THAT(numbers(monitor.columns[1]), ElementsAre(100, 100, 50));
    EXPECT_EQ(shown_table(read("10:12:04.9 -> pwm,speed\n10:12:05.0 -> 100,83.33\n10:12:05.5 -> 100,95.87\n")),
              "time|pwm|speed\n36725|100|83.33\n36725.5|100|95.87");
}

TEST_F(csv_file, reads_other_alphabets) {
    const std::string expected = "temps|Temp\u00E9rature\n0|20.5\n1|21";
    EXPECT_EQ(shown_table(read("temps;Temp\u00E9rature (\u00B0C)\n0;20,5\n1;21\n")), expected);
    const CsvTable windows = read(
        "temps;Temp\xE9rature (\xB0"
        "C)\r\n0;20,5\r\n1;21\r\n");
    EXPECT_EQ(shown_table(windows), expected);
    EXPECT_EQ(windows.units.at("Temp\u00E9rature"), "\u00B0C");
    EXPECT_EQ(message_text(windows.notes.front()),
              "the text is not UTF-8 and was read as Windows-1252, for example \"Temp\u00E9rature\"");
    for (const bool big_endian : {false, true}) {
        std::string utf16 = big_endian ? "\xFE\xFF" : "\xFF\xFE";
        for (const char16_t c : std::u16string(u"temps;Temp\u00E9rature\n0;20,5\n1;21\n")) {
            const char low = static_cast<char>(c & 0xFF), high = static_cast<char>(c >> 8);
            utf16 += big_endian ? std::string{high, low} : std::string{low, high};
        }
        EXPECT_EQ(shown_table(read(utf16)), expected);
    }
    EXPECT_EQ(shown_table(read("t,y\r0,1\r1,2\r")), "t|y\n0|1\n1|2");
}

TEST_F(csv_file, follows_the_given_options) {
    const auto with = [this](const std::string& text, const ImportOptions& options) {
        write_file_atomically(file_, text);
        return read_csv_file(file_, options);
    };
    EXPECT_EQ(shown_table(with("a,b\n5,6\nt,y\n0,1\n", {.skip = 2})), "t|y\n0|1");
    EXPECT_THROW(with("t\n1\n", {.skip = 3}), EnvironmentError);
    EXPECT_EQ(shown_table(with("0,1\n1,2\n", {.names = {"t", "y"}})), "t|y\n0|1\n1|2");
    EXPECT_EQ(shown_table(with("a,b\n0,1\n", {.names = {"t", "y"}})), "t|y\n0|1");
    EXPECT_THAT(with("0,1\n1,2\n", {.names = {"t", "y"}}).notes, testing::IsEmpty());
    EXPECT_EQ(shown_table(with("a;1,2\nb;4,5\n", {.names = {"p", "q"}, .delimiter = ','})), "p|q\na;1|2\nb;4|5");
    EXPECT_EQ(with("t,y (m)\n0,1\n", {.units = {{"y", "mm"}}}).units.at("y"), "mm");
    EXPECT_THROW(with("t,y\n0,1\n", {.units = {{"z", "mm"}}}), EnvironmentError);
    EXPECT_THROW(with("t,y\n0,1\n", {.names = {"t"}}), EnvironmentError);
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

/// `text` n times, with commas between.
std::string row_of(std::size_t n, const std::string& text) {
    std::string row = text;
    for (std::size_t i = 1; i < n; ++i) row += ',' + text;
    return row + '\n';
}

// Oracle: what the header of reading_memory states, as the kernel counts it.
TEST_F(csv_file, many_cells_take_a_memory_with_a_limit) {
    constexpr double kMax = 512;  // MB
    const std::string commas = "t,y\n" + std::string(50 << 20, ',') + "\n";
    const auto peak_of = [this](const std::string& text, const std::string& expected) {
        return test::peak_memory([&] { EXPECT_THAT(complaint(text), HasSubstr(expected)); });
    };
    const double before = test::peak_memory([] {});
    EXPECT_LT(peak_of(commas, "line 2: the row has more than 100000 cells") - before, kMax);
    std::string words = "name\n";
    for (int i = 0; i < 16 << 20; ++i) words += "ab\n";
    EXPECT_LT(peak_of(words, "the table has too many cells: reading it requires more than 512 MB") - before, kMax);
}

// Oracle: eight bytes for a number, and the text.
TEST_F(csv_file, numbers_of_one_digit_take_the_memory_of_numbers) {
    constexpr Index kRows = 13'000'000;
    std::string text = "u,y\n";
    text.reserve(4 * kRows + 4);
    for (Index i = 0; i < kRows; ++i) text += i % 2 == 0 ? "1,1\n" : "1,0\n";
    write_file_atomically(file_, text);
    text = {};
    const double before = test::peak_memory([] {});
    const double taken = test::peak_memory([&] {
        const CsvTable table = read_csv_file(file_);
        ASSERT_EQ(table.columns[1].size(), kRows);
        EXPECT_EQ(table.columns[0].sum(), kRows);
        EXPECT_EQ(table.columns[1].sum(), kRows / 2);
    });
    EXPECT_LT(taken - before, 400);
}

TEST_F(csv_file, headers_of_one_name_are_numbered_at_once) {
    constexpr std::size_t kColumns = 50000;  // in quadratic time that takes minutes
    const CsvTable table = read(row_of(kColumns, "y") + row_of(kColumns, "1") + row_of(kColumns, "2"));
    ASSERT_EQ(table.names.size(), kColumns);
    EXPECT_EQ(table.names[0], "y");
    EXPECT_EQ(table.names[1], "y_2");
    EXPECT_EQ(table.names.back(), fmt::format("y_{}", kColumns));
    EXPECT_LT(message_text(table.notes.back()).size(), 200u);
}

TEST_F(csv_file, numbered_names_pass_over_those_that_are_there) {
    EXPECT_THAT(read("y,y_2,y,y,y_2\n1,2,3,4,5\n").names, ElementsAre("y", "y_2", "y_3", "y_4", "y_2_2"));
}

TEST_F(csv_file, a_million_rows_are_ordinary) {
    std::string text = "t,u,y\n";
    for (int i = 0; i < 1'000'000; ++i) text += "0.123456,1,-2.5\n";
    EXPECT_EQ(read(text).columns[2].size(), 1'000'000);
}

}  // namespace test_csv_file
}  // namespace dynlab
