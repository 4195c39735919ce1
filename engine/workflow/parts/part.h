#pragma once
#include <cstddef>
#include <optional>
#include <set>
#include <string>

namespace dynlab::inline workflow {

/// A share of a list of work: every `count`-th entry, from the `index`-th on, so that neighbors, which take as long,
/// are spread.
struct WorkPart {
    int index = 1, count = 1;  ///< 1 to count, of at most kMax

    static constexpr int kMax = 1000;  // MaxArraySize as Slurm comes

    bool has(std::size_t place) const { return part_of(place) == index; }
    int part_of(std::size_t place) const { return 1 + static_cast<int>(place % static_cast<std::size_t>(count)); }
    std::string text() const { return std::to_string(index) + "/" + std::to_string(count); }
};

/// What is left to do of work in parts.
struct MissingParts {
    std::set<int> parts;   ///< that are not complete; none where all is done
    std::size_t call = 0;  ///< of a script with several calls, the one that they belong to
    bool operator==(const MissingParts&) const = default;
};

/// That of "3/8"; nothing for any other text.
std::optional<WorkPart> part_in(const std::string& text);

}  // namespace dynlab::inline workflow
