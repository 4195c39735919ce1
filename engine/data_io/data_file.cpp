#include "data_io/data_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "data_io/csv_file.h"
#include "data_io/json_file.h"
#include "data_io/mat_file.h"
#include "data_io/workbook.h"
#include "platform/error.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline data_io {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> kTableEndings = {".csv", ".tsv", ".txt", ".dat", ".lvm"};
constexpr std::string_view kMatEnding = ".mat", kJsonEnding = ".json", kWorkbookEnding = ".xlsx";

bool is_table(const std::string& ending) {
    return std::find(kTableEndings.begin(), kTableEndings.end(), ending) != kTableEndings.end();
}

Index rows_of(const CsvTable& table) {
    Index rows = 0;
    for (const Vector& column : table.columns) rows = std::max(rows, column.size());
    for (const auto& [name, texts] : table.texts) rows = std::max(rows, static_cast<Index>(texts.size()));
    return rows;
}

LoadedData from_table(CsvTable table) {
    LoadedData data;
    data.rows = rows_of(table);
    const Index rows = data.rows;
    for (std::size_t i = 0; i < table.names.size(); ++i) {
        const std::string& name = table.names[i];
        const auto texts = table.texts.find(name);
        if (texts == table.texts.end()) {
            Vector& column = table.columns[i];
            if (column.size() == 1 && rows > 1)
                data.variables[name] = {column[0]};
            else
                data.variables[name] = {std::move(column)};
            continue;
        }
        auto list = std::make_shared<VariableList>();
        list->reserve(texts->second.size());
        for (std::string& text : texts->second) list->push_back({std::move(text)});
        data.variables[name] = {std::move(list)};
    }
    if (table.Ts) data.variables.insert({"Ts", {*table.Ts}});  // a column of that name comes first
    data.units = std::move(table.units);
    data.headers = std::move(table.headers);
    data.clocks = std::move(table.clocks);
    data.columns = std::move(table.names);
    data.notes = std::move(table.notes);
    return data;
}

void refuse_table_options(const fs::path& file, const ImportOptions& options) {
    const char* given = options.skip > 0         ? "skip"
                        : !options.names.empty() ? "names"
                        : options.delimiter      ? "delimiter"
                        : !options.sheet.empty() ? "sheet"
                                                 : nullptr;
    if (given != nullptr)
        throw EnvironmentError("{}: the option '{}' applies only to tables, not to {} files", file.string(), given,
                               file.extension().string());
}

LoadedData variables_of(const fs::path& file, bool guarded, const ImportOptions& options) {
    refuse_table_options(file, options);
    LoadedData data;
    if (ending_of(file) == kJsonEnding)
        data.variables = read_json_file(file);
    else
        data.variables = read_mat_file(file, guarded, &data.notes);
    for (Message& note : data.notes) note = Message("not all variables were loaded: {}", note);
    for (const auto& [name, unit] : options.units) {
        if (data.variables.count(name) == 0)
            throw EnvironmentError("{}: a unit is given for {}, which is not a variable of the file", file.string(),
                                   name);
        data.units[name] = unit;
    }
    return data;
}

LoadedData from_workbook(const fs::path& file, ImportOptions options) {
    if (options.delimiter)
        throw EnvironmentError("{}: the option 'delimiter' applies only to tables in text files", file.string());
    SheetText sheet = read_sheet(file, options.sheet);
    options.delimiter = ',';
    LoadedData data = from_table(read_csv_text(file, std::move(sheet.csv), options));
    if (options.sheet.empty() && sheet.sheets.size() > 1)
        data.notes.insert(
            data.notes.begin(),
            Message("dynlab reads the first of the sheets {}; to read another sheet, use the option 'sheet'",
                    listed(sheet.sheets)));
    return data;
}

LoadedData from_text(const fs::path& file, const ImportOptions& options) {
    if (!options.sheet.empty())
        throw EnvironmentError("{}: the option 'sheet' applies only to workbooks (.xlsx)", file.string());
    return from_table(read_csv_file(file, options));
}

bool repeats(const Variable& column, Index row) {
    if (const Vector* numbers = std::get_if<Vector>(&column.value)) {
        const double before = (*numbers)[row - 1], now = (*numbers)[row];
        return before == now || (std::isnan(before) && std::isnan(now));
    }
    const auto* texts = std::get_if<std::shared_ptr<VariableList>>(&column.value);
    const auto at = static_cast<std::size_t>(row);
    return texts == nullptr ||
           std::get<std::string>((**texts)[at - 1].value) == std::get<std::string>((**texts)[at].value);
}

void keep_rows(Variable& column, const std::vector<Index>& kept) {
    if (Vector* numbers = std::get_if<Vector>(&column.value)) {
        *numbers = Vector((*numbers)(kept));
    } else if (auto* texts = std::get_if<std::shared_ptr<VariableList>>(&column.value)) {
        auto list = std::make_shared<VariableList>();
        for (const Index row : kept) list->push_back(std::move((**texts)[static_cast<std::size_t>(row)]));
        *texts = std::move(list);
    }
}

/// Rows that were written twice, time and all; returns whether there are any.
bool drop_repeated_rows(LoadedData& data, const std::string& time) {
    const auto found = data.variables.find(time);
    const Vector* instants = found == data.variables.end() ? nullptr : std::get_if<Vector>(&found->second.value);
    if (instants == nullptr || instants->size() != data.rows) return false;
    std::vector<Index> kept;
    for (Index row = 0; row < data.rows; ++row) {
        const bool again = row > 0 && (*instants)[row] == (*instants)[row - 1] &&
                           std::ranges::all_of(data.columns, [&](const std::string& name) {
                               return repeats(data.variables.at(name), row);
                           });
        if (!again) kept.push_back(row);
    }
    const Index dropped = data.rows - std::ssize(kept);
    if (dropped == 0) return false;
    for (const std::string& name : data.columns) keep_rows(data.variables.at(name), kept);
    data.rows = std::ssize(kept);
    data.notes.insert(data.notes.begin(),
                      plural(dropped, "{} row repeats the row before it, including the time, and is left out",
                             "{} rows repeat the row before them, including the time, and are left out"));
    return true;
}

void take_time(LoadedData& data, const ImportOptions& options) {
    const auto search = [&] { return find_clock(data, usual_length(data), options); };
    data.time = search();
    if (!data.time.clock && drop_repeated_rows(data, data.time.name)) data.time = search();
    const std::optional<Clock>& clock = data.time.clock;
    if (!clock) {
        if (!options.time.empty()) throw EnvironmentError("{}: {}", data.file.string(), *data.time.question);
        if (data.time.likely) data.notes.insert(data.notes.begin(), *data.time.question);
        return;
    }
    data.notes.insert(data.notes.begin(), clock->notes.begin(), clock->notes.end());
    const bool is_text = data.clocks.contains(clock->name);
    if (is_text) data.variables[clock->name] = {clock->t}, data.units[clock->name] = "s";
    if (!options.time.empty()) use_clock(data);
}

}  // namespace

bool is_data_file(const fs::path& file) {
    const std::string ending = ending_of(file);
    return ending == kMatEnding || ending == kJsonEnding || ending == kWorkbookEnding || is_table(ending);
}

LoadedData read_data_file(const fs::path& file, bool guarded, const ImportOptions& options) {
    const std::string ending = ending_of(file);
    LoadedData data;
    if (ending == kMatEnding || ending == kJsonEnding)
        data = variables_of(file, guarded, options);
    else if (is_table(ending))
        data = from_text(file, options);
    else if (ending == kWorkbookEnding)
        data = from_workbook(file, options);
    else
        throw EnvironmentError("{} has an unsupported file type; supported types are .mat, .xlsx, {}, .json",
                               file.string(), listed({kTableEndings.begin(), kTableEndings.end()}));
    data.file = file;
    take_time(data, options);
    return data;
}

void use_clock(LoadedData& data) {
    const Clock& clock = *data.time.clock;
    std::string& name = data.time.variable;
    if (name.empty()) name = data.variables.contains("t") ? clock.name : "t";
    data.variables[name] = {clock.t}, data.units[name] = "s";
    if (clock.spacing.even) data.variables["Ts"] = {clock.spacing.step};
}

Index usual_length(const LoadedData& data) {
    std::map<Index, int> times;
    for (const auto& [name, variable] : data.variables)
        if (const Vector* vector = std::get_if<Vector>(&variable.value)) ++times[vector->size()];
    Index length = 0;
    int max_count = 0;
    for (const auto& [size, count] : times)
        if (count >= max_count) max_count = count, length = size;
    return length;
}

}  // namespace dynlab::inline data_io
