#include "data_io/text_table.h"

#include <gmock/gmock.h>

#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_text_table {

std::string written(const std::string& cell) {
    const std::string text = csv_text({{"a", "b"}, {{"x", cell}}, {}});
    return text.substr(7, text.size() - 9);  // behind the names and the first cell, without the line's end
}

TEST(text_table, cells_of_numbers_and_words_stay) {
    for (const char* cell : {"Ada", "-1.5", "1e-3", "a = b", "x@y.z", ""}) EXPECT_EQ(written(cell), cell);
    EXPECT_EQ(written("late; 3 points"), "\"late; 3 points\"");
    EXPECT_EQ(written("2; -3"), "\"2; -3\"") << "a number behind the semicolon";
}

// oracle: OWASP, CSV injection: a cell begins behind each separator that a spreadsheet may be set to
TEST(text_table, formulas_are_disarmed_wherever_a_cell_may_begin) {
    EXPECT_EQ(written("=1+1"), "'=1+1");
    EXPECT_EQ(written("@SUM(A1)"), "'@SUM(A1)");
    EXPECT_EQ(written("Bob;=cmd|' /C calc'!A0"), "\"Bob;'=cmd|' /C calc'!A0\"");
    EXPECT_EQ(written("Bob\n=1+1"), "\"Bob\n'=1+1\"");
    EXPECT_EQ(written("Bob\t+A1"), "\"Bob\t'+A1\"");
    EXPECT_EQ(written("a; b; -x"), "\"a; b;' -x\"");
}

// oracle: what was written
TEST(text_table, cells_are_read_as_they_were_given) {
    const TemporaryFolder folder;
    for (const std::string cell : {"=1+1", "-it's \"ok\"", "Bob;=cmd|' /C calc'!A0", "a; b; -x", "'quoted'", "it's",
                                   "-1.5", "two\n-lines", ""}) {
        const auto file = folder.path() / "table.csv";
        write_file_atomically(file, csv_text({{"a", "b"}, {{"x", cell}}, {}}));
        EXPECT_EQ(as_written(read_text_table(file).rows.at(0).at(1)), cell);
    }
}

}  // namespace test_text_table
}  // namespace dynlab
