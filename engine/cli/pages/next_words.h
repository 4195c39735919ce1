#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace dynlab::inline cli {

/// A possible next word of the command line, with a short description.
struct Suggestion {
    std::string word, about;
};

struct NextWords {
    std::vector<Suggestion> words;  ///< those that begin as the last word does
    bool files = false;             ///< the name of a file or folder is possible as well
};

/// The names that a place called "LESSON", "DATA", "DEMO" or "PAGE" takes.
using NamesOf = std::function<std::vector<Suggestion>(const std::string& place)>;

/// The candidates for the last of `words`, which may be empty; the other words after the program's name are complete.
/// The candidates follow from the commands and options themselves: every accepted word is offered.
NextWords next_words(const CLI::App& program, const std::vector<std::string>& words, const NamesOf& names);

}  // namespace dynlab::inline cli
