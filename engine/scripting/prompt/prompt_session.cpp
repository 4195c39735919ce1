#include "scripting/prompt/prompt_session.h"

#include <fmt/format.h>

#include "base/error.h"
#include "platform/error.h"
#include "platform/text/read_number.h"

namespace dynlab::inline scripting {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kStem = "figure-";

/// The highest number of the files figure-N.pdf in `folder`, 0 when there is none.
unsigned highest_figure(const fs::path& folder) {
    unsigned highest = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string stem = entry.path().stem().string();
        if (!stem.starts_with(kStem)) continue;
        highest = std::max(highest, read_number<unsigned>(stem.substr(kStem.size())).value_or(0));
    }
    return highest;
}

RunOptions options_of_prompt(std::function<void(const std::string&)> print) {
    RunOptions options;
    options.print = std::move(print);
    return options;
}

}  // namespace

PromptSession::PromptSession(fs::path figure_folder, std::function<void(const std::string&)> print, FigureListener see)
    : written_(state_file("written")),
      figure_folder_(std::move(figure_folder)),
      see_(std::move(see)),
      runtime_(options_of_prompt(std::move(print)), renderer_) {
    runtime_.services().written = &written_;
}

StatementResult PromptSession::run(const PromptStatement& statement, const std::string& name) {
    StatementResult result;
    try {
        const RunRecord record = runtime_.run_statement(statement, name);
        result.error = record.error;
        save_figures(record, result);
    } catch (const Interrupted& error) {
        result.error = RecordedError{message_of(error)};
    } catch (const std::exception& error) {
        if (result.error)
            result.error->message = Message("{}; {}", result.error->message, message_of(error));
        else
            result.error = RecordedError{message_of(error)};
    }
    written_.settle();
    return result;
}

/// Also waits for the files that the statement saved itself.
void PromptSession::save_figures(const RunRecord& record, StatementResult& result) {
    std::vector<fs::path> files;
    if (!record.figures.empty()) {
        fs::create_directories(figure_folder_);
        if (!last_figure_) last_figure_ = highest_figure(figure_folder_);
    }
    for (const auto& [name, figure] : record.figures) {
        const fs::path file = figure_folder_ / fmt::format("{}{}.pdf", kStem, ++*last_figure_);
        renderer_.draw(*figure.figure, file, FigureFormat::kPdf);
        if (see_) see_(file.filename().string(), *figure.figure);
        files.push_back(file);
    }
    renderer_.finish();
    result.figures = std::move(files);
}

Completion PromptSession::complete_end(std::string_view text) {
    return complete(runtime_.state(), text);
}

}  // namespace dynlab::inline scripting
