#include "workflow/site/help_examples.h"

#include "documents/error.h"
#include "documents/text_lines.h"
#include "figures/gnuplot_renderer.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/runtime/help.h"

namespace dynlab::inline workflow {
namespace {

bool is_function(std::string_view name) {
    for (const FunctionEntry& entry : catalog_of_functions())
        if (entry.name == name) return true;
    return false;
}

Cell cell_of(Cell::Kind kind, const std::string& id, const std::string& content) {
    Cell cell;
    cell.kind = kind;
    cell.id = id;
    cell.content = content;
    return cell;
}

/// The page in cells: before its first Lua code, that code if it is a function's example, and what follows.
PercentScript page_in_cells(const HelpPage& page) {
    PercentScript script;
    script.file = std::string(page.name) + ".md";
    const std::string text = page_text(page, find_function(std::string(page.name))), begin = "\n```lua\n",
                      end = "\n```\n";
    const std::size_t code = is_function(page.name) ? text.find(begin) : std::string::npos;
    if (code == std::string::npos) {
        script.cells = {cell_of(Cell::Kind::kText, "text", text)};
        return script;
    }
    const std::size_t first = code + begin.size(), last = text.find(end, first);
    script.cells = {cell_of(Cell::Kind::kText, "before", text.substr(0, code + 1)),
                    cell_of(Cell::Kind::kCode, std::string(page.name), text.substr(first, last + 1 - first)),
                    cell_of(Cell::Kind::kText, "after", text.substr(last + end.size()))};
    return script;
}

/// Adds the results of the example, under names with the page's prefix. A figure that the example reported by name is
/// shown after the others.
void take_results(const std::string& page, RunRecord run, RunRecord& all) {
    const auto renamed = [&](const std::string& figure) { return replaced(page, ".", "-") + "-" + figure; };
    std::vector<CellOutput>& outputs = all.outputs[page];
    std::map<std::string, bool> shown;
    for (auto& [cell, given] : run.outputs)
        for (CellOutput& output : given) {
            if (output.figure) {
                shown[*output.figure] = true;
                output.figure = renamed(*output.figure);
            }
            outputs.push_back(std::move(output));
        }
    const std::size_t before = all.figures.size();
    for (auto& [name, figure] : run.figures) {
        figure.caption.clear();
        figure.order += before;
        if (!shown[name]) outputs.push_back({"", renamed(name)});
        all.figures.emplace(renamed(name), std::move(figure));
    }
}

}  // namespace

HelpExamples run_help_examples(const std::filesystem::path& folder, const Cache& cache) {
    HelpExamples examples;
    CallCache calls(cache);
    GnuplotRenderer renderer(&cache);
    for (const HelpPage& page : help_pages()) {
        const std::string name(page.name);
        PercentScript script = page_in_cells(page);
        if (script.cells.size() > 1) {
            RunOptions options;
            options.out_folder = options.script_folder = folder;
            options.call_cache = &calls;
            RunRecord run = Runtime(options, renderer).run_code(script.cells[1].content, name + ".lua");
            if (run.error) throw DocumentError(Message("the example of the help page {}: {}", name, run.error->text()));
            take_results(name, std::move(run), examples.record);
        }
        examples.pages.emplace(name, std::move(script));
    }
    renderer.finish();
    return examples;
}

}  // namespace dynlab::inline workflow
