#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "cli/commands.h"
#include "figures/gnuplot_renderer.h"
#include "numerics/error.h"
#include "workflow/look.h"

namespace dynlab::inline cli {
namespace {

struct LookArguments {
    std::string data, picture, delimiter;
    ImportOptions import;
    bool no_picture = false;
};

int look(const LookArguments& words) {
    const DataLook seen = look_at_data(words.data, words.import);
    std::fwrite(seen.text.data(), 1, seen.text.size(), stdout);
    std::fflush(stdout);
    if (!seen.figure || words.no_picture) return kDone;
    const std::filesystem::path file =
        words.picture.empty() ? std::filesystem::path(words.data).stem().string() + "_look.pdf" : words.picture;
    GnuplotRenderer renderer;
    renderer.draw(*seen.figure, file, figure_format(file));
    renderer.finish();
    fmt::print("\npicture: {}\n", file.string());
    return kDone;
}

}  // namespace

void add_look(CLI::App& app, Action& action) {
    auto words = std::make_shared<LookArguments>();
    CLI::App* command = app.add_subcommand("look", "What a data file holds: columns, units, sampling, gaps, a picture");
    command
        ->add_option("DATA", words->data,
                     "A .mat file, a table (.csv, .txt, .dat, .tsv, .lvm, .xlsx), or a data set's name")
        ->required();
    auto* picture = command->add_option("-o,--output-file", words->picture,
                                        "The picture (.pdf, .svg or .png), DATA_look.pdf unless given");
    picture->type_name("FILE");
    command->add_flag("--no-picture", words->no_picture, "Text only")->excludes(picture);
    command->add_option("--skip", words->import.skip, "Lines at the beginning that do not belong to the table")
        ->type_name("N");
    command->add_option("--delimiter", words->delimiter, "What stands between cells; \" \" for blanks and tabs")
        ->type_name("CHARACTER");
    command->add_option("--time", words->import.time, "Name of the column that holds the time")->type_name("NAME");
    command
        ->add_option("--time-unit", words->import.time_unit,
                     "Unit of the time: s, ms, us, min, h, days; dd/mm/yyyy or mm/dd/yyyy")
        ->type_name("UNIT");
    command->add_option("--sheet", words->import.sheet, "Name of a workbook's sheet, its first one unless given")
        ->type_name("NAME");
    command->footer(
        "What had to be guessed is listed below the first line. load in a script reads the same; its options skip, "
        "delimiter,\nsheet, time, names and units say what is guessed wrongly.\n"
        "Example:  dynlab look record.csv -o record.png");
    command->callback([words, &action] {
        if (words->delimiter.size() > 1)
            throw CLI::ValidationError("--delimiter", "wanted one character, not '" + words->delimiter + "'");
        if (!words->delimiter.empty()) words->import.delimiter = words->delimiter.front();
        try {
            if (!words->picture.empty()) figure_format(words->picture);
        } catch (const InvalidArgument& error) {
            throw CLI::ValidationError("--output-file", error.what());
        }
        action = [words] { return look(*words); };
    });
}

}  // namespace dynlab::inline cli
