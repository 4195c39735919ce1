#include "workflow/branched_runs.h"

#include <unistd.h>

#include <algorithm>

#include "base/languages.h"
#include "data_io/values/cbor_values.h"
#include "documents/figure_description.h"
#include "documents/html/plot_data.h"
#include "documents/record_description.h"
#include "documents/weave.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/process_group.h"
#include "scripting/runtime/script_parts.h"
#include "workflow/process_copy.h"
#include "workflow/script_environment.h"

namespace dynlab::inline workflow {
namespace {

/// Sends the length of the run results through the pipe, then their bytes.
bool send_record(int pipe, const std::string& bytes) {
    const std::uint64_t size = bytes.size();
    return write_all(pipe, reinterpret_cast<const char*>(&size), sizeof size) &&
           write_all(pipe, bytes.data(), bytes.size());
}

void read_whole(int pipe, char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t count = ::read(pipe, bytes, size);
        throw_if_interrupted();
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0)
            throw EnvironmentError("the process that ran the script for a slider has exited; run the command again");
        bytes += count;
        size -= static_cast<std::size_t>(count);
    }
}

RunRecord received_record(int pipe) {
    std::uint64_t size = 0;
    read_whole(pipe, reinterpret_cast<char*>(&size), sizeof size);
    std::string bytes(size, '\0');
    read_whole(pipe, bytes.data(), bytes.size());
    return from_cbor<RunRecord>(bytes);
}

/// The script's environment in a separate process, from its beginning to the last choice.
class BranchingRun {
  public:
    BranchingRun(const RunRequest& request, int pipe)
        : request_(request), pipe_(pipe), run_environment_(request, renderer_), parts_(script_parts(request.script)) {}

    void serve(const std::string& cell, const std::vector<SliderNumbers>& choices) {
        const auto holds = [&](const ScriptPart& part) {
            return std::find(part.cells.begin(), part.cells.end(), cell) != part.cells.end();
        };
        const auto first = std::find_if(parts_.begin(), parts_.end(), holds);
        run_environment_.runtime.begin_parts(request_.script);
        for (auto part = parts_.begin(); part != first; ++part) {
            const RunRecord record = run_environment_.runtime.run_part(request_.script, *part);
            if (part + 1 != first) continue;
            for (const auto& [name, figure] : record.figures) before_[name] = cbor_of(*figure.figure);
        }
        for (const SliderNumbers& choice : choices)
            if (!send_record(pipe_, sent_by_a_copy(choice, first))) ::_exit(1);
    }

  private:
    /// What the copy has to say; where it ends before it has said all, that.
    std::string sent_by_a_copy(const SliderNumbers& choice, std::vector<ScriptPart>::const_iterator first) {
        Pipe own;
        ProcessCopy copy;
        if (copy.is_copy()) {
            own.read_end.close();
            ::_exit(send_record(own.write_end.get(), cbor_of(record_of(choice, first))) ? 0 : 1);
        }
        own.write_end.close();
        RunRecord record;
        try {
            record = received_record(own.read_end.get());
        } catch (const EnvironmentError&) {
            record.error = RecordedError{
                Message("the process of the script exited before the run was complete; run the command again")};
        }
        copy.wait();
        return cbor_of(record);
    }

    RunRecord record_of(const SliderNumbers& choice, std::vector<ScriptPart>::const_iterator first) {
        run_environment_.sliders.chosen = choice;
        RunRecord record;
        for (auto part = first; part != parts_.end() && !record.error; ++part)
            record = run_environment_.runtime.run_part(request_.script, *part);
        const Reader reader{catalog_of(request_.script.header.language)};
        for (auto& [name, figure] : record.figures) {
            const auto was = before_.find(name);
            const bool unchanged = was != before_.end() && was->second == cbor_of(*figure.figure);
            if (!unchanged) figure.plot = plot_data(*figure.figure, reader);
            figure.axes = words_of_axes(*figure.figure, reader);
        }
        return record;
    }

    const RunRequest& request_;
    int pipe_;
    GnuplotRenderer renderer_;  // figures that the script saves for one choice are discarded
    ScriptEnvironment run_environment_;
    std::vector<ScriptPart> parts_;
    std::map<std::string, std::string> before_;  ///< figures made before the cell
};

}  // namespace

void run_from_cell(const RunRequest& request, const std::string& cell, const std::vector<SliderNumbers>& choices,
                   const std::function<void(RunRecord&&)>& take) {
    Pipe records;
    ProcessCopy copy;
    if (copy.is_copy()) {
        try {
            records.read_end.close();
            BranchingRun(request, records.write_end.get()).serve(cell, choices);
        } catch (...) {
            ::_exit(1);
        }
        ::_exit(0);
    }
    records.write_end.close();
    for (std::size_t i = 0; i < choices.size(); ++i) take(received_record(records.read_end.get()));
}

}  // namespace dynlab::inline workflow
