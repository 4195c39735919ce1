#include <cstdio>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/document_command.h"
#include "numerics/error.h"
#include "platform/terminal/terminal_output.h"
#include "platform/text/read_number.h"
#include "workflow/identify.h"
#include "workflow/recording.h"

namespace dynlab::inline cli {
namespace {

struct IdentifyArguments {
    IdentifyRequest request;
    std::string report;
    bool script = false;
};

/// Nothing for "auto".
template <class Number>
std::optional<Number> number_or_auto(const std::string& text, const char* option, const std::string& requested) {
    const auto number = read_number<Number>(text);
    if (number || text == "auto") return number;
    throw CLI::ValidationError(option, "expected " + requested + " or the word auto, not '" + text + "'");
}

/// identification_script(), with advice for the user of the terminal about a file without a sampling time.
std::string script_of(const IdentifyRequest& request) {
    try {
        return identification_script(request);
    } catch (const UnknownSampling& error) {
        throw EnvironmentError(
            "{}; give --Ts SECONDS or --time NAME, or write '# Ts: 0.01' in the first line of a CSV file",
            message_of(error));
    }
}

int identify(const IdentifyArguments& args) {
    const std::string script = script_of(args.request);
    if (args.script) {
        print_now(script);
        return kDone;
    }
    const std::string stem = std::filesystem::path(args.request.data).stem().string();
    ReportRequest report = report_of_script(parse_percent_script(script, "identify.lua"),
                                            args.report.empty() ? stem + "_model.pdf" : args.report);
    report.print = print_now;
    return make_document(std::move(report), false);
}

}  // namespace

void add_identify(CLI::App& app, Action& action) {
    auto args = std::make_shared<IdentifyArguments>();
    IdentifyRequest& request = args->request;
    CLI::App* command =
        app.add_subcommand("identify", "Estimate a model and create a report from a data file, without Lua");
    command
        ->add_option("DATA", request.data,
                     "Data: a .mat file, a table (.csv, .txt, .dat, .tsv, .lvm, .xlsx), or the name of a data set")
        ->required();
    command
        ->add_option("--input", request.inputs,
                     "Columns or variables of the inputs, separated by commas or one option each")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->required();
    command
        ->add_option("--output", request.outputs,
                     "Columns or variables of the outputs, separated by commas; one model is estimated for each")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->required();
    command
        ->add_option_function<std::string>(
            "--poles",
            [&request](const std::string& text) {
                request.poles = number_or_auto<int>(text, "--poles", "a whole number");
            },
            "Number of poles, or auto: srivcstruc then selects the numbers of poles and zeros")
        ->type_name("N|auto")
        ->required();
    command
        ->add_option("--zeros", request.zeros, "Number of zeros. Default: 0; selected automatically with --poles auto.")
        ->type_name("N");
    command
        ->add_option_function<std::string>(
            "--delay",
            [&request](const std::string& text) {
                request.delay = number_or_auto<double>(text, "--delay", "a number of seconds");
            },
            "Delay in seconds, or auto to estimate it. Default: 0")
        ->type_name("SECONDS|auto");
    command->add_option("--Ts", request.Ts, "Sampling time, instead of the one in the file")->type_name("SECONDS");
    command->add_option("--time", request.time, "Name of the time column")->type_name("NAME");
    command
        ->add_option("--time-unit", request.time_unit,
                     "Unit of the time: s, ms, us, min, h, days; dd/mm/yyyy or mm/dd/yyyy")
        ->type_name("UNIT");
    command
        ->add_option_function<std::string>(
            "--inter-sample", [&request](const std::string& text) { request.moving_input = text == "foh"; },
            "Input between the samples: zoh (zero-order hold) or foh (linear interpolation). Default: zoh")
        ->type_name("zoh|foh")
        ->check(CLI::IsMember({"zoh", "foh"}));
    command->add_option("--validate", request.validation, "Validation data with the same names")->type_name("FILE");
    auto* report = command->add_option("-o,--output-file", args->report,
                                       "Report to create (.pdf, .html or .md). Default: DATA_model.pdf.");
    report->type_name("FILE");
    command->add_flag("--script", args->script, "Print the Lua script instead of creating a report")->excludes(report);
    command->footer(
        "The sampling time comes from the time column: the column that --time names, or a column that has the name t "
        "or "
        "time_ms,\nfor example, or a unit of time. The time steps may be unequal; dynlab converts ms, min and h to "
        "seconds. Without a time\ncolumn, the sampling time comes from the line # Ts: 0.01 of a CSV file, or from the "
        "variable Ts of a MAT file. The\ncolumns of a matrix y have the names y1, y2, ...; dynlab inspect DATA lists "
        "all "
        "names. dynlab replaces missing input\nsamples with the previous value, and missing output samples by linear "
        "interpolation. It prints a summary of each\nmodel; the report also contains figures. A message such as "
        "identify.lua:35 refers to line 35 of the script that\n--script prints.\nExample:  dynlab identify crane.csv "
        "--input u --output x,theta --poles 2 --zeros 0 --validate second.csv");
    command->callback([args, &action] {
        try {
            args->request.validate();
        } catch (const InvalidArgument& error) {
            throw CLI::ValidationError("identify", error.what());
        }
        action = [args] { return identify(*args); };
    });
}

}  // namespace dynlab::inline cli
