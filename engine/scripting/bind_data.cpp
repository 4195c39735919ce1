#include <algorithm>
#include <array>

#include "data_io/csv_file.h"
#include "data_io/dataset_index.h"
#include "figures/id_plot.h"
#include "scripting/bindings.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/model.h"
#include "scripting/output_path.h"

namespace dynlab {
namespace {

/// __index of the table that load returns; upvalue 1 is the data set's name.
int unknown_variable(lua_State* L) {
    std::vector<std::string> names;
    lua_pushnil(L);
    while (lua_next(L, 1)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -1));
    }
    std::sort(names.begin(), names.end());
    const std::string wanted = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : luaL_typename(L, 2);
    raise_error(L, fmt::format("the data of '{}' have no variable '{}'; they have {}",
                               lua_tostring(L, lua_upvalueindex(1)), wanted, fmt::join(names, ", ")));
}

void report_unknown_variables(lua_State* L, const std::string& name) {
    lua_createtable(L, 0, 2);
    lua_pushstring(L, name.c_str());
    lua_pushcclosure(L, unknown_variable, 1);
    lua_setfield(L, -2, "__index");
    lua_pushliteral(L, "data");
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
}

void push_variables(const Call& call, const VariableTable& variables) {
    luaL_checkstack(call.state(), 8, "the data are nested too deeply");
    lua_createtable(call.state(), 0, static_cast<int>(variables.size()));
    for (const auto& [name, variable] : variables) {
        push_variable(call, variable);
        lua_setfield(call.state(), -2, name.c_str());
    }
}

void push_list(const Call& call, const VariableList& list) {
    luaL_checkstack(call.state(), 8, "the data are nested too deeply");
    lua_createtable(call.state(), static_cast<int>(list.size()), 0);
    for (std::size_t i = 0; i < list.size(); ++i) {
        push_variable(call, list[i]);
        lua_rawseti(call.state(), -2, static_cast<lua_Integer>(i + 1));
    }
}

/// What each kind of variable becomes in Lua.
struct Pusher {
    const Call& call;
    void operator()(double value) const { call.give(value); }
    void operator()(bool value) const { call.give(value); }
    void operator()(const std::string& value) const { call.give(value); }
    void operator()(const Vector& value) const { call.give_vector(value); }
    void operator()(const Matrix& value) const { call.give_matrix(value); }
    void operator()(const Eigen::VectorXcd& value) const { push_object(call.state(), ComplexVector(value)); }
    void operator()(const Eigen::MatrixXcd& value) const {
        lua_createtable(call.state(), 0, 2);
        call.give_matrix(value.real());
        lua_setfield(call.state(), -2, "re");
        call.give_matrix(value.imag());
        lua_setfield(call.state(), -2, "im");
    }
    void operator()(const std::shared_ptr<VariableTable>& value) const { push_variables(call, *value); }
    void operator()(const std::shared_ptr<VariableList>& value) const { push_list(call, *value); }
};

int load(Call& call) {
    call.at_most(1);
    const std::string name = call.text(1, "name or path");
    const LoadedData loaded = load_data(name, call.context().options.script_folder);
    call.context().recorder.note_file_read(loaded.file);
    push_variables(call, loaded.variables);
    report_unknown_variables(call.state(), name);
    return 1;
}

/// Samples by channels; nothing for data without inputs.
Matrix signals(const Call& call, int index, const char* what, Index samples) {
    if (!call.given(index)) return Matrix(samples, 0);
    return call.matrix(index, what);
}

/// Names or units for every channel; one text stands for a single channel.
void set_texts(const Options& options, const char* name, std::vector<std::string>& texts, Index channels) {
    if (!options.has(name)) return;
    texts = options.texts(name);
    if (static_cast<Index>(texts.size()) != channels)
        throw InvalidArgument(
            fmt::format("option '{}' has {} texts, but there are {} channels", name, texts.size(), channels));
}

int make_iddata(Call& call) {
    call.at_most(4);
    const Options options(call, 4,
                          {"InterSample", "InputName", "OutputName", "InputUnit", "OutputUnit", "TimeUnit", "Tstart",
                           "SamplingInstants"});
    const Matrix y = call.matrix(1, "y"), u = signals(call, 2, "u", y.rows());
    IdData data = options.has("SamplingInstants") ? IdData(y, u, options.vector("SamplingInstants"))
                                                  : IdData(y, u, call.number_or(3, "Ts", 1));
    data.hold = options.choice("InterSample", {"zoh", "foh"}, 0) == 0 ? Hold::kZoh : Hold::kFoh;
    set_texts(options, "InputName", data.input_names, u.cols());
    set_texts(options, "OutputName", data.output_names, y.cols());
    set_texts(options, "InputUnit", data.input_units, u.cols());
    set_texts(options, "OutputUnit", data.output_units, y.cols());
    data.time_unit = options.text("TimeUnit", data.time_unit);
    data.experiments.front().start_time = options.number("Tstart", data.experiments.front().start_time);
    return give_data(call, std::move(data));
}

void add_channels(CsvTable& table, const Matrix& channels, const std::vector<std::string>& names,
                  const std::vector<std::string>& units) {
    for (Index j = 0; j < channels.cols(); ++j) {
        const auto place = static_cast<std::size_t>(j);
        table.names.push_back(names[place]);
        table.columns.push_back(channels.col(j));
        if (place < units.size() && !units[place].empty()) table.units[names[place]] = units[place];
    }
}

CsvTable table_of_data(const IdData& data) {
    if (data.experiments.size() != 1)
        throw InvalidArgument("a CSV file holds one experiment; write each with data:experiment(k)");
    CsvTable table;
    table.names.push_back("t");
    table.columns.push_back(data.time());
    table.units["t"] = data.time_unit;
    if (data.regular()) table.Ts = data.Ts;
    add_channels(table, data.experiments.front().u, data.input_names, data.input_units);
    add_channels(table, data.experiments.front().y, data.output_names, data.output_units);
    return table;
}

/// Columns in alphabetical order of their names, t first.
CsvTable table_of_columns(const Call& call, int index) {
    lua_State* L = call.state();
    CsvTable table;
    std::vector<std::string> names;
    lua_pushnil(L);
    while (lua_next(L, index)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) != LUA_TSTRING)
            throw InvalidArgument("the columns need names: save_csv(path, {t = t, y = y})");
        names.emplace_back(lua_tostring(L, -1));
    }
    std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
        return std::pair(a != "t", a) < std::pair(b != "t", b);
    });
    for (const std::string& name : names) {
        lua_getfield(L, index, name.c_str());
        NumericBlock* column = to_vector(L, -1);
        if (column == nullptr)
            throw InvalidArgument(fmt::format("the column {} must be a vector, but it is {}", name, given_text(L, -1)));
        table.names.push_back(name);
        table.columns.push_back(column->vector());
        lua_pop(L, 1);
    }
    return table;
}

int save_csv(Call& call) {
    call.at_most(2);
    const std::filesystem::path file = output_path(call.context(), call.text(1, "path"));
    if (file.extension() != ".csv")
        throw InvalidArgument(
            fmt::format("the file name must end in .csv, but '{}' does not", file.filename().string()));
    const IdData* data = to_object<IdData>(call.state(), 2);
    if (data == nullptr && call.type(2) != LUA_TTABLE)
        wrong_argument(call.state(), 2, "data", "iddata object or a table of vectors by name");
    write_csv_file(file, data != nullptr ? table_of_data(*data) : table_of_columns(call, 2));
    return 0;
}

/// idplot(data1, data2, ..., {labels = {...}})
int idplot(Call& call) {
    std::vector<const IdData*> all;
    int i = 1;
    for (; i <= call.count() && to_object<IdData>(call.state(), i) != nullptr; ++i)
        all.push_back(to_object<IdData>(call.state(), i));
    if (all.empty()) wrong_argument(call.state(), 1, "data", "iddata");
    call.at_most(i);
    return give_figure(call, id_plot(all, Options(call, i, {"labels"}).texts("labels")));
}

constexpr const char* kArea = "data";
constexpr std::array kFunctions = {
    FunctionEntry{"load", kArea, "load(name_or_path) -> table", "reads a data set of the course, a .mat or a .csv file",
                  guarded<load>},
    FunctionEntry{"iddata", kArea, "iddata(y, u, Ts, {InterSample =, InputName =, OutputName =, ...}) -> data",
                  "input-output data with their sampling", guarded<make_iddata>},
    FunctionEntry{"save_csv", kArea, "save_csv(path, data)", "writes data, or a table of vectors, as CSV",
                  guarded<save_csv>},
    FunctionEntry{"idplot", kArea, "idplot(data, ..., {labels =}) -> fig", "outputs above inputs over time",
                  guarded<idplot>},
};

}  // namespace

void push_variable(const Call& call, const Variable& variable) {
    std::visit(Pusher{call}, variable.value);
}

FunctionEntries data_functions() {
    return kFunctions;
}

}  // namespace dynlab
