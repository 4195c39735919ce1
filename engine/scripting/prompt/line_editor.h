#pragma once
#include <functional>
#include <memory>
#include <string>

#include "scripting/prompt/command_history.h"
#include "scripting/prompt/completion.h"

namespace dynlab::inline scripting {

/// Reads lines from the terminal with editing, history and completion (libedit). The terminal is in its usual mode
/// whenever read() does not run, after every signal that ends the program too.
class LineEditor {
  public:
    /// `complete` gets the line up to the cursor.
    LineEditor(CommandHistory& history, std::function<Completion(const std::string&)> complete);
    ~LineEditor();
    LineEditor(const LineEditor&) = delete;
    LineEditor& operator=(const LineEditor&) = delete;

    struct Line {
        enum class Ending {
            kEntered,
            kGivenUp,  ///< Ctrl-C
            kLeft,     ///< Ctrl-D, or the terminal is gone
        };
        Ending ending;
        std::string text;
        bool more_follows = false;  ///< further text is there already: the line was pasted, not typed
    };
    Line read(const std::string& prompt);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace dynlab::inline scripting
