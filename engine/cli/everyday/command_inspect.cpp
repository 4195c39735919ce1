#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "cli/commands.h"
#include "figures/gnuplot_renderer.h"
#include "numerics/error.h"
#include "workflow/data_summary.h"

namespace dynlab::inline cli {
namespace {

struct InspectArguments {
    std::string data, picture, delimiter;
    ImportOptions import;
    bool no_picture = false;
};

int inspect(const InspectArguments& args) {
    const DataSummary seen = summarize_data(args.data, args.import);
    std::fwrite(seen.text.data(), 1, seen.text.size(), stdout);
    std::fflush(stdout);
    if (!seen.figure || args.no_picture) return kDone;
    const std::filesystem::path file =
        args.picture.empty() ? std::filesystem::path(args.data).stem().string() + "_inspect.pdf" : args.picture;
    GnuplotRenderer renderer;
    renderer.draw(*seen.figure, file, figure_format(file));
    renderer.finish();
    fmt::print("\npicture: {}\n", file.string());
    return kDone;
}

}  // namespace

void add_inspect(CLI::App& app, Action& action) {
    auto args = std::make_shared<InspectArguments>();
    CLI::App* command =
        app.add_subcommand("inspect", "Inspect a data file: columns, units, sampling time, gaps, and a picture");
    command
        ->add_option("DATA", args->data,
                     ".mat file, table (.csv, .txt, .dat, .tsv, .lvm, .xlsx), or name of a data set")
        ->required();
    auto* picture = command->add_option("-o,--output-file", args->picture,
                                        "Picture to create (.pdf, .svg or .png). Default: DATA_inspect.pdf.");
    picture->type_name("FILE");
    command->add_flag("--no-picture", args->no_picture, "Print the text without a picture")->excludes(picture);
    command->add_option("--skip", args->import.skip, "Number of lines to skip before the table")->type_name("N");
    command->add_option("--delimiter", args->delimiter, "Separator of the cells; \" \" for blanks and tabs")
        ->type_name("CHARACTER");
    command->add_option("--time", args->import.time, "Name of the time column")->type_name("NAME");
    command
        ->add_option("--time-unit", args->import.time_unit,
                     "Unit of the time: s, ms, us, min, h, days; dd/mm/yyyy or mm/dd/yyyy")
        ->type_name("UNIT");
    command->add_option("--sheet", args->import.sheet, "Name of a workbook's sheet. Default: the first sheet.")
        ->type_name("NAME");
    command->footer(
        "dynlab lists its assumptions below the first line. In a script, load reads the file in the same way. If an "
        "assumption is\nwrong, correct it with the options above, or with the options skip, delimiter, sheet, time, "
        "names and units of load.\n"
        "Example:  dynlab inspect record.csv -o record.png");
    command->callback([args, &action] {
        if (args->delimiter.size() > 1)
            throw CLI::ValidationError("--delimiter", "expected one character, not '" + args->delimiter + "'");
        if (!args->delimiter.empty()) args->import.delimiter = args->delimiter.front();
        try {
            if (!args->picture.empty()) figure_format(args->picture);
        } catch (const InvalidArgument& error) {
            throw CLI::ValidationError("--output-file", error.what());
        }
        action = [args] { return inspect(*args); };
    });
}

}  // namespace dynlab::inline cli
