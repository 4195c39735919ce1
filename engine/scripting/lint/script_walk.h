#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline scripting {

/// A name that is no local variable at its place.
struct GlobalUse {
    std::string name, member;  ///< of `report.value` both; `member` is empty where none follows
    std::size_t begin = 0, member_begin = 0;
    bool written = false;  ///< on the left of an assignment, or the name of a function
};

/// A table as it is written among the arguments of a call.
struct WrittenKey {
    std::string name;
    std::size_t begin = 0;
};

struct WrittenArgument {
    enum class Kind { kOther, kText, kTable };
    Kind kind = Kind::kOther;
    std::string text;              ///< of a text, without its quotes
    std::vector<WrittenKey> keys;  ///< of a table: those written name = value
    std::size_t begin = 0;
};

/// A call of a function that is no local variable: "srivc", "report.value".
struct WrittenCall {
    std::string function;
    std::size_t begin = 0;
    std::vector<WrittenArgument> arguments;
};

struct WalkedScript {
    std::vector<GlobalUse> globals;  ///< in the order of the text
    std::vector<WrittenCall> calls;
    std::vector<std::string> locals;  ///< every name that is one somewhere
};

/// The names that a script reads, writes and calls, by Lua's rules of scope. `source` is Lua, in which expressions may
/// be used as statements; for other text the result means little. All places are offsets in bytes.
WalkedScript walk_script(std::string_view source);

}  // namespace dynlab::inline scripting
