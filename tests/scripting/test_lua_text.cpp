// Texts as Lua literals. Oracle: Lua's own reading of the literal.
#include "documents/lua_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripting/script_run.h"

namespace dynlab::test {
namespace test_lua_text {
using testing::Not;

TEST(lua_text, lua_reads_every_byte_back) {
    std::string bytes;
    for (int byte = 0; byte < 256; ++byte) bytes += static_cast<char>(byte);
    const std::string literal = lua_text(bytes + "12\\n\"]]--");
    EXPECT_THAT(literal, Not(testing::HasSubstr("\n")));
    const std::string code = "local text = " + literal +
                             "\nfor i = 1, 256 do assert(text:byte(i) == i - 1) end\n"
                             "assert(text:sub(257) == '12' .. string.char(92) .. 'n' .. string.char(34) .. ']]--')\n";
    EXPECT_EQ(printed(code + "print('read')\n"), "read\n");
}

}  // namespace test_lua_text
}  // namespace dynlab::test
