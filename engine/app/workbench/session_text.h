#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/workbench/session_script.h"
#include "base/message.h"

namespace dynlab::inline app {

/// What a page asks to be done with a session's script.
struct ScriptOrder {
    std::size_t revision = 0;     ///< that the page shows
    std::vector<LineEdit> edits;  ///< of that revision
    bool whole = false;           ///< `text` is the whole script, instead of edits
    std::string text;
    bool goes_on = false;  ///< with what the order before did, a slider that is dragged: one step of the history
    bool unsaved = false;  ///< the slider is still held: the file follows when it is let go
};
DYNLAB_DESCRIBE(ScriptOrder, revision, edits, whole, text, goes_on, unsaved)

/// The text of a session's script, its file and its history. For one thread at a time.
class SessionText {
  public:
    /// Of a file that is there, or comes with the first text that is put. Throws EnvironmentError where it cannot be
    /// read.
    /// `past` is that of an earlier session of the file, as past() gives it.
    explicit SessionText(std::filesystem::path file, std::vector<std::string> past = {});
    /// The texts before this one, oldest first, to which undo() goes back.
    const std::vector<std::string>& past() const { return past_; }

    const std::filesystem::path& file() const { return file_; }
    const std::string& text() const { return text_; }
    std::size_t revision() const { return revision_; }
    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }

    /// Why the file is behind the text, since it could not be written; empty when it is not. The next save tries again.
    const Message& unsaved() const { return unsaved_; }

    /// False when the order was made from another revision, or the file holds what another program wrote, which is
    /// taken first: nothing is done then. Throws ValueError (with_edits()), and as take_from_file() and for a text
    /// that is too long for a script.
    bool obey(const ScriptOrder& order);
    void put(const std::string& text);  ///< as a step of the history
    /// Undoes or redoes one step; each text that another program wrote meanwhile is a separate step. Both throw as
    /// take_from_file() does.
    void undo();
    void redo();
    bool save();  ///< what is not on disk yet; whether there was something, and it is there now
    /// Takes what another program wrote into the file; true when that is another text, and not none: editors that write
    /// in place empty the file first. Throws DocumentError and EnvironmentError where that cannot be read.
    bool read_changed_file();
    /// The same before the text is written. A file that cannot be read is nothing then: whether it can be written, the
    /// save says. Throws DocumentError where what it holds is no script.
    void take_from_file();

  private:
    /// Up to 0.3 s while the file is empty. An editor that empties it and then writes in place would write into a file
    /// that a save between the two has replaced, and its text would be lost.
    void wait_for_editor() const;
    void change(std::string text, bool goes_on);

    std::filesystem::path file_;
    std::string text_, saved_;
    Message unsaved_;
    std::vector<std::string> past_, future_;
    std::size_t revision_ = 1;
};

}  // namespace dynlab::inline app
