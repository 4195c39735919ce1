#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "data_io/values/described.h"

namespace dynlab::inline app {

/// A text that a page may change: a number for it, and the text it was when it was read.
struct SourceText {
    std::size_t number = 0;
    std::string name, text;
    std::string digest;      ///< of the text: who saves says what it was made from
    std::string place = {};  ///< the file, where the text is given
};

template <Is<SourceText> T, class V>
void describe(T& object, V& member) {
    auto& [number, name, text, digest, place] = object;
    member("number", number), member("name", name), member("text", text), member("digest", digest);
    member.unless_empty("place", place);
}

/// The texts of a document as an editor on the page reads and writes them. For any thread.
class SourceFiles {
  public:
    /// Those that this user may write; others are not offered.
    explicit SourceFiles(const std::vector<std::filesystem::path>& files);

    std::vector<SourceText> read() const;                ///< those that are there, and are text in UTF-8
    std::map<std::string, std::string> digests() const;  ///< by number, as the page's script counts them

    /// Writes the file completely or not at all. If the file has changed since `saved.digest`, nothing is written, and
    /// the outcome contains the current text of the file; otherwise it contains only the new digest. Throws
    /// EnvironmentError if the file cannot be written, and for a text that is not UTF-8.
    struct Outcome {
        bool written = false;
        SourceText now;
    };
    Outcome save(const SourceText& saved);

  private:
    std::optional<SourceText> read(std::size_t number) const;

    std::vector<std::filesystem::path> files_;
    mutable std::mutex mutex_;
};

}  // namespace dynlab::inline app
