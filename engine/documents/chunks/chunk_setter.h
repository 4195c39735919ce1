#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "documents/chunks/chunks.h"
#include "documents/document.h"

namespace dynlab::inline documents {

/// A picture on a page: its name in the HTML, and the figure of the run or the file that it shows.
struct SetPicture {
    std::string written_name;
    bool is_figure = false;
    std::string name;            ///< of the figure
    std::filesystem::path file;  ///< of any other picture; it may not be there yet
};

/// What one chunk looks like on a page.
struct SetChunk {
    Chunk chunk;
    std::string html;
    std::vector<SetPicture> pictures;
};

/// A document for a page that follows its source.
struct SetDocument {
    std::string head;  ///< title and what belongs to it, HTML
    std::vector<SetChunk> chunks;
    std::string notes;                ///< footnotes, HTML
    std::vector<Message> complaints;  ///< what is wrong with it, "file:line: sentence"
};

/// Converts a document to HTML repeatedly. Unchanged chunks are not converted again, and the next Pandoc process is
/// started in advance. Numbers and references are those of the complete document: if a change moves them, the complete
/// document is converted. Errors are reported, and the rest of the document is still converted.
class ChunkSetter {
  public:
    /// What points to nothing is shown as a bold ?? where the documents are `drafts`, and is no complaint.
    explicit ChunkSetter(bool drafts = false);
    ~ChunkSetter();
    /// If the run is `unfinished`, slots without an entry say so. Throws DocumentError if Pandoc returns nothing and
    /// for text that prepared_text refuses, MissingProgram for pandoc.
    SetDocument set(const DocumentSource& source, bool unfinished);
    std::size_t chunks_set() const { return chunks_set_; }  ///< by the last call

    struct Memory;

  private:
    bool drafts_;
    std::unique_ptr<Memory> memory_;
    std::size_t chunks_set_ = 0;
};

}  // namespace dynlab::inline documents
