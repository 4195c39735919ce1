#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/message.h"
#include "data_io/values/described.h"
#include "data_io/values/message_values.h"
#include "documents/record_description.h"
#include "documents/run_record.h"

namespace dynlab::inline app {

/// The state of a cell of the script.
struct CellState {
    std::string state;    ///< "waiting", "running", "done", "recalled", "failed"
    double seconds = 0;   ///< that it took
    double progress = 0;  ///< of something long in a cell that runs, from 0 to 1
};
DYNLAB_DESCRIBE(CellState, state, seconds, progress)

/// A part of a page, and the line of the source that it comes from.
struct PagePiece {
    std::string id, cell, file;
    int line = 0;
};
DYNLAB_DESCRIBE(PagePiece, id, cell, file, line)

struct PagePicture {
    std::string type, bytes;
    std::uint64_t version = 0;  ///< of the page, in which it was shown last
};
DYNLAB_DESCRIBE(PagePicture, type, bytes, version)

/// What a document looks like on its page.
struct PageContent {
    std::string name, head, notes;  ///< of the file; title and footnotes, HTML
    std::vector<PagePiece> pieces;
    std::map<std::string, std::string> html;  ///< of the pieces, by id
    std::map<std::string, PagePicture> pictures;
    std::map<std::string, CellState> states;
    std::map<std::string, RecordedSlider> sliders;
    std::string open_answers;         ///< "G1 (model), gain (number)"
    std::vector<Message> complaints;  ///< what is wrong
};
DYNLAB_DESCRIBE(PageContent, name, head, notes, pieces, html, pictures, states, sliders, open_answers, complaints)

}  // namespace dynlab::inline app
