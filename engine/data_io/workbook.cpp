#include "data_io/workbook.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <pugixml.hpp>
#include <utility>

#include "data_io/reading_memory.h"
#include "data_io/values/cbor_values.h"
#include "data_io/values/described.h"
#include "data_io/values/message_values.h"
#include "platform/atomic_file.h"
#include "platform/confinement.h"
#include "platform/error.h"
#include "platform/guarded_call.h"
#include "platform/text/read_number.h"
#include "platform/utf8_locale.h"

namespace dynlab::inline data_io {

DYNLAB_DESCRIBE(SheetText, csv, sheets)

namespace {

constexpr std::size_t kSmallestSheet = std::size_t{64} << 20;  // as text; where the file is larger, its size
constexpr int kMaxParts = 10000;
constexpr std::size_t kMaxRowCount = 1048576, kMaxSheetColumns = 16384;  // of the format

/// A sheet as it comes from a guarded copy.
struct SheetOutcome {
    SheetText sheet;
    Message refusal = {};  ///< why nothing was read
};

DYNLAB_DESCRIBE(SheetOutcome, sheet, refusal)

/// The parts of the workbook that matter.
struct WorkbookParts {
    std::string file;  ///< for messages
    std::map<std::string, std::string> by_path = {};
};

[[noreturn]] void fail_as_no_archive(const std::string& file) {
    throw EnvironmentError("{} is not a workbook (.xlsx): it is not a zip archive", file);
}

bool is_requested(std::string_view path) {
    return path.ends_with(".xml") || path.ends_with(".rels");
}

WorkbookParts unpacked(const std::string& file, const std::string& bytes) {
    const Utf8Locale names_are_utf8;
    const std::unique_ptr<archive, int (*)(archive*)> zip(::archive_read_new(), ::archive_read_free);
    if (!zip || ::archive_read_support_format_zip(zip.get()) != ARCHIVE_OK ||
        ::archive_read_open_memory(zip.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
        fail_as_no_archive(file);
    WorkbookParts parts{file};
    const std::size_t limit = memory_for_reading(bytes.size()) / 2;
    std::size_t total = 0;
    archive_entry* entry = nullptr;
    int result = ARCHIVE_OK;
    for (int count = 0; (result = ::archive_read_next_header(zip.get(), &entry)) == ARCHIVE_OK; ++count) {
        if (count == kMaxParts)
            throw EnvironmentError("{} has more than {} parts; save the sheet as CSV", file, kMaxParts);
        const char* path = ::archive_entry_pathname(entry);
        if (path == nullptr || !is_requested(path)) continue;
        std::string& part = parts.by_path[path];
        part.clear();
        char block[65536];
        la_ssize_t size = 0;
        while ((size = ::archive_read_data(zip.get(), block, sizeof block)) > 0) {
            total += static_cast<std::size_t>(size);
            if (total > limit)
                throw EnvironmentError("{} is larger than {} MB when unpacked; save the sheet as CSV", file,
                                       limit >> 20);
            part.append(block, static_cast<std::size_t>(size));
        }
        if (size < 0) throw EnvironmentError("{} is damaged: one of its parts cannot be unpacked", file);
    }
    if (result != ARCHIVE_EOF && parts.by_path.empty()) fail_as_no_archive(file);
    if (result != ARCHIVE_EOF)
        throw EnvironmentError("{} is damaged: it is truncated, or is not a valid zip archive", file);
    return parts;
}

std::string_view local_name(std::string_view whole) {
    return whole.substr(whole.find(':') == std::string_view::npos ? 0 : whole.find(':') + 1);
}

/// The first child of that name, whatever its namespace's prefix.
pugi::xml_node child_of(const pugi::xml_node& node, std::string_view name) {
    return node.find_child([name](const pugi::xml_node& child) { return local_name(child.name()) == name; });
}

std::string attribute_of(const pugi::xml_node& node, std::string_view name) {
    return node.find_attribute([name](const pugi::xml_attribute& a) { return local_name(a.name()) == name; }).value();
}

/// One of them, taken out.
struct WorkbookPart {
    std::string file, path;  ///< for messages
    std::string text;
};

WorkbookPart taken(WorkbookParts& parts, const std::string& path) {
    const auto part = parts.by_path.extract(path);
    if (part.empty())
        throw EnvironmentError("{} is damaged or is not a workbook: its part {} is missing", parts.file, path);
    return {parts.file, path, std::move(part.mapped())};
}

constexpr unsigned kParsing = pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol | pugi::parse_ws_pcdata_single;

/// pugixml knows XML's own five entities and character references; it reads no document type. `text` begins at byte
/// `at` of the part.
pugi::xml_document parsed(const WorkbookPart& part, std::string_view text, unsigned options = kParsing,
                          std::size_t at = 0) {
    pugi::xml_document document;
    const auto result = document.load_buffer(text.data(), text.size(), options);
    if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
    if (!result)
        throw EnvironmentError("{} is damaged: {} at byte {} of its part {}", part.file, result.description(),
                               at + static_cast<std::size_t>(result.offset), part.path);
    return document;
}

pugi::xml_document part_document(WorkbookParts& parts, const std::string& path) {
    const WorkbookPart part = taken(parts, path);
    return parsed(part, part.text);
}

/// Behind the next end tag of that name, whatever its namespace's prefix; npos where there is none.
std::size_t behind_end_tag(std::string_view text, std::string_view name, std::size_t from) {
    const std::string end = std::string(name) + ">";
    for (std::size_t at = text.find(end, from); at != text.npos; at = text.find(end, at + 1)) {
        const std::size_t open = text.rfind('<', at);
        if (open == text.npos || text.substr(open, 2) != "</") continue;
        if (open + 2 == at || text[at - 1] == ':') return at + end.size();
    }
    return text.npos;
}

/// The bytes between an element's tags: where they begin and where they end, with the end tag for it.
std::optional<std::pair<std::size_t, std::size_t>> content_of(std::string_view text, std::string_view name) {
    for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
        const std::size_t open = text.rfind('<', at), close = text.find('>', at);
        if (open == text.npos || close == text.npos) return {};
        const std::string_view tag = text.substr(open + 1, close - open - 1);
        if (local_name(tag.substr(0, tag.find_first_of(" \t\r\n/"))) != name) continue;
        const std::size_t end = behind_end_tag(text, name, close);
        if (tag.ends_with('/') || end == text.npos) return {};
        return std::pair(close + 1, text.rfind('<', end - 1));
    }
    return {};
}

/// Calls `use` with each element `name` of the element `list`. It parses a piece at a time, as the tree of a whole
/// sheet takes several times the memory of the sheet.
template <class Use>
void for_each_element(const WorkbookPart& part, std::string_view list, std::string_view name, Use use) {
    const std::string_view text = part.text;
    constexpr std::size_t kPiece = std::size_t{1} << 18;
    const auto use_children = [&](const pugi::xml_node& parent) {
        for (const pugi::xml_node& child : parent.children())
            if (local_name(child.name()) == name) use(child);
    };
    const auto content = content_of(text, list);
    if (!content) {  // it is empty, or written in another way than programs do
        const pugi::xml_document document = parsed(part, text);
        const pugi::xml_node root = document.document_element();
        use_children(local_name(root.name()) == list ? root : child_of(root, list));
        return;
    }
    const auto [begin, end] = *content;
    for (std::size_t at = begin, next = 0; at < end; at = next) {
        next = std::min(behind_end_tag(text, name, std::min(at + kPiece, end)), end);
        use_children(parsed(part, text.substr(at, next - at), kParsing | pugi::parse_fragment, at));
    }
}

/// Path of a part that another one names: from the root, or beside it.
std::string part_path(const std::string& target) {
    if (target.starts_with("/")) return target.substr(1);
    return "xl/" + target;
}

/// The text of a string item: its runs joined, phonetic hints left out.
std::string item_text(const pugi::xml_node& item) {
    std::string text;
    for (const pugi::xml_node& child : item.children()) {
        const std::string_view name = local_name(child.name());
        if (name == "t") text += child.text().get();
        if (name == "r") text += child_of(child, "t").text().get();
    }
    return text;
}

std::vector<std::string> shared_texts(WorkbookParts& parts) {
    std::vector<std::string> texts;
    const std::string path = "xl/sharedStrings.xml";
    if (!parts.by_path.contains(path)) return texts;
    for_each_element(taken(parts, path), "sst", "si",
                     [&](const pugi::xml_node& item) { texts.push_back(item_text(item)); });
    return texts;
}

std::string in_quotes(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text)
        if (c == '"')
            quoted += "\"\"";
        else
            quoted += c == '\n' || c == '\r' || c == '\0' ? ' ' : c;  // a row stays one line
    return quoted + '"';
}

std::string number_or_text(const std::string& value) {
    const bool plain = !value.empty() && value.find_first_not_of("0123456789+-.eE") == std::string::npos;
    return plain || value.empty() ? value : in_quotes(value);
}

class SheetReader {
  public:
    SheetReader(const std::string& file, std::vector<std::string> texts, std::size_t max_bytes)
        : file_(file), texts_(std::move(texts)), max_bytes_(max_bytes) {}

    void add_row(const pugi::xml_node& row) {
        const std::string stated = attribute_of(row, "r");
        const std::size_t before = rows_.empty() ? 0 : rows_.back().number;
        const std::size_t number = stated.empty() ? before + 1 : whole_number(stated);
        if (number <= before || number > kMaxRowCount)
            throw EnvironmentError("{} is damaged: its rows are out of order", file_);
        std::map<std::size_t, std::string> cells;  // by column, from 0
        std::size_t next = 0;
        for (const pugi::xml_node& cell : row.children()) {
            if (local_name(cell.name()) != "c") continue;
            const std::string place = attribute_of(cell, "r");
            const std::size_t column = place.empty() ? next : column_of(place);
            if (column >= kMaxSheetColumns)
                throw EnvironmentError("{} is damaged: a cell is beyond the last column", file_);
            std::string text = cell_text(cell);
            if (!text.empty()) cells[column] = std::move(text);
            next = column + 1;
        }
        Row& added = rows_.emplace_back(Row{number, 0, {}});
        for (const auto& [column, text] : cells) {
            added.text.append(added.width == 0 ? column : column + 1 - added.width, ',');
            added.text += text;
            added.width = column + 1;
        }
        bytes_ += number - before + added.text.size();
        if (bytes_ > max_bytes_) fail_large();
    }

    /// Of all rows. Takes them out.
    std::string csv() {
        std::size_t width = 0;
        for (const Row& row : rows_) width = std::max(width, row.width);
        if (bytes_ + width * rows_.size() > max_bytes_) fail_large();
        std::string text;
        std::size_t line = 1;
        for (Row& row : rows_) {
            text.append(row.number - line, '\n');
            line = row.number + 1;
            text += std::exchange(row.text, {});
            if (row.width > 0) text.append(width - row.width, ',');
            text += '\n';
        }
        return text;
    }

  private:
    struct Row {
        std::size_t number, width;  ///< from 1; cells up to the last that is not empty
        std::string text;
    };

    [[noreturn]] void fail_large() const {
        throw EnvironmentError("{} has a sheet larger than {} MB; save the sheet as CSV", file_, max_bytes_ >> 20);
    }

    std::size_t whole_number(const std::string& text) const {
        if (const auto number = read_number<std::size_t>(text)) return *number;
        throw EnvironmentError("{} is damaged: expected a whole number, got \"{}\"", file_, text.substr(0, 20));
    }

    /// 0 for A5, 26 for AA5.
    std::size_t column_of(const std::string& place) const {
        std::size_t column = 0;
        for (const char c : place) {
            if (c < 'A' || c > 'Z' || column > kMaxSheetColumns) break;
            column = column * 26 + static_cast<std::size_t>(c - 'A' + 1);
        }
        if (column == 0)
            throw EnvironmentError("{} is damaged: \"{}\" is not a valid cell reference", file_, place.substr(0, 20));
        return column - 1;
    }

    std::string cell_text(const pugi::xml_node& cell) const {
        const std::string type = attribute_of(cell, "t");
        if (type == "inlineStr") return in_quotes(item_text(child_of(cell, "is")));
        const std::string value = child_of(cell, "v").text().get();
        if (type == "s") {
            const std::size_t index = whole_number(value);
            if (index >= texts_.size())
                throw EnvironmentError("{} is damaged: a cell refers to a missing string", file_);
            return texts_[index].empty() ? "" : in_quotes(texts_[index]);
        }
        if (type == "str" || type == "e" || type == "d") return value.empty() ? "" : in_quotes(value);
        return number_or_text(value);
    }

    const std::string& file_;
    std::vector<std::string> texts_;
    std::size_t max_bytes_, bytes_ = 0;  ///< of the sheet as text
    std::vector<Row> rows_;
};

SheetText sheet_of(const std::string& file, const std::string& bytes, const std::string& requested) {
    WorkbookParts parts = unpacked(file, bytes);
    const pugi::xml_document workbook = part_document(parts, "xl/workbook.xml");
    const pugi::xml_document relations = part_document(parts, "xl/_rels/workbook.xml.rels");
    SheetText text;
    std::string relation;
    for (const pugi::xml_node& sheet : child_of(workbook.document_element(), "sheets").children()) {
        text.sheets.push_back(attribute_of(sheet, "name"));
        if (relation.empty() && (requested.empty() || text.sheets.back() == requested))
            relation = attribute_of(sheet, "id");
    }
    if (relation.empty())
        throw EnvironmentError("{} has no sheet \"{}\"; the sheets are {}", file, requested, listed(text.sheets));
    std::string path;
    for (const pugi::xml_node& entry : relations.document_element().children())
        if (attribute_of(entry, "Id") == relation) path = part_path(attribute_of(entry, "Target"));
    SheetReader reader(file, shared_texts(parts), std::max(kSmallestSheet, bytes.size()));
    for_each_element(taken(parts, path), "sheetData", "row", [&](const pugi::xml_node& row) { reader.add_row(row); });
    parts.by_path.clear();
    text.csv = reader.csv();
    return text;
}

}  // namespace

SheetText read_sheet(const std::filesystem::path& file, const std::string& sheet) {
    GuardLimits limits;
    limits.time.processor = std::chrono::seconds(20);
    const std::size_t bytes = bytes_of_file(file);
    limits.memory_bytes = limits.output_bytes = memory_for_reading(bytes);
    const std::string name = file.string();
    const auto read = [&file, &sheet, &name, bytes] {
        try {
            const std::string content = read_file(file);
            if (is_guarded_copy()) confine_to_memory();
            return cbor_of(SheetOutcome{sheet_of(name, content, sheet)});
        } catch (const EnvironmentError& error) {
            return cbor_of(SheetOutcome{{}, error.message()});
        } catch (const std::bad_alloc&) {
            const ReadingMegabytes megabytes = megabytes_for_reading(bytes);
            return cbor_of(SheetOutcome{{},
                                        Message("{}: reading it requires more than {} MB of memory, the limit for a "
                                                "file of {} MB; save the sheet as CSV",
                                                name, megabytes.limit, megabytes.of_file)});
        }
    };
    const ChildResult result = run_guarded(read, limits);
    if (result.timed_out)
        throw result.time_limit() == TimeLimit::kProcessor
            ? EnvironmentError("{}: reading used more than {} s of processor time; save the sheet as CSV", name,
                               limits.time.seconds(TimeLimit::kProcessor))
            : EnvironmentError("{}: reading did not finish within {} s; try again when the machine is less busy", name,
                               limits.time.seconds(TimeLimit::kClock));
    if (result.exit_code == 1 && !result.error_output.empty()) throw EnvironmentError(result.error_output);
    if (result.exit_code != 0 || result.output_exceeded)
        throw EnvironmentError("{} is damaged: the reader crashed", name);
    SheetOutcome outcome = from_cbor<SheetOutcome>(result.output);
    if (!outcome.refusal.empty()) throw EnvironmentError(outcome.refusal);
    return std::move(outcome.sheet);
}

}  // namespace dynlab::inline data_io
