#include "data_io/data_file.h"

#include <algorithm>
#include <array>

#include "data_io/csv_file.h"
#include "data_io/json_file.h"
#include "data_io/mat_file.h"
#include "data_io/tables/unit_text.h"
#include "data_io/workbook.h"
#include "platform/error.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline data_io {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kTableEndings = {".csv", ".tsv", ".txt", ".dat"};
constexpr std::string_view kMatEnding = ".mat", kJsonEnding = ".json", kWorkbookEnding = ".xlsx";
constexpr int kInstantDigits = 15;       // of messages: neighbours may differ late
constexpr double kStepTolerance = 1e-3;  // relative; instants are often rounded when they are written

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
        throw EnvironmentError("{}: option {} is for tables, not for {} files", file.string(), given,
                               file.extension().string());
}

LoadedData variables_of(const fs::path& file, bool guarded, const ImportOptions& options) {
    refuse_table_options(file, options);
    LoadedData data;
    if (ending_of(file) == kJsonEnding)
        data.variables = read_json_file(file);
    else
        data.variables = read_mat_file(file, guarded, &data.notes);
    for (Message& note : data.notes) note = Message("{}: left out", note);
    for (const auto& [name, unit] : options.units) {
        if (data.variables.count(name) == 0)
            throw EnvironmentError("{}: a unit is given for {}, but there is no such variable", file.string(), name);
        data.units[name] = unit;
    }
    return data;
}

LoadedData from_workbook(const fs::path& file, ImportOptions options) {
    if (options.delimiter) throw EnvironmentError("{}: option delimiter is for tables in text files", file.string());
    SheetText sheet = read_sheet(file, options.sheet);
    options.delimiter = ',';
    LoadedData data = from_table(read_csv_text(file, std::move(sheet.csv), options));
    if (options.sheet.empty() && sheet.sheets.size() > 1)
        data.notes.insert(data.notes.begin(), Message("of its sheets {} the first is read; option sheet names another",
                                                      listed(sheet.sheets)));
    return data;
}

LoadedData from_text(const fs::path& file, const ImportOptions& options) {
    if (!options.sheet.empty()) throw EnvironmentError("{}: option sheet is for workbooks (.xlsx)", file.string());
    return from_table(read_csv_file(file, options));
}

void take_time(LoadedData& data, const std::string& given) {
    const auto header = data.headers.find(given);
    const std::string& name = header == data.headers.end() ? given : header->second;
    const auto found = data.variables.find(name);
    const Vector* instants = found == data.variables.end() ? nullptr : std::get_if<Vector>(&found->second.value);
    const std::string file = data.file.string();
    if (instants == nullptr || instants->size() < 2)
        throw EnvironmentError("{}: the time '{}' is not a column of numbers", file, given);
    const auto unit = data.units.find(name);
    const double seconds = unit == data.units.end() ? 1 : seconds_of(unit->second).value_or(0);
    if (seconds == 0)
        throw EnvironmentError("{}: the time '{}' has the unit {}, which is none of time", file, given, unit->second);
    const InstantSpacing spacing = spacing_of(*instants);
    if (spacing.disorder)
        throw EnvironmentError("{}: the time '{}' must increase, but sample {} is {} and the next {}", file, given,
                               *spacing.disorder + 1, significant((*instants)[*spacing.disorder], kInstantDigits),
                               significant((*instants)[*spacing.disorder + 1], kInstantDigits));
    if (name != "t" && data.variables.count("t") > 0)
        throw EnvironmentError("{}: the time '{}' would take the place of the column t: rename one by names", file,
                               given);
    const Vector t = *instants * seconds;
    data.variables["t"] = {t};
    data.units["t"] = "s";
    if (spacing.even) data.variables["Ts"] = {spacing.step * seconds};
}

/// Seconds of a name like t_ms.
std::optional<double> seconds_of_ending(const std::string& name) {
    const auto line = name.rfind('_');
    return line == std::string::npos ? std::nullopt : seconds_of(name.substr(line + 1));
}

bool is_called_time(const std::string& name) {
    const std::string begin = in_small_letters(seconds_of_ending(name) ? name.substr(0, name.rfind('_')) : name);
    return begin == "t" || begin == "time";
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
        throw EnvironmentError("{} is of no kind that can be read: those are .mat, .xlsx, {}, .json", file.string(),
                               listed({kTableEndings.begin(), kTableEndings.end()}));
    data.file = file;
    if (!options.time.empty()) take_time(data, options.time);
    return data;
}

std::optional<TimeColumn> time_column(const LoadedData& data, Index samples) {
    std::optional<TimeColumn> called, by_unit;
    int timed = 0;
    for (const auto& [name, variable] : data.variables) {
        const Vector* values = std::get_if<Vector>(&variable.value);
        if (values == nullptr || values->size() != samples) continue;
        const auto unit = data.units.find(name);
        const auto seconds = unit == data.units.end() ? seconds_of_ending(name) : seconds_of(unit->second);
        if (is_called_time(name)) called = {name, seconds.value_or(1)};
        if (unit != data.units.end() && seconds) by_unit = {name, *seconds}, ++timed;
    }
    if (called) return called;
    return timed == 1 ? by_unit : std::nullopt;
}

InstantSpacing spacing_of(const Vector& instants) {
    const Index count = instants.size() - 1;
    const Vector steps = instants.tail(count) - instants.head(count);
    InstantSpacing spacing;
    for (Index i = 0; i < count; ++i) {
        if (steps[i] > 0) continue;  // false for NaN, too
        spacing.disorder = i;
        return spacing;
    }
    const double mean = steps.mean();
    spacing.even = (steps.array() - mean).abs().maxCoeff() <= kStepTolerance * mean;
    spacing.step = mean;
    if (spacing.even) return spacing;
    std::vector<double> sorted(steps.begin(), steps.end());
    std::nth_element(sorted.begin(), sorted.begin() + count / 2, sorted.end());
    spacing.step = sorted[static_cast<std::size_t>(count / 2)];
    constexpr double kGap = 1.5;
    for (Index i = 0; i < count; ++i)
        if (steps[i] > kGap * spacing.step) spacing.gaps.push_back(i);
    return spacing;
}

}  // namespace dynlab::inline data_io
