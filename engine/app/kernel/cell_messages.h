#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "data_io/values/described.h"

namespace dynlab::inline app {

/// What the process that runs a notebook's cells is asked.
struct CellOrder {
    std::string kind;        ///< "run", "complete" (the text before the cursor), "inspect"
    std::string code;        ///< of the cell
    std::int64_t count = 0;  ///< the cell's number: [3]
    std::size_t cursor = 0;  ///< inspect: a byte of the code
};

/// A message from the cell process; the last one of an order is "done".
struct CellNews {
    /// "begun": from here on it can be interrupted; "print": `text`; "display", "result": `data`; "progress"; "failed":
    /// `text` and `lines`; "done": with what was asked for.
    std::string kind;
    std::string text = {};
    std::string data = {};                ///< JSON of what is shown, by type
    std::vector<std::string> lines = {};  ///< of an error; the words that complete the text
    bool interrupted = false;             ///< that is why it failed
    std::size_t typed = 0;                ///< bytes before the cursor that the words begin with
    double progress = 0;                  ///< from 0 to 1; below 0: it is over
    std::int64_t process = 0;             ///< number of one that was started
};

DYNLAB_DESCRIBE(CellOrder, kind, code, count, cursor)
DYNLAB_DESCRIBE(CellNews, kind, text, data, lines, interrupted, typed, progress, process)

}  // namespace dynlab::inline app
