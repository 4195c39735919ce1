#include <algorithm>
#include <array>

#include "data_io/csv_file.h"
#include "data_io/json_file.h"
#include "data_io/mat_file.h"
#include "numerics/signals/checks.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/option_member.h"
#include "scripting/conversions/userdata.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/exchange.h"
#include "scripting/runtime/output_path.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kSaveCsvOptions = {
    OptionEntry{"units", ValueKind::kTable, about("units by column, such as {t = \"s\"}")},
    OptionEntry{"title", ValueKind::kText, about("text of the first comment line")},
    OptionEntry{"columns", ValueKind::kAny,
                about("names of the columns in the order of the file; by default all columns")},
    option<&CsvTable::Ts>("Ts", about("sampling time to write to the file"), {.unit = "s"}),
    OptionEntry{"digits",
                ValueKind::kCount,
                about("number of significant digits; 17 digits represent each number exactly"),
                {.initial = "7", .minimum = 1, .maximum = 17}}};
constexpr std::array kSaveMatOptions = {
    OptionEntry{"digits",
                ValueKind::kCount,
                about("number of significant digits to round to; 17 for no rounding"),
                {.initial = "17", .minimum = 1, .maximum = 17}}};
constexpr OptionTable kSaveCsvTables[] = {kSaveCsvOptions}, kSaveMatTables[] = {kSaveMatOptions};

constexpr std::array kSaveCsvArguments = {
    ArgumentEntry{
        "path", ValueKind::kText,
        about("file name ending in .csv, in the script's folder, the output folder or one of their subfolders")},
    ArgumentEntry{
        "data", ValueKind::kData,
        about("data object with one experiment, or a table of named vectors, lists of numbers and lists of strings")}};
constexpr std::array kSaveMatArguments = {
    ArgumentEntry{
        "path", ValueKind::kText,
        about("file name ending in .mat, in the script's folder, the output folder or one of their subfolders")},
    ArgumentEntry{"variables", ValueKind::kTable,
                  about("table of named variables: models, data objects, vectors, matrices, numbers, strings, lists of "
                        "strings, and tables of these")}};
constexpr std::array kSaveJsonArguments = {
    ArgumentEntry{
        "path", ValueKind::kText,
        about("file name ending in .json, in the script's folder, the output folder or one of their subfolders")},
    kSaveMatArguments[1]};

std::filesystem::path file_to_write(const Call& call, const char* extension) {
    const std::filesystem::path file = output_path(call.context(), call.text(1, "path"));
    if (file.extension() != extension)
        throw InvalidArgument("the file name must end in {}, but '{}' does not", extension, file.filename().string());
    return file;
}

/// Names of the table's entries: t first, the others in alphabetical order.
std::vector<std::string> names_of_entries(lua_State* L, int index) {
    std::vector<std::string> names;
    lua_pushnil(L);
    while (lua_next(L, index)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) != LUA_TSTRING)
            throw InvalidArgument("every entry of the table needs a name, as in {t = t, y = y}");
        names.emplace_back(lua_tostring(L, -1));
    }
    std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
        return std::pair(a != "t", a) < std::pair(b != "t", b);
    });
    return names;
}

/// Whether a table's first entry is of this type of Lua's.
bool is_list_of(lua_State* L, int index, int type) {
    if (lua_type(L, index) != LUA_TTABLE || lua_rawlen(L, index) == 0) return false;
    const bool found = lua_rawgeti(L, index, 1) == type;
    lua_pop(L, 1);
    return found;
}

std::vector<std::string> list_of_texts(lua_State* L, int index) {
    std::vector<std::string> texts;
    for (lua_Unsigned i = 1; i <= lua_rawlen(L, index); ++i) {
        if (lua_rawgeti(L, index, static_cast<lua_Integer>(i)) != LUA_TSTRING)
            throw InvalidArgument("entry {} of a list of strings must be a string, but it is {}", i,
                                  given_value(L, -1));
        texts.emplace_back(lua_tostring(L, -1));
        lua_pop(L, 1);
    }
    return texts;
}

Vector list_of_numbers(lua_State* L, int index, const std::string& name) {
    Vector numbers(static_cast<Index>(lua_rawlen(L, index)));
    for (Index i = 0; i < numbers.size(); ++i) {
        if (lua_rawgeti(L, index, i + 1) != LUA_TNUMBER)
            throw InvalidArgument("'{}': entry {} of a list of numbers must be a number, but it is {}", name, i + 1,
                                  given_value(L, -1));
        numbers[i] = lua_tonumber(L, -1);
        lua_pop(L, 1);
    }
    return numbers;
}

[[noreturn]] void refuse_entry(lua_State* L, const std::string& name, const Message& required) {
    if (lua_isnil(L, -1))
        throw InvalidArgument("the table has no entry '{}'; correct the name, or add the entry", name);
    throw InvalidArgument("'{}' must be {}, but it is {}", name, required, given_value(L, -1));
}

void add_channels(CsvTable& table, const Matrix& channels, const std::vector<std::string>& names,
                  const std::vector<std::string>& units) {
    for (Index j = 0; j < channels.cols(); ++j) {
        const auto index = static_cast<std::size_t>(j);
        table.names.push_back(names[index]);
        table.columns.push_back(channels.col(j));
        if (index < units.size() && !units[index].empty()) table.units[names[index]] = units[index];
    }
}

CsvTable table_of_data(const IdData& data) {
    if (data.experiments.size() != 1)
        throw InvalidArgument(
            "a CSV file can contain only one experiment; write each experiment with data:experiment(k)");
    CsvTable table;
    table.names.push_back("t");
    table.columns.push_back(data.time());
    table.units["t"] = data.time_unit;
    if (data.regular()) table.Ts = data.Ts;
    add_channels(table, data.experiments.front().u, data.input_names, data.input_units);
    add_channels(table, data.experiments.front().y, data.output_names, data.output_units);
    const Index references = data.reference_count();
    std::vector<std::string> names;
    for (Index i = 1; i <= references; ++i) names.push_back(references == 1 ? "r" : fmt::format("r{}", i));
    add_channels(table, data.experiments.front().r, names, {});
    return table;
}

CsvTable selected_columns(const CsvTable& all, const std::vector<std::string>& names) {
    CsvTable table;
    table.Ts = all.Ts;
    for (const std::string& name : names) {
        const auto found = std::ranges::find(all.names, name);
        if (found == all.names.end())
            throw InvalidArgument("the data object has no column '{}'; its columns are {}", name, listed(all.names));
        table.names.push_back(name);
        table.columns.push_back(all.columns[static_cast<std::size_t>(found - all.names.begin())]);
        if (const auto unit = all.units.find(name); unit != all.units.end()) table.units.insert(*unit);
    }
    return table;
}

CsvTable table_of_columns(const Call& call, int index, const Options& options) {
    lua_State* L = call.state();
    CsvTable table;
    const bool chosen = options.has("columns");
    for (const std::string& name : chosen ? options.texts("columns") : names_of_entries(L, index)) {
        lua_getfield(L, index, name.c_str());
        table.names.push_back(name);
        table.columns.emplace_back();
        if (NumericBlock* column = to_vector(L, -1)) {
            table.columns.back() = column->vector();
        } else if (is_list_of(L, -1, LUA_TNUMBER)) {
            table.columns.back() = list_of_numbers(L, lua_gettop(L), name);
        } else if (is_list_of(L, -1, LUA_TSTRING)) {
            table.texts[name] = list_of_texts(L, lua_gettop(L));
        } else {
            refuse_entry(L, name, Message("a vector or a list of strings"));
        }
        lua_pop(L, 1);
    }
    return table;
}

/// Reads an option that is a table of texts by name.
std::map<std::string, std::string> texts_by_name(const Call& call, const Options& options, const char* option) {
    std::map<std::string, std::string> texts;
    if (!options.has(option)) return texts;
    lua_State* L = call.state();
    const int index = options.push(option);
    if (lua_type(L, index) != LUA_TTABLE)
        throw InvalidArgument("option '{}' must be a table such as {t = \"s\"}, but {} was given", option,
                              given_value(L, index));
    lua_pushnil(L);
    while (lua_next(L, index)) {
        if (lua_type(L, -2) != LUA_TSTRING || lua_type(L, -1) != LUA_TSTRING)
            throw InvalidArgument("option '{}' must contain only names with strings, such as {t = \"s\"}", option);
        texts[lua_tostring(L, -2)] = lua_tostring(L, -1);
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return texts;
}

int save_csv(Call& call) {
    call.at_most(3);
    const std::filesystem::path file = file_to_write(call, ".csv");
    const Options options(call, 3, kSaveCsvTables);
    const IdData* data = to_object<IdData>(call.state(), 2);
    if (data == nullptr && call.type(2) != LUA_TTABLE)
        wrong_argument(call.state(), 2, "data", Message("a data object or a table of named vectors"));
    CsvTable table = data != nullptr ? table_of_data(*data) : table_of_columns(call, 2, options);
    if (data != nullptr && options.has("columns")) table = selected_columns(table, options.texts("columns"));
    for (const auto& [name, unit] : texts_by_name(call, options, "units")) {
        if (std::ranges::find(table.names, name) == table.names.end())
            throw InvalidArgument("option 'units' contains the name '{}', but the columns of the file are {}", name,
                                  listed(table.names));
        table.units[name] = unit;
    }
    if (options.has("title")) table.remarks["title"] = options.text("title", "");
    options.read(table);
    if (table.Ts) check_sampling_time("save_csv", *table.Ts);
    write_csv_file(file, table, static_cast<int>(options.size("digits", 7)));
    return 0;
}

constexpr int kMaxSavedTableDepth = 16;

VariableTable variables_of(const Call& call, int index, int depth);

bool is_table_of_variables(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TTABLE || lua_rawlen(L, index) > 0) return false;
    lua_pushnil(L);
    if (lua_next(L, index) == 0) return false;
    lua_pop(L, 2);
    return true;
}

Variable structure(VariableTable fields) {
    return {std::make_shared<VariableTable>(std::move(fields))};
}

/// The entry on top of the stack as a variable of a MAT or JSON file.
Variable variable_on_top(const Call& call, const std::string& name, int depth) {
    lua_State* L = call.state();
    if (NumericBlock* column = to_vector(L, -1)) return {Vector(column->vector())};
    if (NumericBlock* matrix = to_matrix(L, -1)) return {Matrix(matrix->matrix())};
    if (const Model* model = to_object<Model>(L, -1)) return structure(struct_of(*model));
    if (const StateSpace* system = to_object<StateSpace>(L, -1)) return structure(struct_of(*system));
    if (const IdData* data = to_object<IdData>(L, -1)) return structure(struct_of(*data));
    if (lua_type(L, -1) == LUA_TNUMBER) return {lua_tonumber(L, -1)};
    if (lua_type(L, -1) == LUA_TSTRING) return {std::string(lua_tostring(L, -1))};
    if (is_table_of_variables(L, lua_gettop(L))) return structure(variables_of(call, lua_gettop(L), depth + 1));
    if (!is_list_of(L, -1, LUA_TSTRING))
        refuse_entry(L, name,
                     Message("a number, a string, a vector, a matrix, a model, a data object, a list of strings or a "
                             "table of these"));
    auto cells = std::make_shared<VariableList>();
    for (const std::string& text : list_of_texts(L, lua_gettop(L))) cells->push_back({text});
    return {cells};
}

VariableTable variables_of(const Call& call, int index, int depth) {
    if (depth > kMaxSavedTableDepth)
        throw InvalidArgument("tables can be nested at most {} levels deep in a file", kMaxSavedTableDepth);
    luaL_checkstack(call.state(), 8, "the tables are nested too deeply");
    VariableTable variables;
    for (const std::string& name : names_of_entries(call.state(), index)) {
        lua_getfield(call.state(), index, name.c_str());
        variables[name] = variable_on_top(call, name, depth);
        lua_pop(call.state(), 1);
    }
    return variables;
}

int save_mat(Call& call) {
    call.at_most(3);
    const std::filesystem::path file = file_to_write(call, ".mat");
    const Options options(call, 3, kSaveMatTables);
    if (call.type(2) != LUA_TTABLE) wrong_argument(call.state(), 2, "variables", Message("a table of named variables"));
    write_mat_file(file, variables_of(call, 2, 1), static_cast<int>(options.size("digits", 17)));
    return 0;
}

int save_json(Call& call) {
    call.at_most(2);
    const std::filesystem::path file = file_to_write(call, ".json");
    if (call.type(2) != LUA_TTABLE) wrong_argument(call.state(), 2, "variables", Message("a table of named variables"));
    write_json_file(file, variables_of(call, 2, 1));
    return 0;
}

constexpr FunctionEntry kSavingFunctions[] = {
    {"save_csv", "data", "save_csv(path, data, {options})", "Save data or a table of vectors as a CSV file",
     guarded<save_csv>, kSaveCsvTables, kSaveCsvArguments},
    {"save_mat", "data", "save_mat(path, variables, {options})",
     "Save models, data, vectors, numbers, strings and tables as a MAT file", guarded<save_mat>, kSaveMatTables,
     kSaveMatArguments},
    {"save_json", "data", "save_json(path, variables)",
     "Save models, data, vectors, numbers, strings and tables as a JSON file", guarded<save_json>, kNoOptions,
     kSaveJsonArguments},
};

}  // namespace

FunctionEntries saving_functions() {
    return kSavingFunctions;
}

}  // namespace dynlab::inline scripting
