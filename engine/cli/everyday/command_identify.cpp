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
std::optional<Number> number_or_auto(const std::string& text, const char* option, const std::string& wanted) {
    const auto number = read_number<Number>(text);
    if (number || text == "auto") return number;
    throw CLI::ValidationError(option, "wanted " + wanted + " or the word auto, not '" + text + "'");
}

/// identification_script(), with what somebody at the terminal can do about a file without a sampling time.
std::string script_of(const IdentifyRequest& request) {
    try {
        return identification_script(request);
    } catch (const UnknownSampling& error) {
        throw EnvironmentError(
            "{}; give --Ts SECONDS or --time NAME, or write '# Ts: 0.01' into the first line of a CSV file",
            message_of(error));
    }
}

int identify(const IdentifyArguments& words) {
    const std::string script = script_of(words.request);
    if (words.script) {
        print_now(script);
        return kDone;
    }
    const std::string stem = std::filesystem::path(words.request.data).stem().string();
    ReportRequest report = report_of_script(parse_percent_script(script, "identify.lua"),
                                            words.report.empty() ? stem + "_model.pdf" : words.report);
    report.print = print_now;
    return make_document(std::move(report), false);
}

}  // namespace

void add_identify(CLI::App& app, Action& action) {
    auto words = std::make_shared<IdentifyArguments>();
    IdentifyRequest& request = words->request;
    CLI::App* command = app.add_subcommand("identify", "A model and a report from a data file, without writing Lua");
    command
        ->add_option("DATA", request.data,
                     "The record: a .mat file, a table (.csv, .txt, .dat, .tsv, .lvm, .xlsx), or a data set's name")
        ->required();
    command
        ->add_option("--input", request.inputs,
                     "Names of the inputs' columns or variables, with commas between them or one option each")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->required();
    command->add_option("--output", request.outputs, "Names of the outputs, with commas between them; one model each")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->required();
    command
        ->add_option_function<std::string>(
            "--poles",
            [&request](const std::string& text) {
                request.poles = number_or_auto<int>(text, "--poles", "a whole number");
            },
            "Number of poles, or the word auto: then srivcstruc finds it, and the zeros with it")
        ->type_name("N|auto")
        ->required();
    command->add_option("--zeros", request.zeros, "Number of zeros; 0 unless given, with --poles auto found")
        ->type_name("N");
    command
        ->add_option_function<std::string>(
            "--delay",
            [&request](const std::string& text) {
                request.delay = number_or_auto<double>(text, "--delay", "a number of seconds");
            },
            "Delay in seconds, or the word auto: then it is estimated. 0 unless given")
        ->type_name("SECONDS|auto");
    command->add_option("--Ts", request.Ts, "Sampling time, instead of what the file says")->type_name("SECONDS");
    command->add_option("--time", request.time, "Name of the column that holds the time")->type_name("NAME");
    command
        ->add_option("--time-unit", request.time_unit,
                     "Unit of the time: s, ms, us, min, h, days; dd/mm/yyyy or mm/dd/yyyy")
        ->type_name("UNIT");
    command
        ->add_option_function<std::string>(
            "--inter-sample", [&request](const std::string& text) { request.moving_input = text == "foh"; },
            "Inputs between the samples: zoh (held) or foh (straight lines). Default: zoh")
        ->type_name("zoh|foh")
        ->check(CLI::IsMember({"zoh", "foh"}));
    command->add_option("--validate", request.validation, "A record with the same names, to test the model on")
        ->type_name("FILE");
    auto* report = command->add_option("-o,--output-file", words->report,
                                       "The report (.pdf, .html or .md), DATA_model.pdf unless given");
    report->type_name("FILE");
    command->add_flag("--script", words->script, "Print the Lua script that does it, and do nothing else")
        ->excludes(report);
    command->footer(
        "The sampling time is that of the column --time, or of the one that is called a time (t, time_ms, ...) or has "
        "a\n"
        "unit of time; its steps may differ, and ms, min and h become seconds. Without such a column it is the one a "
        "CSV\n"
        "file states (# Ts: 0.01), or a MAT file's variable Ts. A column of a matrix y is called y1, y2, ...; dynlab "
        "look\n"
        "DATA shows what there is. Missing samples of inputs hold the value before them, those of outputs are "
        "interpolated.\nThe summary is printed; the report also shows figures.\n"
        "A message such as identify.lua:35 speaks of line 35 of what --script prints.\n"
        "Example:  dynlab identify crane.csv --input u --output x,theta --poles 2 --zeros 0 --validate second.csv");
    command->callback([words, &action] {
        try {
            words->request.validate();
        } catch (const InvalidArgument& error) {
            throw CLI::ValidationError("identify", error.what());
        }
        action = [words] { return identify(*words); };
    });
}

}  // namespace dynlab::inline cli
