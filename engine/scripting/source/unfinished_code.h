#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace dynlab::inline scripting {

/// A word that opens a block, "for", "while", "if", "function", "repeat" or "do", and its line in the script.
struct OpenBlock {
    std::string word;
    int line = 0;
    int else_if = 0;  ///< line of the first "else if" in it, which opens a block that elseif does not; 0 without
};

/// For a source with too few `end`s: the block that lacks its `end`, according to the indentation. An `end` further to
/// the left than the line of the block it closes belongs to an outer block; without such an `end`, it is the last block
/// that is still open.
std::optional<OpenBlock> block_without_end(std::string_view source);

/// The line of the last statement before `line`, where that ends its cell and a sign there, such as = or a comma, wants
/// more; nothing else.
std::optional<int> line_cut_off(std::string_view source, int line);

}  // namespace dynlab::inline scripting
