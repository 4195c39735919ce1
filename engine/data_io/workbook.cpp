#include "data_io/workbook.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <map>
#include <memory>
#include <new>
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
constexpr int kMostParts = 10000;
constexpr std::size_t kMostRows = 1048576, kMostSheetColumns = 16384;  // of the format

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
    throw EnvironmentError("{} is no workbook (.xlsx): it is no zip archive", file);
}

bool is_wanted(std::string_view path) {
    return path.ends_with(".xml") || path.ends_with(".rels");
}

WorkbookParts unpacked(const std::string& file, const std::string& bytes) {
    const Utf8Locale names_are_utf8;
    const std::unique_ptr<archive, int (*)(archive*)> zip(::archive_read_new(), ::archive_read_free);
    if (!zip || ::archive_read_support_format_zip(zip.get()) != ARCHIVE_OK ||
        ::archive_read_open_memory(zip.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
        fail_as_no_archive(file);
    WorkbookParts parts{file};
    const std::size_t most = memory_for_reading(bytes.size()) / 2;
    std::size_t total = 0;
    archive_entry* entry = nullptr;
    int result = ARCHIVE_OK;
    for (int count = 0; (result = ::archive_read_next_header(zip.get(), &entry)) == ARCHIVE_OK; ++count) {
        if (count == kMostParts) throw EnvironmentError("{} has more than {} parts", file, kMostParts);
        const char* path = ::archive_entry_pathname(entry);
        if (path == nullptr || !is_wanted(path)) continue;
        std::string& part = parts.by_path[path];
        part.clear();
        char block[65536];
        la_ssize_t size = 0;
        while ((size = ::archive_read_data(zip.get(), block, sizeof block)) > 0) {
            total += static_cast<std::size_t>(size);
            if (total > most) throw EnvironmentError("{} unpacks to more than {} MB", file, most >> 20);
            part.append(block, static_cast<std::size_t>(size));
        }
        if (size < 0) throw EnvironmentError("{} is damaged: a part of it cannot be unpacked", file);
    }
    if (result != ARCHIVE_EOF && parts.by_path.empty()) fail_as_no_archive(file);
    if (result != ARCHIVE_EOF)
        throw EnvironmentError("{} is damaged: it is cut off, or no zip archive throughout", file);
    return parts;
}

std::string_view local_name(const char* name) {
    const std::string_view whole = name;
    return whole.substr(whole.find(':') == std::string_view::npos ? 0 : whole.find(':') + 1);
}

/// The first child of that name, whatever its namespace's prefix.
pugi::xml_node child_of(const pugi::xml_node& node, std::string_view name) {
    return node.find_child([name](const pugi::xml_node& child) { return local_name(child.name()) == name; });
}

std::string attribute_of(const pugi::xml_node& node, std::string_view name) {
    return node.find_attribute([name](const pugi::xml_attribute& a) { return local_name(a.name()) == name; }).value();
}

/// pugixml knows XML's own five entities and character references; it reads no document type.
/// The part's text goes with it.
pugi::xml_document parsed(WorkbookParts& parts, const std::string& path) {
    const auto part = parts.by_path.extract(path);
    if (part.empty()) throw EnvironmentError("{} is no workbook, or damaged: it has no part {}", parts.file, path);
    pugi::xml_document document;
    constexpr unsigned kOptions =
        pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol | pugi::parse_ws_pcdata_single;
    const auto result = document.load_buffer(part.mapped().data(), part.mapped().size(), kOptions);
    if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
    if (!result)
        throw EnvironmentError("{} is damaged: {} at byte {} of its part {}", parts.file, result.description(),
                               result.offset, path);
    return document;
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
    if (!parts.by_path.contains("xl/sharedStrings.xml")) return texts;
    const pugi::xml_document document = parsed(parts, "xl/sharedStrings.xml");
    for (const pugi::xml_node& item : document.document_element().children())
        if (local_name(item.name()) == "si") texts.push_back(item_text(item));
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
    SheetReader(const std::string& file, std::vector<std::string> texts, std::size_t most_bytes)
        : file_(file), texts_(std::move(texts)), most_bytes_(most_bytes) {}

    std::string csv(const pugi::xml_node& sheet_data) {
        for (const pugi::xml_node& row : sheet_data.children())
            if (local_name(row.name()) == "row") add_row(row);
        std::size_t width = 0;
        for (const Row& row : rows_) width = std::max(width, row.width);
        if (bytes_ + width * rows_.size() > most_bytes_) fail_large();
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
        throw EnvironmentError("{} has a sheet of more than {} MB", file_, most_bytes_ >> 20);
    }

    void add_row(const pugi::xml_node& row) {
        const std::string stated = attribute_of(row, "r");
        const std::size_t before = rows_.empty() ? 0 : rows_.back().number;
        const std::size_t number = stated.empty() ? before + 1 : whole_number(stated);
        if (number <= before || number > kMostRows)
            throw EnvironmentError("{} is damaged: its rows are not in order", file_);
        std::map<std::size_t, std::string> cells;  // by column, from 0
        std::size_t next = 0;
        for (const pugi::xml_node& cell : row.children()) {
            if (local_name(cell.name()) != "c") continue;
            const std::string place = attribute_of(cell, "r");
            const std::size_t column = place.empty() ? next : column_of(place);
            if (column >= kMostSheetColumns)
                throw EnvironmentError("{} is damaged: a cell lies beyond the last column", file_);
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
        if (bytes_ > most_bytes_) fail_large();
    }

    std::size_t whole_number(const std::string& text) const {
        if (const auto number = read_number<std::size_t>(text)) return *number;
        throw EnvironmentError("{} is damaged: wanted a whole number, given \"{}\"", file_, text.substr(0, 20));
    }

    /// 0 for A5, 26 for AA5.
    std::size_t column_of(const std::string& place) const {
        std::size_t column = 0;
        for (const char c : place) {
            if (c < 'A' || c > 'Z' || column > kMostSheetColumns) break;
            column = column * 26 + static_cast<std::size_t>(c - 'A' + 1);
        }
        if (column == 0) throw EnvironmentError("{} is damaged: \"{}\" is no cell", file_, place.substr(0, 20));
        return column - 1;
    }

    std::string cell_text(const pugi::xml_node& cell) const {
        const std::string type = attribute_of(cell, "t");
        if (type == "inlineStr") return in_quotes(item_text(child_of(cell, "is")));
        const std::string value = child_of(cell, "v").text().get();
        if (type == "s") {
            const std::size_t index = whole_number(value);
            if (index >= texts_.size())
                throw EnvironmentError("{} is damaged: a cell has a text that is not there", file_);
            return texts_[index].empty() ? "" : in_quotes(texts_[index]);
        }
        if (type == "str" || type == "e" || type == "d") return value.empty() ? "" : in_quotes(value);
        return number_or_text(value);
    }

    const std::string& file_;
    std::vector<std::string> texts_;
    std::size_t most_bytes_, bytes_ = 0;  ///< of the sheet as text
    std::vector<Row> rows_;
};

SheetText sheet_of(const std::string& file, const std::string& bytes, const std::string& wanted) {
    WorkbookParts parts = unpacked(file, bytes);
    const pugi::xml_document workbook = parsed(parts, "xl/workbook.xml");
    const pugi::xml_document relations = parsed(parts, "xl/_rels/workbook.xml.rels");
    SheetText text;
    std::string relation;
    for (const pugi::xml_node& sheet : child_of(workbook.document_element(), "sheets").children()) {
        text.sheets.push_back(attribute_of(sheet, "name"));
        if (relation.empty() && (wanted.empty() || text.sheets.back() == wanted)) relation = attribute_of(sheet, "id");
    }
    if (relation.empty())
        throw EnvironmentError("{} has no sheet \"{}\"; it has {}", file, wanted, listed(text.sheets));
    std::string path;
    for (const pugi::xml_node& entry : relations.document_element().children())
        if (attribute_of(entry, "Id") == relation) path = part_path(attribute_of(entry, "Target"));
    std::vector<std::string> texts = shared_texts(parts);
    const pugi::xml_document sheet = parsed(parts, path);
    text.csv = SheetReader(file, std::move(texts), std::max(kSmallestSheet, bytes.size()))
                   .csv(child_of(sheet.document_element(), "sheetData"));
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
                                        Message("{}: reading it takes more than {} MB of memory, too much for a file "
                                                "of {} MB",
                                                name, megabytes.most, megabytes.of_file)});
        }
    };
    const ChildResult result = run_guarded(read, limits);
    if (result.timed_out)
        throw result.time_limit() == TimeLimit::kProcessor
            ? EnvironmentError("{}: reading it used more than {} s of processor time", name,
                               limits.time.seconds(TimeLimit::kProcessor))
            : EnvironmentError("{}: reading it had not ended after {} s", name, limits.time.seconds(TimeLimit::kClock));
    if (result.exit_code == 1 && !result.error_output.empty()) throw EnvironmentError(result.error_output);
    if (result.exit_code != 0 || result.output_exceeded)
        throw EnvironmentError("{} is damaged: reading it ends in a crash", name);
    SheetOutcome outcome = from_cbor<SheetOutcome>(result.output);
    if (!outcome.refusal.empty()) throw EnvironmentError(outcome.refusal);
    return std::move(outcome.sheet);
}

}  // namespace dynlab::inline data_io
