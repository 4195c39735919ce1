#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "base/reader.h"
#include "data_io/dataset_index.h"
#include "data_io/tables/time_text.h"
#include "figures/plots/id_plot.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/model.h"
#include "scripting/objects/units.h"

namespace dynlab::inline scripting {
namespace {

constexpr OptionEntry kImportOptions[] = {
    option<&ImportOptions::skip>("skip", about("number of lines to skip at the beginning of a text file")),
    {"names", ValueKind::kAny, about("names of all columns, which replace the names in the file")},
    {"delimiter", ValueKind::kText, about("separator of the cells; \" \" for any number of spaces and tabs")},
    {"units", ValueKind::kTable, about("units by column, such as {u = \"V\"}, which replace the units in the file")},
    option<&ImportOptions::time>("time", about("name of the time column")),
    option<&ImportOptions::time_unit>(
        "time_unit", about("unit of the time column; \"dd/mm/yyyy\" or \"mm/dd/yyyy\" if the column contains dates")),
    option<&ImportOptions::sheet>("sheet", about("name of the sheet of a workbook; by default, the first sheet"))};
constexpr OptionEntry kIddataOptions[] = {
    option<&IdData::hold>("InterSample", kHoldOption.description,
                          {.initial = "\"zoh\"", .choices = kHolds, .member = "hold"}),
    {"InputName", ValueKind::kAny, about("name of the input, or a list of names of several inputs")},
    {"OutputName", ValueKind::kAny, about("name of the output, or a list of names of several outputs")},
    {"InputUnit", ValueKind::kAny,
     about("unit of the input, or a list of units; by default, the unit of the column returned by `load`")},
    {"OutputUnit", ValueKind::kAny,
     about("unit of the output, or a list of units; by default, the unit of the column returned by `load`")},
    option<&IdData::time_unit>("TimeUnit", about("unit of `Ts`, `Tstart` and all instants"), {.initial = "\"s\""}),
    {"Tstart", ValueKind::kNumber, about("time of the first sample"), {.initial = "0"}},
    {"SamplingInstants",
     ValueKind::kVector,
     about("increasing sampling instants of irregularly sampled data, instead of `Ts`"),
     {.member = "sampling_instants"}},
    {"Reference", ValueKind::kAny, about("N samples of the reference of the control loop: a vector or a matrix")}};
constexpr std::array kIdplotOptions = {kLabelsOption};
constexpr OptionTable kImportTables[] = {kImportOptions}, kIddataTables[] = {kIddataOptions},
                      kIdplotTables[] = {kIdplotOptions};

constexpr ArgumentEntry kLoadArguments[] = {
    {"name_or_path", ValueKind::kText,
     about("name of a data set, such as \"winning_times\", or path of a file, such as \"my_record.csv\"")}};
constexpr ArgumentEntry kIddataArguments[] = {
    {"y", ValueKind::kAny,
     about("N output samples: a vector, or a matrix with one column per output; nil for inputs only")},
    {"u", ValueKind::kAny,
     about("N input samples: a vector, or a matrix with one column per input; nil for a time series")},
    {"Ts", ValueKind::kNumber, about("sampling time in `TimeUnit`; by default 1, with a printed note")}};
constexpr ArgumentEntry kIdplotArguments[] = {
    {"data, ...", ValueKind::kData, about("data objects with the same channels")},
    {"first, last", ValueKind::kCount, about("for one data object, first and last sample to plot")}};

/// `path` is the name by which messages speak of what is pushed, such as crane.steps.
void push_variable(const Call& call, const Variable& variable, const std::string& path);

void push_variables(const Call& call, const VariableTable& variables, const std::string& path) {
    luaL_checkstack(call.state(), 8, "the data are nested too deeply");
    lua_createtable(call.state(), 0, static_cast<int>(variables.size()));
    for (const auto& [name, variable] : variables) {
        push_variable(call, variable, path + "." + name);
        lua_setfield(call.state(), -2, name.c_str());
    }
    refuse_unknown_fields(call.state(), path);
}

void push_list(const Call& call, const VariableList& list, const std::string& path) {
    luaL_checkstack(call.state(), 8, "the data are nested too deeply");
    std::size_t number = 0;
    give_list(call, list,
              [&](const Variable& one) { push_variable(call, one, fmt::format("{}[{}]", path, ++number)); });
}

/// What each kind of variable becomes in Lua.
struct Pusher {
    const Call& call;
    const std::string& path;
    void operator()(const auto& value) const { give_value(call, value); }
    void operator()(const Eigen::MatrixXcd& value) const {
        give_table(call, "re", Matrix(value.real()), "im", Matrix(value.imag()));
    }
    void operator()(const std::shared_ptr<VariableTable>& value) const { push_variables(call, *value, path); }
    void operator()(const std::shared_ptr<VariableList>& value) const { push_list(call, *value, path); }
};

void push_variable(const Call& call, const Variable& variable, const std::string& path) {
    std::visit(Pusher{call, path}, variable.value);
}

/// Where a script is graded or checked it reads the course's data and what lies in its own folder, and nothing else.
void check_stays_inside(const std::filesystem::path& path) {
    const bool leads_out = std::find(path.begin(), path.end(), "..") != path.end();
    if (path.is_absolute() || leads_out) throw InvalidArgument(refusal_outside(path.string()));
}

std::map<std::string, std::string> units_by_name(const Options& options) {
    std::map<std::string, std::string> units;
    if (!options.has("units")) return units;
    lua_State* L = options.call().state();
    const int index = options.push("units");
    const auto refuse = [] {
        throw InvalidArgument("option 'units' must be a table of column names and their units, such as {u = \"V\"}");
    };
    if (lua_type(L, index) != LUA_TTABLE) refuse();
    lua_pushnil(L);
    while (lua_next(L, index)) {
        if (lua_type(L, -2) != LUA_TSTRING || lua_type(L, -1) != LUA_TSTRING) refuse();
        units[lua_tostring(L, -2)] = lua_tostring(L, -1);
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return units;
}

ImportOptions import_options(const Options& options) {
    ImportOptions import;
    options.read(import);
    import.names = options.texts("names");
    const std::string delimiter = options.text("delimiter", "");
    if (delimiter.size() > 1)
        throw InvalidArgument("{} must be {}, but \"{}\" was given", option_label("delimiter"),
                              Message("one character (\" \" for spaces and tabs)"), delimiter);
    if (!delimiter.empty()) import.delimiter = delimiter.front();
    import.units = units_by_name(options);
    return import;
}

/// Each column knows its unit, which iddata takes over, and its time; the table on top of the stack has them all as
/// `units`, and gives its columns by the names that the file has for them, too.
void add_units_and_headers(const Call& call, const LoadedData& loaded) {
    lua_State* L = call.state();
    const int table = lua_gettop(L);
    lua_newtable(L);
    for (const auto& [header, name] : loaded.headers) {
        lua_getfield(L, table, name.c_str());
        lua_setfield(L, -2, header.c_str());
    }
    lua_createtable(L, 0, static_cast<int>(loaded.units.size()));
    for (const auto& [name, unit] : loaded.units) set_field(call, name.c_str(), unit);
    const std::optional<Clock>& clock = loaded.time.clock;
    for (const auto& [name, variable] : loaded.variables) {
        const auto unit = loaded.units.find(name);
        ColumnOrigin origin;
        if (unit != loaded.units.end()) origin.unit = unit->second;
        const Vector* column = std::get_if<Vector>(&variable.value);
        if (clock && clock->spacing.even && column != nullptr && column->size() == clock->t.size())
            origin.Ts = clock->spacing.step, origin.clock = clock->name;
        if (origin.unit.empty() && origin.Ts == 0) continue;
        lua_getfield(L, table, name.c_str());
        set_column_origin(L, -1, origin);
        lua_pop(L, 1);
    }
    lua_setfield(L, -2, "units");
    add_hidden_fields(L);
}

/// What a call of load looked for in vain: where one of these files comes, or is repaired, the script reads it.
void note_candidate_files(const Call& call, const std::string& name) {
    const std::filesystem::path file = call.context().options.script_folder / name;
    Recorder& recorder = call.context().recorder;
    recorder.note_file_read(file);
    if (file.has_extension()) return;
    for (const char* ending : {".csv", ".mat"}) recorder.note_file_read(file.string() + ending);
}

int load(Call& call) {
    call.at_most(2);
    const Options options(call, 2, kImportTables);
    const std::string name = call.text(1, Message("name or path"));
    const RunOptions& run = call.context().options;
    if (run.graded || run.stay_in_folder) check_stays_inside(name);
    const ImportOptions import = import_options(options);
    const LoadedData loaded = [&] {
        try {
            return load_data(name, run.script_folder, run.graded, import);
        } catch (...) {
            note_candidate_files(call, name);
            throw;
        }
    }();
    call.context().recorder.note_file_read(loaded.file);
    for (const Message& note : loaded.notes)
        call.print(localized(call, Message("{}: {}", loaded.file.filename().string(), note)) + "\n");
    push_variables(call, loaded.variables, name);
    add_units_and_headers(call, loaded);
    return 1;
}

/// Samples by channels; nothing for data without inputs.
Matrix signals(const Call& call, int index, ArgumentName what, Index samples) {
    if (!call.given(index)) return Matrix(samples, 0);
    return call.matrix(index, what);
}

/// Names or units for every channel; a single text is valid for a single channel.
void set_texts(const Options& options, const char* name, std::vector<std::string>& texts, Index channels) {
    if (!options.has(name)) return;
    texts = options.texts(name);
    if (static_cast<Index>(texts.size()) != channels)
        throw InvalidArgument("option '{}' has {} for {}; the two numbers must be equal", name,
                              plural(texts.size(), "{} string", "{} strings"),
                              plural(channels, "{} channel", "{} channels"));
}

/// The same for units; a column that load() gave brings its own.
void set_units(const Options& options, const char* name, int argument, std::vector<std::string>& units,
               Index channels) {
    set_texts(options, name, units, channels);
    if (options.has(name) || channels != 1 || !options.call().given(argument)) return;
    if (const std::string unit = column_origin(options.call().state(), argument).unit; !unit.empty()) units = {unit};
}

/// Figures, tables and choices of channels speak of them by name.
void check_names(const IdData& data) {
    std::set<std::string> seen;
    for (const auto* names : {&data.input_names, &data.output_names})
        for (const std::string& name : *names)
            if (!seen.insert(name).second)
                throw InvalidArgument(
                    "the name '{}' is used for two channels: give each a different InputName or OutputName", name);
}

/// Once in a run: time constants come out in samples where seconds are meant.
void report_default_sampling_time(const Call& call) {
    if (std::exchange(call.context().sampling_time_reported, true)) return;
    call.print(
        localized(call, Message("iddata: no sampling time was given, so dynlab uses 1 s; write iddata(y, u, Ts)")) +
        "\n");
}

/// A sampling time that is not that of the columns.
void report_different_clock(const Call& call, const IdData& data) {
    const auto unit = seconds_of(data.time_unit, true);
    for (const int argument : {1, 2}) {
        const ColumnOrigin origin = column_origin(call.state(), argument);
        constexpr double kClose = 0.01;
        if (!unit || origin.Ts == 0 || std::abs(data.Ts * *unit - origin.Ts) <= kClose * origin.Ts) continue;
        call.print(
            localized(call, Message("iddata: the sampling time is {} {}, but according to the time column '{}' of the "
                                    "file it is {} s; check the argument Ts",
                                    significant(data.Ts, 6), data.time_unit, origin.clock, significant(origin.Ts, 6))) +
            "\n");
        return;
    }
}

/// Once in a run: models do not know the unit of their data's time.
void report_time_unit(const Call& call, const std::string& unit) {
    if (unit == "s" || std::exchange(call.context().time_unit_reported, true)) return;
    call.print(localized(call, Message("iddata: these data, and models estimated from them, have the time unit {}. If "
                                       "a message or an axis label shows the unit s, the actual unit is {}",
                                       unit, unit)) +
               "\n");
}

/// Instants at even distances, within rounding, make data that are sampled regularly.
void make_regular(IdData& data) {
    Experiment& experiment = data.experiments.front();
    if (experiment.t.size() < 2) return;
    const InstantSpacing spacing = spacing_of(experiment.t);
    if (!spacing.even) return;
    data.Ts = written_step(spacing.step, experiment.t.size());
    experiment.t.resize(0);
}

/// One column for each reference.
Matrix reference_of(const Options& options) {
    lua_State* L = options.call().state();
    if (NumericBlock* block = to_matrix(L, options.push("Reference")))
        return MatrixMap(block->data(), block->rows, block->columns);
    return options.vector("Reference");
}

int make_iddata(Call& call) {
    call.at_most(4);
    const Options options(call, 4, kIddataTables);
    if (call.holds_vector(3))
        throw InvalidArgument(
            "{} must be a number of seconds, but instants were given; for irregularly sampled data, write iddata(y, u, "
            "nil, {SamplingInstants = t})",
            argument_label(3, "Ts"));
    if (call.count() > 0 && !call.given(1) && !call.given(2))
        throw InvalidArgument("y and u are both nil; specify at least one of them");
    const bool inputs_only = !call.given(1) && call.given(2);
    const Matrix y = inputs_only ? Matrix(call.matrix(2, "u").rows(), 0) : Matrix(call.matrix(1, "y"));
    const Matrix u = signals(call, 2, "u", y.rows());
    const bool has_instants = options.has("SamplingInstants");
    IdData data =
        has_instants ? IdData(y, u, options.vector("SamplingInstants")) : IdData(y, u, call.number_or(3, "Ts", 1));
    if (!has_instants && !call.given(3)) report_default_sampling_time(call);
    if (has_instants) make_regular(data);
    options.read(data);
    if (!has_instants && call.given(3)) report_different_clock(call, data);
    set_texts(options, "InputName", data.input_names, u.cols());
    set_texts(options, "OutputName", data.output_names, y.cols());
    set_units(options, "InputUnit", 2, data.input_units, u.cols());
    set_units(options, "OutputUnit", 1, data.output_units, y.cols());
    check_names(data);
    report_time_unit(call, data.time_unit);
    if (options.has("Tstart") && options.has("SamplingInstants"))
        throw InvalidArgument(
            "option 'Tstart' cannot be combined with 'SamplingInstants', which include the first instant; "
            "omit 'Tstart'");
    data.experiments.front().start_time = options.number("Tstart", data.experiments.front().start_time);
    if (!std::isfinite(data.experiments.front().start_time))
        throw InvalidArgument("option 'Tstart' must be a finite number, but {} was given",
                              data.experiments.front().start_time);
    if (options.has("Reference")) data = data.with_reference(reference_of(options));
    return give_data(call, std::move(data));
}

/// idplot(data, first, last): these samples.
int plot_part(Call& call) {
    call.at_most(3);
    const IdData part = signals_of_argument(call, 1, "data").range(call.integer(2, "first"), call.integer(3, "last"));
    return give_figure(call, id_plot({&part}, {}));
}

int idplot(Call& call) {
    if (call.type(2) == LUA_TNUMBER) return plot_part(call);
    std::vector<const IdData*> all;
    int i = 1;
    for (; i <= call.count() && to_object<IdData>(call.state(), i) != nullptr; ++i)
        all.push_back(to_object<IdData>(call.state(), i));
    if (all.empty()) wrong_argument(call.state(), 1, "data", with_article("iddata"));
    call.at_most(i);
    return give_figure(call, id_plot(all, Options(call, i, kIdplotTables).texts("labels")));
}

constexpr FunctionEntry kDataFunctions[] = {
    {"load", "data", "load(name_or_path, {options}) -> table",
     "Load a data set of the course, a .mat or .json file, or a table in a text file or workbook", guarded<load>,
     kImportTables, kLoadArguments},
    {"iddata", "data", "iddata(y, u, Ts, {options}) -> data", "Create a data object from output and input signals",
     guarded<make_iddata>, kIddataTables, kIddataArguments},
    {"idplot", "data", "idplot(data, ..., {options}) -> fig; idplot(data, first, last)",
     "Plot outputs and inputs versus time", guarded<idplot>, kIdplotTables, kIdplotArguments},
};

}  // namespace

FunctionEntries data_functions() {
    return kDataFunctions;
}

}  // namespace dynlab::inline scripting
