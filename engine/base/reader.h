#pragma once
#include <string>
#include <string_view>

#include "base/message.h"

namespace dynlab::inline base {

class Catalog;

/// Who reads a message: the language, and the names of options where the reader meets them. By default English, and the
/// names of the members in backticks.
struct Reader {
    const Catalog* catalog = nullptr;                        ///< nullptr: English
    std::string (*option_name)(std::string_view) = nullptr;  ///< of a member of an options struct
    const Catalog* authors = nullptr;  ///< translations of what an author wrote: looked up for verbatim messages
};

/// The text of a message. Arguments appear unchanged, whatever they hold; numbers have the language's decimal sign. A
/// translation whose {} are not as many as the arguments is not used. A verbatim message is looked up whole among what
/// authors wrote.
std::string message_text(const Message& message, const Reader& reader = {});

/// With its first letter, a to z or one of French, as a small or a capital one.
std::string with_first_letter(std::string text, bool capital);

/// A number as messages show it in that language.
std::string number_text(const Number& number, const Reader& reader = {});

}  // namespace dynlab::inline base
