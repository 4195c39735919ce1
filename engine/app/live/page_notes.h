#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "data_io/values/described.h"

namespace dynlab::inline app {

/// One thing that a page keeps for its next visit.
struct PageNote {
    std::string name, text;  ///< an empty text removes the note
    std::int64_t at = 0;     ///< the page's clock, ms: requests may overtake one another
};

template <Is<PageNote> T, class V>
void describe(T& object, V& member) {
    auto& [name, text, at] = object;
    member("name", name), member("text", text), member("at", at);
}

/// What the page of one document keeps for its next visit: unsaved drafts, a choice. The browser cannot keep it, since
/// each start of a server is another site to it (app/server/entrance.h). A file with mode 0600 below
/// $XDG_STATE_HOME/dynlab/pages. For any thread.
class PageNotes {
  public:
    explicit PageNotes(const std::filesystem::path& document);

    std::map<std::string, std::string> read() const;

    /// Writes the file whole or not at all; a note that is older than the last one of its name is passed over. Throws
    /// EnvironmentError where the file cannot be written, and for more than 8 MB of notes.
    void put(const PageNote& note);

  private:
    std::filesystem::path file_;  ///< empty where no state folder is known
    std::map<std::string, std::int64_t> last_;
    mutable std::mutex mutex_;
};

}  // namespace dynlab::inline app
