#include "app/workbench/data_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "app/workbench/session_script.h"
#include "base/languages.h"
#include "base/reader.h"
#include "data_io/data_file.h"
#include "data_io/dataset_index.h"
#include "documents/percent_script.h"
#include "documents/text_lines.h"
#include "platform/error.h"
#include "scripting/source/lua_tokens.h"
#include "workflow/data_summary.h"
#include "workflow/recording.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

/// Beginnings of names that people give to what drives a plant, and to what it does.
constexpr std::string_view kInputs[] = {"u",     "in",     "force",   "voltage", "power",   "valve",  "heat",
                                        "motor", "torque", "current", "duty",    "flow_in", "entree", "commande"};
constexpr std::string_view kOutputs[] = {"y",     "out",   "x",        "temp",     "theta",    "angle",  "pos",
                                         "speed", "level", "velocity", "pressure", "response", "sortie", "omega"};

std::string letters_of(const std::string& name) {
    std::string letters;
    for (const char c : name)
        if (std::isalpha(static_cast<unsigned char>(c)) || c == '_')
            letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return letters;
}

template <class Words>
bool sounds_like(const std::string& name, const Words& words) {
    const std::string letters = letters_of(name);
    return std::any_of(std::begin(words), std::end(words), [&](std::string_view word) {
        return word.size() == 1 ? letters == word || letters.starts_with(std::string(word) + "_")
                                : letters.starts_with(word);
    });
}

DataColumn column_of(const std::string& name, const std::string& unit, const Vector& numbers, Index samples) {
    DataColumn column{name, unit, "", 0, 0, "", true};
    const auto finite = numbers.array().isFinite();
    if (numbers.size() != samples)
        column.trouble = fmt::format("{} of {} values", numbers.size(), samples);
    else if (!finite.any())
        column.trouble = "no numbers";
    column.usable = column.trouble.empty();
    if (!column.usable) return column;
    column.smallest = finite.select(numbers.array(), std::numeric_limits<double>::infinity()).minCoeff();
    column.largest = finite.select(numbers.array(), -std::numeric_limits<double>::infinity()).maxCoeff();
    if (column.smallest == column.largest) column.trouble = "constant";
    if (const Index missing = numbers.size() - finite.count(); missing > 0)
        column.trouble = fmt::format("{} missing", missing);
    return column;
}

/// The signals of a file in its order, matrices column by column, structs member by member.
class Columns {
  public:
    explicit Columns(const LoadedData& loaded) : loaded_(loaded) {
        std::vector<std::string> names = loaded.columns;
        std::set<std::string> known(names.begin(), names.end());
        for (const auto& [name, variable] : loaded.variables)
            if (known.insert(name).second) names.push_back(name);
        for (const std::string& name : names) collect(name, "", loaded.variables.at(name));
    }

    std::vector<DataColumn> offered() const {
        std::vector<DataColumn> columns;
        std::string guessed = signals_.empty() ? "" : signals_.front().group;  // the struct whose signals get roles
        std::map<std::string, Index> lengths;                                  // of the groups
        std::string time;
        for (const Signal& signal : signals_) {
            const auto [known, is_new] = lengths.try_emplace(signal.group);
            if (is_new) known->second = samples_of(signal.group);
            if (is_new && signal.group == guessed) time = find_clock(loaded_, known->second, {}).name;
            const Index samples = known->second;
            const auto unit = loaded_.units.find(signal.name);
            columns.push_back(
                column_of(signal.name, unit == loaded_.units.end() ? "" : unit->second, signal.numbers, samples));
            DataColumn& column = columns.back();
            if (signal.group != guessed) continue;
            const std::string own = signal.group.empty() ? signal.name : signal.name.substr(signal.group.size() + 1);
            if (signal.group.empty() ? time == own : own == "t" || own == "time")
                column.role = "time";
            else if (column.usable && !is_of_other_experiment(own))
                column.role = sounds_like(own, kInputs) ? "input" : sounds_like(own, kOutputs) ? "output" : "";
        }
        for (const std::string& name : texts_) columns.push_back({name, "", "", 0, 0, "text", false});
        if (guessed.empty()) assign_remaining_roles(columns);
        return columns;
    }

  private:
    struct Signal {
        std::string name, group;
        Vector numbers;
    };

    void collect(const std::string& name, const std::string& group, const Variable& variable) {
        if (const auto* vector = std::get_if<Vector>(&variable.value)) signals_.push_back({name, group, *vector});
        if (const auto* matrix = std::get_if<Matrix>(&variable.value); matrix != nullptr && group.empty())
            for (Index j = 0; j < matrix->cols(); ++j)
                signals_.push_back({fmt::format("{}{}", name, j + 1), group, matrix->col(j)});
        if (std::holds_alternative<std::shared_ptr<VariableList>>(variable.value)) texts_.push_back(name);
        if (const auto* table = std::get_if<std::shared_ptr<VariableTable>>(&variable.value);
            table != nullptr && group.empty())
            for (const auto& [member, value] : **table) collect(name + "." + member, name, value);
    }

    /// Whether a file has an input and an output with this suffix and an input without it: u, y, u_val, y_val.
    bool is_of_other_experiment(const std::string& name) const {
        const std::size_t at = name.rfind('_');
        if (at == std::string::npos) return false;
        const std::string suffix = name.substr(at);
        bool input = false, output = false, plain = false;
        for (const Signal& signal : signals_) {
            const bool drives = sounds_like(signal.name, kInputs);
            plain = plain || (drives && signal.name.find('_') == std::string::npos);
            if (!signal.name.ends_with(suffix)) continue;
            input = input || drives;
            output = output || (!drives && sounds_like(signal.name, kOutputs));
        }
        return input && output && plain;
    }

    /// As most signals of the group have.
    Index samples_of(const std::string& group) const {
        std::map<Index, int> times;
        for (const Signal& signal : signals_)
            if (signal.group == group && signal.numbers.size() > 1) ++times[signal.numbers.size()];
        Index samples = 0;
        int max_count = 0;
        for (const auto& [length, count] : times)
            if (count >= max_count) max_count = count, samples = length;
        return samples;
    }

    /// Whether the numbers of a signal go up by equal steps, as a clock does.
    bool counts_evenly(const std::string& name) const {
        const auto found = std::ranges::find(signals_, name, &Signal::name);
        constexpr Index kMinCount = 5;
        if (found->numbers.size() < kMinCount || loaded_.variables.contains("Ts")) return false;
        const InstantSpacing spacing = spacing_of(found->numbers);
        return !spacing.disorder && spacing.even;
    }

    /// Assigns roles if the names show none: a clock may come first; of the other columns the first is the input, the
    /// last the output.
    void assign_remaining_roles(std::vector<DataColumn>& columns) const {
        const auto none = [&](const char* role) {
            return std::ranges::none_of(columns, [&](const DataColumn& column) { return column.role == role; });
        };
        const auto free = [](const DataColumn& column) { return column.role.empty() && column.usable; };
        if (none("time"))
            if (const auto first = std::ranges::find_if(columns, free);
                first != columns.end() && counts_evenly(first->name))
                first->role = "time";
        if (none("output"))
            if (const auto last = std::find_if(columns.rbegin(), columns.rend(), free); last != columns.rend())
                last->role = "output";
        if (none("input"))
            if (const auto first = std::ranges::find_if(columns, free); first != columns.end()) first->role = "input";
    }

    const LoadedData& loaded_;
    std::vector<Signal> signals_;
    std::vector<std::string> texts_;
};

/// A file may have any name; as text of a script's header it must not end its line.
std::string in_one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); }, ' ');
    return text;
}

}  // namespace

DataChoice describe_data(const std::string& data, bool with_summary) {
    const LoadedData loaded = load_data(data, ".");
    return {data, Columns(loaded).offered(), with_summary ? summarize_data(data, {}).text : ""};
}

std::string loading_lines(const DataSelection& order) {
    if (!is_variable_name(order.name))
        throw EnvironmentError(
            "\"{}\" is not a valid name for a data set: use only letters, digits and _. The name must not start with a "
            "digit or be a Lua keyword, such as end",
            order.name);
    if (order.inputs.empty() || order.outputs.empty())
        throw EnvironmentError("a data set needs at least one input and one output");
    const auto time_unit = order.units.find(order.time);
    Recording recording(order.data, order.inputs, order.outputs, order.Ts > 0 ? std::optional(order.Ts) : std::nullopt,
                        order.time, time_unit == order.units.end() ? "" : time_unit->second);
    for (const auto& [name, unit] : order.units)
        if (name != order.time) recording.set_unit(name, unit);
    const std::string file = order.name + "_file";
    return recording.loading(file) + fmt::format("{} = {}\n", order.name, recording.data(file, order.outputs));
}

std::string loading_lines_for_page(const DataSelection& order) {
    try {
        return loading_lines(order);
    } catch (const UnknownSampling& error) {
        throw EnvironmentError("{}; select the time column, or enter the sampling time below", error.message());
    }
}

DataSelection suggested_order(const DataChoice& choice) {
    DataSelection order{choice.data, {}, {}, "", 0, "data", {}};
    for (const DataColumn& column : choice.columns) {
        if (column.role == "input") order.inputs.push_back(column.name);
        if (column.role == "output") order.outputs.push_back(column.name);
        if (column.role == "time") order.time = column.name;
    }
    if (order.inputs.empty() || order.outputs.empty())
        throw EnvironmentError(
            "{} must contain at least two signals of equal length, an input and an output, in addition to the time",
            choice.data);
    return order;
}

std::string with_data(const std::string& source, const DataSelection& order, const std::string& lines) {
    const PercentScript script = parse_percent_script(source, "session.lua");
    if (std::ranges::none_of(script.cells, [](const Cell& cell) { return cell.kind == Cell::Kind::kCode; })) {
        const std::string& language = script.header.language;
        const Message title = Message("Identification from {}", fs::path(order.data).stem().string());
        return new_session(message_text(title, {catalog_of(language)}), lines, language);
    }
    const std::string own_cell = fmt::format("\n-- %% id={}\n{}", order.name, trimmed(lines));
    for (const Cell& cell : script.cells) {
        if (cell.id != "record") continue;
        const bool again = cell.content.find(order.name + " = iddata(") != std::string::npos;
        return with_edits(source, {again ? LineEdit{cell.first_line, cell.last_line(), trimmed(lines)}
                                         : LineEdit{cell.last_line() + 1, cell.last_line(), own_cell}});
    }
    return source + own_cell + "\n";
}

void expect_plain_name(const std::string& name) {
    if (std::ranges::any_of(name, [](unsigned char c) { return std::iscntrl(c); }))
        throw EnvironmentError("the file name {} contains control characters; rename the file", in_one_line(name));
}

fs::path name_of_data_file(const std::string& requested) {
    expect_plain_name(requested);
    const fs::path name = fs::path(requested).filename();
    if (!is_data_file(name))
        throw EnvironmentError("{} is not a data file: expected .csv, .txt, .dat, .tsv, .xlsx or .mat", name.string());
    return name;
}

std::string new_session(const std::string& title, const std::string& lines, const std::string& language) {
    std::string text = fmt::format("-- ---\n-- title: {}\n", in_one_line(title));
    if (language != "en") text += fmt::format("-- language: {}\n", language);
    text += "-- ---\n";
    if (lines.empty()) return text;
    return text + fmt::format(
                      "\n-- %% id=record\n{}\n-- %% id=preparation\nprepared = data\n\n-- %% id=parts\nestimation = "
                      "prepared\nvalidation = prepared\n",
                      lines);
}

}  // namespace dynlab::inline app
