#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "figures/gnuplot_renderer.h"
#include "platform/written_files.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/prompt/completion.h"
#include "scripting/runtime/prompt_statement.h"

namespace dynlab::inline scripting {

/// The outcome of a statement, apart from the printed text.
struct StatementResult {
    std::optional<RecordedError> error;          ///< with its place ("prompt", 2); nothing when all went well
    std::vector<std::filesystem::path> figures;  ///< files of the figures it made, also before an error
};

/// Sees a figure as it is made, with the name of its file.
using FigureListener = std::function<void(const std::string& name, const Figure& figure)>;

/// The statements of one session: variables, random numbers and the count of figures live on from one to the next.
class PromptSession {
  public:
    /// Figures go to `figure_folder`, made with the first one, as figure-1.pdf, figure-2.pdf, ...; the numbers go on
    /// after those of the files that are there, so that no figure is overwritten.
    PromptSession(std::filesystem::path figure_folder, std::function<void(const std::string&)> print,
                  FigureListener see = {});

    /// Messages use `name` as the file's name. Ctrl-C ends the statement with the error "interrupted" (while an
    /// InterruptScope lives). The function never throws because of a statement.
    StatementResult run(const PromptStatement& statement, const std::string& name);
    Completion complete_end(std::string_view text);  ///< of a statement, up to the cursor

  private:
    void save_figures(const RunRecord& record, StatementResult& result);

    WrittenFiles written_;  ///< outlives the renderer, which draws into them
    GnuplotRenderer renderer_;
    std::filesystem::path figure_folder_;
    FigureListener see_;
    std::optional<unsigned> last_figure_;  ///< once the folder was looked at
    Runtime runtime_;
};

}  // namespace dynlab::inline scripting
