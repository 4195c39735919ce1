#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace dynlab::inline cli {

/// A word that may stand next on the command line, and in a few words what it is.
struct Suggestion {
    std::string word, about;
};

struct NextWords {
    std::vector<Suggestion> words;  ///< those that begin as the last word does
    bool files = false;             ///< the name of a file or folder may stand there as well
};

/// The names that a place called "LESSON", "DATA", "DEMO" or "PAGE" takes.
using NamesOf = std::function<std::vector<Suggestion>(const std::string& place)>;

/// What may stand for the last of `words`, which may be empty and of which the others are complete, behind the name of
/// the program. Known from the commands and options themselves: whatever they accept is offered.
NextWords next_words(const CLI::App& program, const std::vector<std::string>& words, const NamesOf& names);

}  // namespace dynlab::inline cli
