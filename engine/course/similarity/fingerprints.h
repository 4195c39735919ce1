#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace dynlab::inline course {

/// A short run of a script's tokens: its hash, and its lines.
struct Fingerprint {
    std::uint64_t hash = 0;
    int first_line = 1, last_line = 1;
};

/// The fingerprints of a Lua script in their order, by winnowing (Schleimer, Wilkerson & Aiken, SIGMOD 2003): of every
/// four successive runs of ten tokens the one with the least hash. Two scripts with thirteen equal tokens in a row have
/// one in common. Comments, white space, `local`, semicolons, and the values of numbers and texts do not count, nor do
/// names, but for those of the library's functions: renaming and another layout change nothing.
std::vector<Fingerprint> fingerprints(const std::string& script);

}  // namespace dynlab::inline course
