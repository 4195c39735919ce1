#include "documents/chunks/chunk_setter.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <map>
#include <optional>
#include <set>

#include "documents/error.h"
#include "documents/pandoc.h"
#include "documents/pictures.h"
#include "documents/text_lines.h"
#include "documents/unplaced_entries.h"
#include "documents/words/characters.h"
#include "platform/files/inside_folder.h"
#include "platform/hash.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;

const std::string kPicturePrefix = "dynlab-picture-";
const std::string kChunkBegins = "<div id=\"chunk-";
using Labels = std::map<std::string, std::string>;

/// Adds the run results that a text shows: the entries whose names occur in it.
void add_entries(const RunRecord& record, const std::string& markdown, DigestStream& digest) {
    const auto shows = [&](const std::string& name) { return markdown.find(name) != std::string::npos; };
    for (const auto& [name, value] : record.values)
        if (shows(name)) digest.add_part(name).add_part(value.text);
    for (const auto& [name, text] : record.texts)
        if (shows(name)) digest.add_part(name).add_part(text.markdown);
    for (const auto& [name, figure] : record.figures)
        if (shows(name)) digest.add_part(name).add_part(figure.caption);
    for (const auto& [name, table] : record.tables) {
        if (!shows(name)) continue;
        digest.add_part(name);
        for (const std::string& cell : table.header) digest.add_part(cell);
        for (const auto& row : table.rows)
            for (const std::string& cell : row) digest.add_part(cell);
    }
}

/// Whether the chunk has a slot that the run results do not fill.
bool lacks_entry(const RunRecord& record, const std::string& markdown) {
    static const RE2 kSlot(R"(`([\w-]+)`\{\.value\}|\(figure:([\w-]+)\)|\{\.(?:table|text) [^}]*name=([\w-]+))",
                           RE2::Latin1);
    std::string value, figure, block;
    for (re2::StringPiece rest = markdown; RE2::FindAndConsume(&rest, kSlot, &value, &figure, &block);) {
        const std::string name = value + figure + block;
        if (!record.values.contains(name) && !record.figures.contains(name) && !record.tables.contains(name) &&
            !record.texts.contains(name))
            return true;
    }
    return false;
}

/// Whether the text adds something at the end of the page: notes or literature.
bool has_notes(const std::string& markdown) {
    static const RE2 kReference("@([A-Za-z_]+:?)", RE2::Latin1);
    static const std::set<std::string> kOfLabels = {"fig:", "tbl:", "eq:", "sec:"};
    std::string begin;
    for (re2::StringPiece rest = markdown; RE2::FindAndConsume(&rest, kReference, &begin);)
        if (!kOfLabels.contains(begin)) return true;
    return markdown.find("[^") != std::string::npos || markdown.find("^[") != std::string::npos;
}

/// Between two marks; nothing when either is missing.
std::optional<std::string> between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t first = text.find(begin);
    const std::size_t last = text.rfind(end);
    if (first == std::string::npos || last == std::string::npos || last < first + begin.size()) return {};
    return text.substr(first + begin.size(), last - first - begin.size());
}

/// Behind the end of the division that begins at `begin`.
std::size_t end_of_division(const std::string& html, std::size_t begin) {
    const std::string opens = "<div", closes = "</div>";
    int depth = 0;
    for (std::size_t at = begin; at != std::string::npos;) {
        const std::size_t open = html.find(opens, at), close = html.find(closes, at);
        if (close == std::string::npos) break;
        depth += open < close ? 1 : -1;
        at = open < close ? open + opens.size() : close + closes.size();
        if (depth == 0) return at;
    }
    return html.size();
}

}  // namespace

/// What the last call left, and the Pandoc that waits for the next.
struct ChunkSetter::Memory {
    /// A chunk that was set, and the counts it began and ended with.
    struct KnownChunk {
        std::string key, html;
        std::vector<SetPicture> pictures;
        Counts begin{}, end{};
        Labels labels;
        bool has_notes = false;
    };

    TemporaryFolder folder;
    std::optional<ChildProcess> warm;
    std::string warm_bibliography;
    std::string whole;  ///< what all chunks depend on: metadata, rules, whether the run has ended
    std::vector<KnownChunk> chunks;
    std::string head, notes;
    bool complained = false;
};

namespace {

using KnownChunk = ChunkSetter::Memory::KnownChunk;

/// One document to be set, next to what is known of the one before.
class ChunkJob {
  public:
    ChunkJob(const DocumentSource& source, bool unfinished, bool draft, ChunkSetter::Memory& memory)
        : source_(source),
          text_(prepared_text(source)),
          record_(*source.record),
          unfinished_(unfinished),
          draft_(draft),
          memory_(memory) {
        for (Chunk& chunk : chunks_of(text_.markdown)) {
            DigestStream digest;
            digest.add_part(chunk.markdown);
            const std::string shown = with_texts_of_script(record_, chunk.markdown);
            add_entries(record_, shown, digest);
            if (lacks_entry(record_, shown)) digest.add_part(unfinished ? "not yet" : "missing");
            set_.push_back({digest.digest().hex(), {}, {}, {}, {}, {}, has_notes(chunk.markdown)});
            chunks_.push_back(std::move(chunk));
        }
        bibliography_ = placed_bibliography(source, text_, memory.folder.path(), complaints_);
        DigestStream whole;
        for (const auto& [key, value] : text_.metadata) whole.add_part(key).add_part(value);
        whole.add_part(source.template_file.string()).add_part(bibliography_);
        if (!bibliography_.empty()) whole.add_file(memory.folder.path() / bibliography_);
        whole_ = whole.digest().hex();
    }

    SetDocument set(std::size_t& count) {
        std::vector<bool> requested = changed();
        if (!set_wanted(requested) || !agrees_with_known()) {
            requested.assign(chunks_.size(), true);
            whole_document_ = true;
            set_wanted(requested);
        }
        count = static_cast<std::size_t>(std::count(requested.begin(), requested.end(), true));
        return result();
    }

    /// Starts the next Pandoc early, while no request waits.
    void warm_up() const {
        memory_.warm.emplace(start_pandoc(job({})));
        memory_.warm_bibliography = bibliography_;
    }

  private:
    /// Which chunks are not as they were; those that are get what is known of them.
    std::vector<bool> changed() {
        const bool known = !memory_.chunks.empty() && !memory_.complained && memory_.whole == whole_;
        whole_document_ = !known;
        std::vector<bool> requested(chunks_.size(), true);
        if (!known) return requested;
        std::multimap<std::string, const KnownChunk*> before;
        for (const KnownChunk& chunk : memory_.chunks) before.emplace(chunk.key, &chunk);
        for (std::size_t i = 0; i < set_.size(); ++i) {
            const auto same = before.find(set_[i].key);
            if (same == before.end()) {
                whole_document_ = whole_document_ || set_[i].has_notes;
                continue;
            }
            set_[i] = *same->second;
            before.erase(same);
            requested[i] = false;
        }
        for (const auto& [key, gone] : before) whole_document_ = whole_document_ || gone->has_notes;
        if (whole_document_) requested.assign(chunks_.size(), true);
        return requested;
    }

    /// Sets the wanted chunks; false where the numbers of the others are no longer right.
    bool set_wanted(const std::vector<bool>& requested) {
        MarkdownText text;
        ChunkSurroundings around;
        bool any = false;
        for (std::size_t i = 0; i < chunks_.size(); ++i) {
            if (!requested[i]) {
                around.labels.insert(set_[i].labels.begin(), set_[i].labels.end());
                continue;
            }
            any = true;
            if (i > 0 && !requested[i - 1]) around.counts[static_cast<int>(i)] = set_[i - 1].end;
            append(chunks_[i], i, text);
        }
        if (!any) return true;
        run(text, around, requested);
        for (std::size_t i = 1; i < chunks_.size(); ++i)
            if (!requested[i] && set_[i].begin != set_[i - 1].end) return false;
        return true;
    }

    void append(const Chunk& chunk, std::size_t number, MarkdownText& text) const {
        const std::string fence(longest_colons(chunk.markdown) + 1, ':');
        text.append(fmt::format("{} {{.chunk number={}}}\n", fence, number), chunk.origin.file, chunk.origin.line);
        int line = chunk.first_line;
        for (const std::string& content : lines_of(chunk.markdown)) {
            const Place origin = text_.markdown.origin_of(line++);
            text.append(content + "\n", origin.file, origin.line);
        }
        text.append("\n" + fence + "\n\n", chunk.origin.file, chunk.origin.line);
    }

    static std::size_t longest_colons(const std::string& text) {
        std::size_t longest = 2, run = 0;
        for (char c : text) {
            run = c == ':' ? run + 1 : 0;
            longest = std::max(longest, run);
        }
        return longest;
    }

    PandocJob job(const MarkdownText& text) const {
        PandocJob job;
        job.markdown = text;
        job.metadata = text_.metadata;
        job.rules = text_.rules;
        job.language = text_.language;
        job.record = &record_;
        job.format = DocumentFormat::kHtml;
        job.template_file = source_.template_file;
        job.shared_templates = shared_folder() / "report_templates";
        job.picture_prefix = kPicturePrefix;
        job.work_folder = memory_.folder.path();
        job.bibliography = bibliography_;
        job.measures = source_.measures;
        job.names_values = source_.names_values;
        job.unfinished = unfinished_ || record_.error;
        job.draft = draft_;
        job.chunks.emplace();
        return job;
    }

    void run(const MarkdownText& text, const ChunkSurroundings& around, const std::vector<bool>& requested) {
        PandocJob next = job(text);
        next.chunks = around;
        if (memory_.warm && memory_.warm_bibliography == bibliography_) next.started = &*memory_.warm;
        Complaints complaints = complaints_;
        check_characters(text, complaints);
        const PandocResult page = run_pandoc(next, complaints);
        memory_.warm.reset();
        if (page.text.empty()) complaints.throw_if_any();
        const auto files = find_picture_files(page.pictures, text, source_.template_file, DocumentFormat::kHtml,
                                              kPicturePrefix, complaints);
        complained_ = complaints.messages();
        take_apart(page, files, requested);
    }

    void check_characters(const MarkdownText& text, Complaints& complaints) const {
        const PrintableCharacters printable = PrintableCharacters::of_html();
        int number = 0;
        for (const std::string& line : lines_of(text.text)) {
            ++number;
            if (const auto sentence = printable.complaint(line)) complaints.add(text.origin_of(number), *sentence);
        }
    }

    /// Cuts the page where chunks begin: `<div id="chunk-` is nothing that a document can contain.
    void take_apart(const PandocResult& page, const std::vector<PlacedPicture>& files,
                    const std::vector<bool>& requested) {
        std::string body = between(page.text, "<main>\n", "</main>").value_or("");
        if (whole_document_) {
            memory_.head = between(page.text, "<body>\n", "<main>").value_or("");
            // After the last chunk: notes, and literature without a place in the text.
            const std::size_t last = body.rfind(kChunkBegins);
            memory_.notes = last == std::string::npos ? body : body.substr(end_of_division(body, last));
            if (is_blank(memory_.notes)) memory_.notes.clear();
        }
        std::size_t begin = body.find(kChunkBegins);
        for (std::size_t i = 0; i < chunks_.size() && begin != std::string::npos; ++i) {
            if (!requested[i]) continue;
            const std::size_t end = end_of_division(body, begin);
            fill(i, body.substr(begin, end - begin), page, files);
            begin = body.find(kChunkBegins, end);
        }
    }

    void fill(std::size_t i, const std::string& division, const PandocResult& page,
              const std::vector<PlacedPicture>& files) {
        KnownChunk& chunk = set_[i];
        const std::size_t begin = division.find('>') + 1, end = division.rfind("</div>");
        chunk.html = end == std::string::npos || end < begin ? "" : trimmed(division.substr(begin, end - begin));
        chunk.pictures.clear();
        for (const UsedPicture& used : page.pictures) {
            const std::string written = fmt::format("{}{}.", kPicturePrefix, used.number);
            const std::size_t at = chunk.html.find(written);
            if (at == std::string::npos) continue;
            SetPicture picture{chunk.html.substr(at, chunk.html.find('"', at) - at), used.is_figure, used.name, {}};
            for (const PlacedPicture& placed : files)
                if (placed.written_name == picture.written_name) picture.file = placed.file;
            const fs::path folder = folder_around(chunks_[i].origin.file),
                           candidate = folder / path_of_picture(used.name);
            if (!used.is_figure && picture.file.empty() && is_inside(candidate, folder)) picture.file = candidate;
            chunk.pictures.push_back(std::move(picture));
        }
        const int number = static_cast<int>(i);
        const auto counts = [&](const std::map<int, Counts>& known) {
            const auto found = known.find(number);
            return found == known.end() ? Counts{} : found->second;
        };
        chunk.begin = counts(page.chunks.begin);
        chunk.end = counts(page.chunks.end);
        const auto labels = page.chunks.labels.find(number);
        chunk.labels = labels == page.chunks.labels.end() ? Labels{} : labels->second;
    }

    static Labels all_labels(const std::vector<KnownChunk>& chunks) {
        Labels labels;
        for (const KnownChunk& chunk : chunks) labels.insert(chunk.labels.begin(), chunk.labels.end());
        return labels;
    }

    /// References of chunks that were not set now show what they showed.
    bool agrees_with_known() const { return whole_document_ || all_labels(set_) == all_labels(memory_.chunks); }

    SetDocument result() {
        SetDocument document{memory_.head, {}, memory_.notes, complained_};
        for (std::size_t i = 0; i < chunks_.size(); ++i)
            document.chunks.push_back({std::move(chunks_[i]), set_[i].html, set_[i].pictures});
        memory_.chunks = std::move(set_);
        memory_.whole = whole_;
        memory_.complained = !complained_.empty();
        return document;
    }

    const DocumentSource& source_;
    const PreparedText text_;
    const RunRecord& record_;
    const bool unfinished_, draft_;
    ChunkSetter::Memory& memory_;
    std::string whole_;
    bool whole_document_ = false;
    std::vector<Chunk> chunks_;
    std::vector<KnownChunk> set_;  ///< beside chunks_
    std::string bibliography_;
    Complaints complaints_;  ///< of the document as a whole
    std::vector<Message> complained_;
};

}  // namespace

ChunkSetter::ChunkSetter(bool drafts) : drafts_(drafts), memory_(std::make_unique<Memory>()) {}
ChunkSetter::~ChunkSetter() = default;

SetDocument ChunkSetter::set(const DocumentSource& source, bool unfinished) {
    ChunkJob job(source, unfinished, drafts_, *memory_);
    SetDocument document = job.set(chunks_set_);
    job.warm_up();
    return document;
}

}  // namespace dynlab::inline documents
