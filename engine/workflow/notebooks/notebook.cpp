#include "workflow/notebooks/notebook.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <variant>

#include "base/reader.h"
#include "documents/error.h"
#include "documents/percent_script.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"

namespace dynlab::inline workflow {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kMaxNotebookBytes = std::uintmax_t{64} << 20;
constexpr const char* kOurs = "dynlab";   // what we keep in the metadata of a cell
constexpr std::size_t kMaxIdLength = 64;  // nbformat's

/// A cell as both formats know it.
struct CellText {
    bool marked = true, text = false;
    std::string options;  ///< of the marker: "id=q2 echo=false"
    std::string source;   ///< as a notebook shows it: without comment signs, and without blank lines at its end
};

/// A cell's own lines in a script, its marker's among them.
struct Segment {
    std::string written;
    int first_line = 1;
};

std::vector<Segment> segments_of(const std::string& source) {
    std::vector<Segment> segments;
    int number = 0;
    for (const std::string_view line : lines_with_ends(source)) {
        ++number;
        if (segments.empty() || is_cell_marker(line)) segments.push_back({"", number});
        segments.back().written += line;
    }
    if (segments.empty()) segments.emplace_back();
    return segments;
}

std::string joined_lines(const std::vector<std::string>& lines) {
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) text += (i == 0 ? "" : "\n") + lines[i];
    return text;
}

std::string without_blank_end(std::vector<std::string> lines) {
    while (!lines.empty() && is_blank(lines.back())) lines.pop_back();
    return joined_lines(lines);
}

std::string first_line_of(const std::string& text) {
    return text.substr(0, text.find_first_of("\r\n"));
}

/// Whether the line would begin another cell, or is the escaped form of such a line.
bool is_escaped_marker(std::string_view line, char sign) {
    const std::size_t signs = std::min(line.find_first_not_of(sign), line.size());
    const std::string_view rest = line.substr(signs);
    return signs > 0 && (sign == '-' ? signs > 2 && is_cell_marker("--" + std::string(rest)) : rest.starts_with("%%"));
}

/// A line of a cell must not begin another cell of the script: such a line of code has a dash more there, and such a
/// line of text a backslash.
std::string script_line(const std::string& line, bool text) {
    if (!text) return is_cell_marker(line) || is_escaped_marker(line, '-') ? "-" + line : line;
    const std::string commented = line.empty() ? "--" : "-- " + line;
    const bool is_marker = is_cell_marker(commented);
    return is_marker || is_escaped_marker(line, '\\') ? "-- \\" + line.substr(is_marker ? line.find('%') : 0)
                                                      : commented;
}

/// The line of a notebook that script_line made this one of.
std::string notebook_line(const std::string& line, bool text) {
    if (!text) return is_escaped_marker(line, '-') ? line.substr(1) : line;
    if (!line.starts_with("--")) return line;
    const std::string shown = line.substr(line.starts_with("-- ") ? 3 : 2);
    return is_escaped_marker(shown, '\\') ? shown.substr(1) : shown;
}

/// What the lines of one cell say.
CellText cell_of_lines(const std::string& written) {
    std::vector<std::string> lines = lines_of(written);
    CellText cell;
    cell.marked = !lines.empty() && is_cell_marker(lines.front());
    if (cell.marked) {
        cell.text = is_text_cell_marker(lines.front());
        cell.options = trimmed(cell_marker_options(lines.front()));
        if (cell.text) cell.options = trimmed(cell.options.substr(std::string_view("[markdown]").size()));
        lines.erase(lines.begin());
    }
    for (std::string& line : lines) line = notebook_line(line, cell.text);
    cell.source = without_blank_end(std::move(lines));
    return cell;
}

/// The lines that a script has for a cell; a blank one parts it from the next.
std::string write_cell(const CellText& cell, bool last) {
    std::string written;
    if (cell.marked)
        written = std::string("-- %%") + (cell.text ? " [markdown]" : "") +
                  (cell.options.empty() ? "" : " " + cell.options) + "\n";
    for (const std::string& line : lines_of(cell.source)) written += script_line(line, cell.text) + "\n";
    return last ? written : written + "\n";
}

bool begins_with_header(const std::string& source) {
    return source.starts_with("-- ---") || source.starts_with("#!");
}

json lines_as_json(const std::string& text) {
    json lines = json::array();
    for (const std::string_view line : lines_with_ends(text)) lines.push_back(line);
    return lines;
}

std::string text_in(const json& value) {
    if (value.is_string()) return value.get<std::string>();
    std::string text;
    if (value.is_array())
        for (const json& line : value)
            if (line.is_string()) text += line.get<std::string>();
    return text;
}

/// A member's text; empty where there is none.
std::string text_at(const json& object, const char* key) {
    const auto member = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && member != object.end() ? text_in(*member) : "";
}

const json& object_at(const json& object, const char* key) {
    static const json kNone = json::object();
    const auto member = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && member != object.end() && member->is_object() ? *member : kNone;
}

/// What a cell of a run printed and drew, in order; and the error with which the run stopped in it.
json outputs_of(const RunRecord& record, const Cell& cell, bool stopped_here,
                const std::map<std::string, std::string>& figures) {
    json outputs = json::array();
    if (const auto found = record.outputs.find(cell.id); found != record.outputs.end()) {
        for (const CellOutput& piece : found->second) {
            if (!piece.printed.empty())
                outputs.push_back(
                    {{"output_type", "stream"}, {"name", "stdout"}, {"text", lines_as_json(piece.printed)}});
            const auto drawn = piece.figure ? figures.find(*piece.figure) : figures.end();
            if (drawn != figures.end())
                outputs.push_back({{"output_type", "display_data"},
                                   {"data", json::parse(drawn->second)},
                                   {"metadata", json::object()}});
        }
    }
    if (stopped_here)
        outputs.push_back({{"output_type", "error"},
                           {"ename", "error"},
                           {"evalue", record.error->text()},
                           {"traceback", json::array({record.error->text()})}});
    return outputs;
}

/// The ids of a notebook's cells: those of the script where nbformat takes them, each once.
class NotebookIds {
  public:
    std::string next(std::string id) {
        if (!is_name(id) || id.size() > kMaxIdLength) id = "cell";
        for (int i = 2; !taken_.insert(id).second; ++i) id = fmt::format("{}-{}", id.substr(0, kMaxIdLength - 8), i);
        return id;
    }

  private:
    std::set<std::string> taken_;
};

json notebook_metadata() {
    return {{"kernelspec", {{"name", kKernelName}, {"display_name", kKernelTitle}, {"language", kKernelLanguage}}},
            {"language_info", {{"name", kKernelLanguage}, {"file_extension", ".lua"}, {"mimetype", "text/x-lua"}}}};
}

[[noreturn]] void refuse_notebook(const std::filesystem::path& name, const Message& what) {
    throw DocumentError(Place{name}, what);
}

/// The cells of a notebook that we can read, or the sentence why we cannot.
const json& checked_cells(const json& notebook, const std::filesystem::path& name) {
    if (!notebook.is_object()) refuse_notebook(name, Message("the file is JSON, but not a Jupyter notebook"));
    const auto format = notebook.find("nbformat");
    if (format == notebook.end() || !format->is_number_integer())
        refuse_notebook(name, Message("the file is JSON, but not a Jupyter notebook (it has no nbformat)"));
    if (*format != 4)
        refuse_notebook(name, Message("the notebook has nbformat {}, but dynlab reads nbformat 4. Open and save it in "
                                      "a current version of Jupyter, or run: python3 -m nbconvert --to notebook FILE",
                                      format->dump()));
    const json& metadata = object_at(notebook, "metadata");
    for (const json* reported : {&object_at(metadata, "language_info"), &object_at(metadata, "kernelspec")}) {
        const std::string language =
            text_at(*reported, reported == &object_at(metadata, "kernelspec") ? "language" : "name");
        if (!language.empty() && language != kKernelLanguage && language != "Lua")
            refuse_notebook(
                name, Message("the notebook uses {}; dynlab runs only Lua notebooks, with its own kernel", language));
    }
    const auto cells = notebook.find("cells");
    if (cells == notebook.end() || !cells->is_array())
        refuse_notebook(name, Message("this notebook has no list of cells; save the notebook again in Jupyter"));
    if (cells->empty()) refuse_notebook(name, Message("this notebook has no cells; add a cell and save the notebook"));
    return *cells;
}

CellText cell_of_json(const json& cell, bool first) {
    CellText read;
    const json& ours = object_at(object_at(cell, "metadata"), kOurs);
    const std::string kind = text_at(cell, "cell_type");
    read.source = text_at(cell, "source");
    const bool header = first && begins_with_header(read.source);
    read.text = kind != "code" && !header;
    const auto marked = ours.find("marked");
    read.marked = !header && !(first && !read.text && marked != ours.end() && *marked == json(false));
    read.options = first_line_of(text_at(ours, "options"));
    read.source = without_blank_end(lines_of(read.source));
    return read;
}

/// The lines that the script had for the cell, where the cell still says what they say.
std::string saved_entry(const json& cell, const CellText& read) {
    const std::string written = text_at(object_at(object_at(cell, "metadata"), kOurs), "written");
    if (written.empty() || segments_of(written).size() != 1) return {};
    const CellText before = cell_of_lines(written);
    const bool same = before.marked == read.marked && before.text == read.text && before.source == read.source;
    return same ? written : "";
}

/// Lines of code that would begin a cell of the script: in a string, a dash more is another text.
void add_losses_of_code(const std::string& code, int cell, const std::filesystem::path& name,
                        std::vector<Message>& losses) {
    int number = 0;
    for (const std::string& line : lines_of(code)) {
        ++number;
        if (!is_cell_marker(line)) continue;
        losses.push_back(placed(
            {name}, Message("cell {}, line {}: \"{}\" would start a cell of the script, so the script contains \"{}\". "
                            "Inside a string, write the marker in another way, such as \"--\" .. \" %%\"",
                            cell, number, line, script_line(line, false))));
    }
}

}  // namespace

bool is_notebook(const std::filesystem::path& file) {
    return file.extension() == ".ipynb";
}

std::string notebook_of(const PercentScript& script, const RunRecord* record,
                        const std::map<std::string, std::string>& figures) {
    const std::vector<Segment> segments = segments_of(script.source);
    const Cell* const failed = record && record->error
                                   ? script.cell_at_line(record->error->line_in(script.file.filename().string()))
                                   : nullptr;
    NotebookIds ids;
    json cells = json::array();
    int runs = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const bool last = i + 1 == segments.size();
        const CellText cell = cell_of_lines(segments[i].written);
        const int end = last ? std::numeric_limits<int>::max() : segments[i + 1].first_line;
        const auto parsed = std::lower_bound(script.cells.begin(), script.cells.end(), segments[i].first_line,
                                             [](const Cell& one, int line) { return one.first_line < line; });
        json ours = json::object();
        if (!cell.options.empty()) ours["options"] = cell.options;
        if (!cell.marked) ours["marked"] = false;
        if (write_cell(cell, last) != segments[i].written) ours["written"] = lines_as_json(segments[i].written);
        const bool there = parsed != script.cells.end() && parsed->first_line < end;
        json made = {{"cell_type", cell.text ? "markdown" : "code"},
                     {"id", ids.next(there ? parsed->id : "header")},
                     {"metadata", ours.empty() ? json::object() : json{{kOurs, ours}}},
                     {"source", lines_as_json(cell.source)}};
        if (!cell.text) {
            const bool shows = record != nullptr && there;
            const bool stopped = shows && failed == &*parsed;
            made["outputs"] = shows ? outputs_of(*record, *parsed, stopped, figures) : json::array();
            made["execution_count"] = record != nullptr ? json(++runs) : json();
        }
        cells.push_back(std::move(made));
    }
    const json notebook = {
        {"nbformat", 4}, {"nbformat_minor", 5}, {"metadata", notebook_metadata()}, {"cells", std::move(cells)}};
    return notebook.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

NotebookScript script_of_notebook(std::string_view text, const std::filesystem::path& name) {
    const json notebook = json::parse(text, nullptr, false);
    if (notebook.is_discarded())
        refuse_notebook(name, Message("the file is not a Jupyter notebook: it is not JSON, or is truncated"));
    const json& cells = checked_cells(notebook, name);
    NotebookScript script;
    int number = 0;
    for (const json& cell : cells) {
        const bool first = ++number == 1, last = static_cast<std::size_t>(number) == cells.size();
        const std::string kind = text_at(cell, "cell_type");
        if (kind != "code" && kind != "markdown" && kind != "raw")
            refuse_notebook(
                name,
                Message("cell {} has the type \"{}\", but dynlab supports only code, markdown and raw", number, kind));
        if (!object_at(cell, "attachments").empty())
            script.losses.push_back(placed(
                {name},
                Message(
                    "cell {} contains a pasted picture; save the picture as a file and give the file name in the text",
                    number)));
        CellText read = cell_of_json(cell, first);
        if (kind == "raw" && read.marked) {  // a comment in its place, by which later cells keep their numbers
            read.source = "<!-- A raw cell of the notebook was here. -->";
            script.losses.push_back(
                placed({name},
                       Message("cell {} is a raw cell, which a script cannot contain; dynlab omits the cell", number)));
        }
        if (!read.text) add_losses_of_code(read.source, number, name, script.losses);
        std::string written = saved_entry(cell, read);
        if (written.empty()) written = write_cell(read, last);
        if (!last && !written.ends_with('\n')) written += "\n";
        script.source += written;
    }
    return script;
}

NotebookScript read_notebook(const std::filesystem::path& file) {
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
    if (!unknown && bytes > kMaxNotebookBytes)
        refuse_notebook(file, Message("the size of the notebook is {} MB, but the limit is {} MB: clear its outputs",
                                      bytes >> 20, kMaxNotebookBytes >> 20));
    NotebookScript script = script_of_notebook(read_text(file), file);
    if (script.source.size() > kMaxSourceSize)
        refuse_notebook(file, Message("the cells contain {} MB of text, but the limit for a script is {} MB",
                                      (script.source.size() + (1 << 20) - 1) >> 20, kMaxSourceSize >> 20));
    return script;
}

PercentScript read_script_or_notebook(const std::filesystem::path& file) {
    return is_notebook(file) ? parse_percent_script(read_notebook(file).source, file) : read_percent_script(file);
}

namespace {

Message place_in_segments(const std::vector<Segment>& segments, int line) {
    const auto behind = std::upper_bound(segments.begin(), segments.end(), line,
                                         [](int requested, const Segment& one) { return requested < one.first_line; });
    if (behind == segments.begin()) return {};
    const Segment& segment = *(behind - 1);
    const int behind_marker = line - segment.first_line + (is_cell_marker(first_line_of(segment.written)) ? 0 : 1);
    return behind_marker == 0 ? Message() : Message("cell {}, line {}", behind - segments.begin(), behind_marker);
}

}  // namespace

Message place_in_notebook(const std::string& source, int line) {
    return place_in_segments(segments_of(source), line);
}

namespace {

/// What a text says of places in a script, as a notebook's author knows them.
class NotebookPlaces {
  public:
    NotebookPlaces(const std::string& script, const std::string& notebook, const std::string& source)
        : script_(script), notebook_(notebook), segments_(segments_of(source)) {}

    /// The text in pieces: texts, and the places between them.
    std::vector<MessageArgument> pieces(const std::string& text) const {
        std::vector<MessageArgument> all;
        std::string piece;
        std::size_t at = 0;
        for (std::size_t found; (found = text.find(script_, at)) != std::string::npos;) {
            piece += text.substr(at, found - at) + notebook_;
            at = found + script_.size();
            std::size_t end = at + 1;
            while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
            const bool has_line = at < text.size() && text[at] == ':' && end > at + 1 && end < at + 9;
            const Message place =
                has_line ? place_in_segments(segments_, std::stoi(text.substr(at + 1, 8))) : Message();
            if (place.empty()) continue;
            all.emplace_back(std::exchange(piece, "") + ", ");
            all.emplace_back(message_argument(place));
            at = end;
        }
        all.emplace_back(piece + text.substr(at));
        return all;
    }

    Message in(const Message& message) const {
        std::vector<MessageArgument> arguments = message.arguments();
        for (MessageArgument& argument : arguments) {
            if (const auto* const text = std::get_if<std::string>(&argument)) {
                argument = joined(pieces(*text));
            } else if (auto* const list = std::get_if<MessageList>(&argument)) {
                for (Message& item : list->items) item = in(item);
            }
        }
        return Message::stored(message.id(), message.many(), std::move(arguments));
    }

  private:
    static MessageArgument joined(std::vector<MessageArgument> pieces) {
        if (pieces.size() == 1) return pieces.front();
        std::string format;
        for (std::size_t i = 0; i < pieces.size(); ++i) format += "{}";
        return message_argument(Message::stored(format, "", std::move(pieces)));
    }

    const std::string &script_, &notebook_;
    std::vector<Segment> segments_;
};

}  // namespace

Message with_places_in_notebook(const Message& message, const std::string& script, const std::string& notebook,
                                const std::string& source) {
    return NotebookPlaces(script, notebook, source).in(message);
}

std::string with_places_in_notebook(const std::string& text, const std::string& script, const std::string& notebook,
                                    const std::string& source) {
    return message_text(with_places_in_notebook(Message::verbatim(text), script, notebook, source));
}

}  // namespace dynlab::inline workflow
