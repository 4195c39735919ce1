#include "platform/text_file.h"

#include <gtest/gtest.h>

#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_text_file {

// oracle: Unicode, 23.8: U+FEFF at the start of a text is no part of it, anywhere else it is
TEST(text_file, only_a_mark_at_the_start_is_left_out) {
    const TemporaryFolder folder;
    const std::string mark = "\xEF\xBB\xBF";
    for (const auto& [bytes, text] :
         {std::pair(mark + "line\n", std::string("line\n")), std::pair(mark + mark + "x", mark + "x"),
          std::pair("x" + mark, "x" + mark), std::pair(mark, std::string()),
          std::pair(std::string("\xEF\xBB"), std::string("\xEF\xBB")), std::pair(std::string(), std::string())}) {
        write_file_atomically(folder.path() / "text", bytes);
        EXPECT_EQ(read_text(folder.path() / "text"), text);
        EXPECT_EQ(without_byte_order_mark(bytes), text);
    }
}

}  // namespace test_text_file
}  // namespace dynlab
