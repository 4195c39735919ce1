#pragma once
#include <string>
#include <vector>

#include "base/message.h"
#include "documents/run_record.h"

namespace dynlab::inline documents {

/// Entries of one kind that a script reported and no slot of the document shows.
struct UnplacedEntries {
    enum class Kind { kFigure, kTable, kText, kValue };
    Kind kind = Kind::kFigure;
    std::vector<std::string> names;  ///< at least one

    MessageList quoted_names() const;
    std::string slot() const;  ///< for the first; of tables and texts, the line that begins the block
    Message message() const;   ///< with the line to write for the first
};

/// `markdown`: all text of the document, template and text cells.
std::vector<UnplacedEntries> unplaced_entries(const RunRecord& record, const std::string& markdown);

/// A document's text with the captions, texts and cells of the script that it shows: they may hold slots themselves.
std::string with_texts_of_script(const RunRecord& record, const std::string& markdown);

}  // namespace dynlab::inline documents
