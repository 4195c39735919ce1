#include "app/live/page_notes.h"

#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/written_files.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{8} << 20;

using Notes = std::map<std::string, std::string>;

/// None where there is no file, or another than this class writes.
Notes notes_in(const fs::path& file) {
    try {
        return fs::is_regular_file(file) ? from_json<Notes>(read_text(file)) : Notes();
    } catch (const EnvironmentError&) {
        return {};
    }
}

}  // namespace

PageNotes::PageNotes(const fs::path& document) : file_(state_file("pages")) {
    if (!file_.empty()) file_ /= digest_of(fs::weakly_canonical(fs::absolute(document)).string()).hex() + ".json";
}

Notes PageNotes::read() const {
    const std::lock_guard lock(mutex_);
    return notes_in(file_);
}

void PageNotes::put(const PageNote& note) {
    const std::lock_guard lock(mutex_);
    if (file_.empty())
        throw EnvironmentError(
            "the drafts of this page cannot be stored, because neither HOME nor XDG_STATE_HOME is set. Set HOME");
    std::int64_t& last = last_[note.name];
    if (note.at < last) return;
    last = note.at;
    Notes notes = notes_in(file_);
    if (note.text.empty())
        notes.erase(note.name);
    else
        notes[note.name] = note.text;
    const std::string text = json_of(notes);
    if (text.size() > kMaxBytes)
        throw EnvironmentError("the drafts of a page exceed the limit of 8 MB; save or discard some of the drafts");
    fs::create_directories(file_.parent_path());
    fs::permissions(file_.parent_path(), fs::perms::owner_all);
    write_file_atomically(file_, text);
}

}  // namespace dynlab::inline app
