#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/reader.h"
#include "documents/percent_script.h"
#include "documents/run_record.h"
#include "figures/figure.h"

namespace dynlab::inline scripting {

/// A figure as a script holds it. `used`: it was put somewhere (report.figure, subplot, save), so that its cell does
/// not capture it.
struct ScriptFigure {
    Figure figure;
    bool used = false;
    std::optional<long long> number;  ///< given by figure(n)
    std::size_t order = 0;            ///< in the order in which the script made its figures
};

using FigurePointer = std::shared_ptr<ScriptFigure>;

/// Collects what a run produces and gives each piece to the cell whose line the main chunk is at.
class Recorder {
  public:
    using LineSource = std::function<int()>;  ///< current line of the main chunk, 0 when it is not running
    using CellListener = std::function<void(const std::string& cell)>;

    /// `enter_cell`, unless empty, is called with each cell as the script enters it.
    void start(const PercentScript& script, std::uint32_t seed, LineSource current_line, CellListener enter_cell);
    /// Goes on with another text of the script: the lines of its cells, and the answers it promises.
    void follow(const PercentScript& script);
    /// What the run has produced up to here, as finish() would give it; the run goes on.
    RunRecord so_far(const Reader& reader) const;
    /// Ends the run: names the figures that were made and not kept, with their titles as captions for the reader, and
    /// returns the run results.
    RunRecord finish(const Reader& reader);

    void print(const std::string& text);
    /// Several lines that belong together were printed.
    void note_block() { block_end_ = {timed_cell_, printed_bytes_}; }
    bool ends_in_block();                          ///< they are the last that the cell has printed
    void add_figure(const FigurePointer& figure);  ///< just made
    /// Captures a figure again that was made or used earlier; one that the cell captures already is left as it is.
    void show_figure(const FigurePointer& figure);
    /// Gives a figure a name of the script's own; as it looks at the end of the run.
    void report_figure(const std::string& name, const FigurePointer& figure, const std::string& caption);
    void add_slider(const std::string& name, RecordedSlider slider);
    bool has_reported_figure(const std::string& name) const { return reported_.count(name) != 0; }
    void set_next_figure_number(long long number) { next_number_ = number; }
    void note_time();  ///< charges the time since the last call to the cell that was running
    void note_file_read(const std::filesystem::path& file);

    const std::vector<ExpectedAnswer>& expected_answers() const { return expected_; }

    RunRecord& record() { return record_; }
    std::size_t printed_bytes() const { return printed_bytes_; }

  private:
    struct Piece {
        std::string printed;
        FigurePointer figure;
    };
    std::string current_cell();
    void report_cell() const;
    struct ReportedFigure {
        FigurePointer figure;
        std::string caption;
    };
    void capture_figures(const std::string& cell, const std::vector<Piece>& pieces, const Reader& reader);

    RunRecord record_;
    std::vector<ExpectedAnswer> expected_;
    LineSource current_line_;
    CellListener enter_cell_;
    std::vector<std::pair<int, std::string>> cells_;  ///< first line and id of the code cells, in order
    std::map<std::string, std::vector<Piece>> pieces_;
    std::map<std::string, ReportedFigure> reported_;
    std::vector<std::weak_ptr<ScriptFigure>> numbered_;
    std::optional<long long> next_number_;
    std::size_t printed_bytes_ = 0;
    std::pair<std::string, std::size_t> block_end_;  ///< cell and bytes printed
    std::size_t figures_made_ = 0;
    std::string timed_cell_;
    std::chrono::steady_clock::time_point timed_since_;
};

}  // namespace dynlab::inline scripting
