#include "data_io/csv_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "data_io/tables/cell_scanner.h"
#include "data_io/tables/instrument_text.h"
#include "data_io/tables/number_cell.h"
#include "data_io/tables/table_layout.h"
#include "data_io/tables/table_rows.h"
#include "data_io/tables/text_decoding.h"
#include "data_io/tables/time_text.h"
#include "data_io/tables/unit_text.h"
#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

constexpr std::size_t kMaxListed = 8;

class CsvReader {
  public:
    /// `facts`: what an instrument states outside the table.
    CsvReader(const std::filesystem::path& file, std::string_view text, const ImportOptions& options,
              const InstrumentFacts& facts)
        : file_(file), text_(text), options_(options), facts_(facts) {
        if (options_.names.empty()) options_.names = facts.names;
        table_.Ts = facts.Ts;
    }

    CsvTable read() {
        skip_lines();
        take_separator_line();
        read_comments();
        layout_ = find_layout(file_, text_, at_, line_, options_);
        name_columns();
        report_layout();
        read_rows();
        count_instants();
        return std::move(table_);
    }

  private:
    void note(Message sentence) { table_.notes.push_back(std::move(sentence)); }
    /// The first items only, as a user does not read hundreds.
    static MessageList first_of(MessageList list) {
        if (list.items.size() <= kMaxListed) return list;
        list.items.resize(kMaxListed);
        list.items.push_back(Message::verbatim("..."));
        return list;
    }
    static MessageList first_of(const std::vector<std::string>& texts) {
        const auto count = static_cast<std::ptrdiff_t>(std::min(texts.size(), kMaxListed + 1));
        return first_of(listed({texts.begin(), texts.begin() + count}));
    }

    std::string_view rest_of_line() const { return text_.substr(at_, text_.find('\n', at_) - at_); }
    bool at_end() const { return at_ >= text_.size(); }
    void skip_line() {
        at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
        ++line_;
    }

    void skip_lines() {
        for (std::size_t i = 0; i < options_.skip; ++i) {
            if (at_end())
                throw EnvironmentError("{}: cannot skip {}, because the file has only {}", file_.string(),
                                       plural(static_cast<std::int64_t>(options_.skip), "{} line", "{} lines"), i);
            skip_line();
        }
    }

    /// Spreadsheets write the separator into a separate line: sep=;
    void take_separator_line() {
        std::string_view line = trimmed_cell(rest_of_line());
        if (line.size() > 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
        if (at_end() || line.size() > 5 || (!line.starts_with("sep=") && !line.starts_with("SEP="))) return;
        if (!options_.delimiter) options_.delimiter = line.size() == 5 ? line.back() : '\t';  // its own tab is trimmed
        skip_line();
    }

    /// The comments above everything else may hold remarks, units and the sampling time.
    void read_comments() {
        const std::size_t at = at_, line = line_;
        while (!at_end()) {
            const std::string_view text = trimmed_cell(rest_of_line());
            if (!text.empty() && !is_comment(text)) break;
            const std::string_view comment = text.empty() ? text : text.substr(1);
            const auto colon = comment.find(':');
            if (colon != std::string_view::npos)
                take_remark(trimmed_cell(comment.substr(0, colon)), trimmed_cell(comment.substr(colon + 1)));
            skip_line();
        }
        at_ = at, line_ = line;
    }

    void take_remark(std::string_view key, std::string_view value) {
        if (key.substr(0, 5) == "unit ") {
            stated_units_[std::string(trimmed_cell(key.substr(5)))] = value;
        } else if (key == "Ts") {
            const NumberAndRest measure = number_and_rest(value);
            double Ts = 0;
            if (const auto seconds = seconds_of(measure.rest, true))
                Ts = measure.number * *seconds;
            else if (parse_number(value, Ts) != NumberStatus::kNumber)
                Ts = 0;
            if (!(Ts > 0))
                throw EnvironmentError(
                    "{}, line {}: the sampling time Ts must be a positive number of seconds, but \"{}\" was given",
                    file_.string(), line_, value);
            table_.Ts = Ts;
        } else {
            table_.remarks[std::string(key)] = value;
        }
    }

    std::size_t columns() const { return layout_.formats.size(); }

    void name_columns() {
        const std::vector<std::string> headers = headers_of_columns();
        std::vector<std::string> units(columns());
        if (!options_.names.empty()) {
            if (options_.names.size() != columns())
                throw EnvironmentError("{}: the option 'names' has {}, but the table has {}", file_.string(),
                                       plural(std::ssize(options_.names), "{} name", "{} names"),
                                       plural(static_cast<std::int64_t>(columns()), "{} column", "{} columns"));
            table_.names = options_.names;
        } else {
            take_units_of_headers(headers, units);
            name_the_nameless();
            number_equal_names();
        }
        for (std::size_t j = 0; j < columns(); ++j) {
            if (j < layout_.units.size() && units[j].empty()) units[j] = without_brackets(layout_.units[j]);
            if (!units[j].empty()) table_.units[table_.names[j]] = units[j];
            if (!headers[j].empty() && headers[j] != table_.names[j])
                table_.headers.insert({headers[j], table_.names[j]});
        }
        const std::set<std::string> known(table_.names.begin(), table_.names.end());
        for (const auto& [name, unit] : facts_.units)
            if (known.contains(name) && !options_.units.contains(name)) table_.units[name] = unit;
        for (const auto* units_by_name : {&stated_units_, &options_.units})
            for (const auto& [name, unit] : *units_by_name) state_unit(name, unit, known);
    }

    /// One for each column, some perhaps empty.
    std::vector<std::string> headers_of_columns() const {
        std::vector<std::string> headers = layout_.names;
        if (layout_.numbered_rows) headers.insert(headers.begin(), "");
        headers.resize(columns());
        return headers;
    }

    void take_units_of_headers(const std::vector<std::string>& headers, std::vector<std::string>& units) {
        table_.names = headers;
        std::map<std::string, int> times;
        for (const std::string& header : headers) ++times[split_unit(header).name];
        MessageList reported;
        for (std::size_t j = 0; j < columns(); ++j) {
            const auto [name, unit] = split_unit(headers[j]);
            if (unit.empty() || times[name] > 1) continue;  // units distinguish y (m) and y (V)
            table_.names[j] = name, units[j] = unit;
            reported.items.push_back(Message("{} in {}", name, unit));
        }
        if (!reported.items.empty()) note(Message("units from the headers: {}", first_of(reported)));
    }

    void name_the_nameless() {
        MessageList reported;
        const bool all = layout_.names.empty();
        for (std::size_t j = 0; j < columns(); ++j) {
            if (!table_.names[j].empty()) continue;
            table_.names[j] = all ? fmt::format("c{}", j + 1) : j == 0 ? "index" : fmt::format("column_{}", j + 1);
            reported.items.push_back(all ? Message::verbatim(table_.names[j])
                                         : Message("column {} is named {}", j + 1, table_.names[j]));
        }
        if (reported.items.empty()) return;
        note(all ? Message("the file has no header line, so the columns are named {}; the option {names = {...}} sets "
                           "their names",
                           first_of(reported))
                 : Message("columns without a name in the header: {}", first_of(reported)));
    }

    void number_equal_names() {
        std::set<std::string> taken(table_.names.begin(), table_.names.end());
        std::map<std::string, std::size_t> numbers;  // the last one of each name
        std::vector<std::string> reported;
        for (std::string& name : table_.names) {
            std::size_t& number = numbers[name];
            if (++number == 1) continue;
            while (!taken.insert(fmt::format("{}_{}", name, number)).second) ++number;
            name = fmt::format("{}_{}", name, number);
            reported.push_back(name);
        }
        if (!reported.empty()) note(Message("columns with the same name are numbered: {}", first_of(reported)));
    }

    void state_unit(const std::string& name, const std::string& unit, const std::set<std::string>& known) {
        const auto header = table_.headers.find(name);
        const std::string& column = header == table_.headers.end() ? name : header->second;
        if (!known.contains(column))
            throw EnvironmentError("{}: a unit is given for {}, which is not a column; the columns are {}",
                                   file_.string(), name, first_of(table_.names));
        table_.units[column] = unit;
    }

    void report_layout() {
        if (layout_.passed_over == 1)
            note(Message("the table starts at line {}; the line above it is skipped", layout_.table_line));
        else if (layout_.passed_over > 1)
            note(Message("the table starts at line {}; {} lines above it are skipped", layout_.table_line,
                         layout_.passed_over));
        if (layout_.named_by_comment) note(Message("the column names are read from the comment above the numbers"));
        if (layout_.units_line > 0) {
            MessageList reported;
            for (const auto& [name, unit] : table_.units) reported.items.push_back(Message("{} in {}", name, unit));
            note(Message("line {} is read as units: {}", layout_.units_line, first_of(reported)));
        }
    }

    void read_rows() {
        TableRows rows = read_table_rows(file_, text_, layout_, table_.names);
        for (std::size_t j = 0; j < columns(); ++j) {
            const std::string& name = table_.names[j];
            TableColumn& column = rows.columns[j];
            if (name == "Ts" && is_one_number(column)) {
                note(Message("the only number in column Ts, in its first row, is used as the sampling time"));
                column.numbers.conservativeResize(1), column.missing = 0;
            }
            using Kind = ColumnFormat::Kind;
            const Kind kind = layout_.formats[j].kind;
            if (kind == Kind::kText) table_.texts[name] = std::move(column.texts);
            if (kind == Kind::kClock) table_.clocks[name] = column.clocks;
            if (kind == Kind::kMeasure) table_.units.insert({name, layout_.formats[j].unit});
            table_.columns.push_back(std::move(column.numbers));
        }
        report_missing(rows);
        for (Message& sentence : rows.notes) note(std::move(sentence));
    }

    /// Of an instrument that numbers its samples and states when the first was taken, and the sampling time.
    void count_instants() {
        const auto counter = std::ranges::find(table_.names, facts_.counter);
        if (counter == table_.names.end() || !facts_.Ts) return;
        Vector& instants = table_.columns[static_cast<std::size_t>(counter - table_.names.begin())];
        instants = facts_.start + instants.array() * *facts_.Ts;
        table_.units[*counter] = "s";
    }

    /// Benchmark data sets give the sampling time as a column of one number.
    static bool is_one_number(const TableColumn& column) {
        return column.numbers.size() > 1 && column.missing + 1 == static_cast<std::size_t>(column.numbers.size()) &&
               column.numbers[0] == column.numbers[0];
    }

    void report_missing(const TableRows& rows) {
        MessageList reported;
        for (std::size_t j = 0; j < columns(); ++j)
            if (const TableColumn& column = rows.columns[j]; column.missing > 0)
                reported.items.push_back(Message("{} of {} in {} (first on line {})", column.missing, rows.count,
                                                 table_.names[j], column.first_missing_line));
        if (!reported.items.empty())
            note(
                Message("missing numbers were replaced with NaN: {}. Use fillmissing(u, {method = \"previous\"}) for "
                        "an input that is logged only when it changes, and fillmissing(y) for an output",
                        first_of(reported)));
    }

    const std::filesystem::path& file_;
    std::string_view text_;
    ImportOptions options_;
    const InstrumentFacts& facts_;
    std::size_t at_ = 0, line_ = 1;
    TableLayout layout_;
    std::map<std::string, std::string> stated_units_;
    CsvTable table_;
};

}  // namespace

CsvTable read_csv_text(const std::filesystem::path& file, std::string bytes, const ImportOptions& options) {
    std::vector<Message> notes;
    std::string text = decoded_text(file, std::move(bytes), notes);
    const InstrumentFacts facts = take_instrument_text(file, text);
    CsvTable table = CsvReader(file, text, options, facts).read();
    table.notes.insert(table.notes.begin(), notes.begin(), notes.end());
    return table;
}

CsvTable read_csv_file(const std::filesystem::path& file, const ImportOptions& options) {
    return read_csv_text(file, read_file(file), options);
}

}  // namespace dynlab::inline data_io
