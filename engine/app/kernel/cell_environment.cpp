#include "app/kernel/cell_environment.h"

#include <fmt/format.h>
#include <unistd.h>

#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>

#include "app/kernel/cell_messages.h"
#include "base/languages.h"
#include "base/reader.h"
#include "data_io/values/cbor_values.h"
#include "documents/script_header.h"
#include "documents/text_lines.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/memory.h"
#include "platform/terminal/aligned_table.h"
#include "platform/terminal/progress.h"
#include "platform/written_files.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/prompt/completion.h"
#include "scripting/prompt/inspection.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/errors.h"
#include "scripting/runtime/services.h"
#include "workflow/error_text.h"
#include "workflow/notebooks/figure_bundle.h"
#include "workflow/run_script.h"

namespace dynlab::inline app {
namespace {

using nlohmann::json;

constexpr std::size_t kCellsBetweenTidying = 100;

class CellEnvironment {
  public:
    explicit CellEnvironment(Channel line)
        : line_(std::move(line)),
          written_(state_file("written")),
          renderer_(&cache_),
          listener_{[this](const std::string& latex) { expected_ = latex; }},
          runtime_(options(), renderer_) {
        runtime_.services() = {.language = &language_, .listener = &listener_, .written = &written_};
        ProgressBar::set_listener([this](std::size_t done, std::size_t total) {
            const double part = total == 0 ? -1 : static_cast<double>(std::min(done, total)) / double(total);
            send_news({.kind = "progress", .progress = part});
        });
    }

    [[noreturn]] void serve() {
        runtime_.run_statement(read_script_part("", {}), "start");  // from then on names can be completed
        while (const auto message = line_.receive()) {
            const CellOrder order = from_cbor<CellOrder>(message->bytes);
            clear_interrupts(std::numeric_limits<int>::max());
            CellNews done{.kind = "done"};
            if (order.kind == "run") run(order);
            if (order.kind == "complete") {
                Completion found = complete(runtime_.state(), order.code);
                done.lines = std::move(found.candidates), done.typed = found.typed, done.text = found.note;
            }
            if (order.kind == "inspect")
                done.text = inspect(runtime_.state(), order.code, order.cursor).value_or(std::string());
            send_news(done);
            if (++orders_ % kCellsBetweenTidying == 0) return_freed_memory();
        }
        ::_exit(0);
    }

  private:
    struct Value {
        std::string text, latex;
    };

    RunOptions options() {
        RunOptions requested;
        requested.call_cache = &calls_;
        requested.print = [this](const std::string& text) { take_printed(text); };
        return requested;
    }

    void send_news(const CellNews& news) {
        const std::lock_guard lock(output_mutex_);  // bars of several threads move at once
        if (!line_.send(cbor_of(news))) ::_exit(0);
    }

    /// A value that a line shows is held back until the next comes: the last is the cell's result.
    void take_printed(const std::string& text) {
        give_value("display");
        if (expected_)
            value_ = Value{text, *std::exchange(expected_, std::nullopt)};
        else
            send_news({.kind = "print", .text = text});
    }

    void give_value(const char* kind) {
        if (!value_) return;
        const Value value = *std::exchange(value_, std::nullopt);
        if (std::string(kind) == "display" && value.latex.empty())
            return send_news({.kind = "print", .text = value.text});
        std::string text = value.text;
        while (text.ends_with('\n')) text.pop_back();
        json shown = {{"text/plain", text.substr(std::min(text.find_first_not_of('\n'), text.size()))}};
        if (!value.latex.empty()) shown["text/latex"] = value.latex;
        send_news({.kind = kind, .data = shown.dump(-1, ' ', false, json::error_handler_t::replace)});
    }

    void run(const CellOrder& order) {
        value_.reset(), expected_.reset();
        send_news({.kind = "begun"});
        const std::string name = fmt::format("cell [{}]", order.count);
        try {
            take_header(order.code, name);
            const RunRecord record = runtime_.run_statement(read_cell(order.code, shown_calls()), name);
            show_reported(record);
            for (const std::string& figure : figures_in_order(record)) {
                throw_if_interrupted();
                send_news({.kind = "display",
                           .data = figure_bundle(*record.figures.at(figure).figure, renderer_,
                                                 Reader{catalog_of(language_.code)})});
            }
            renderer_.finish();  // what the cell saved itself
            give_value("result");
            if (record.error) fail(*record.error, order.code, name);
        } catch (const Interrupted& error) {
            give_value("display");
            send_news({.kind = "failed", .text = error.what(), .lines = {error.what()}, .interrupted = true});
        } catch (const std::exception& error) {
            send_news({.kind = "failed", .text = error.what(), .lines = {error.what()}});
        }
        written_.settle();
    }

    /// A cell with a script's header says the seed and the language, as the header does for a script.
    void take_header(const std::string& code, const std::string& name) {
        ScriptHeader header;
        if (read_script_header(lines_of(code), name, header) == 0) return;
        language_.code = header.language;
        context_of(runtime_.state()).random = RandomStream(header.seed);
    }

    void show_reported(const RunRecord& record) {
        std::string text;
        for (const auto& [name, value] : record.values) text += fmt::format("value {}: {}\n", name, value.text);
        for (const auto& [name, table] : record.tables)
            text += fmt::format("table {}:\n{}", name, aligned_table(table.header, table.rows));
        if (text.empty()) return;
        give_value("display");
        send_news({.kind = "print", .text = text});
    }

    void fail(const RecordedError& error, const std::string& code, const std::string& name) {
        PercentScript cell;
        cell.file = name;
        cell.source = code;
        send_news({.kind = "failed", .text = message_text(error.message), .lines = lines_of(error_text(error, cell))});
    }

    Channel line_;
    std::mutex output_mutex_;
    Cache cache_;
    CallCache calls_{cache_};
    WrittenFiles written_;  ///< outlives the renderer, which draws into them
    GnuplotRenderer renderer_;
    ReportLanguage language_{"en"};
    ValueListener listener_;
    std::optional<std::string> expected_;  ///< the formula of the value that is printed next
    std::optional<Value> value_;
    std::size_t orders_ = 0;
    Runtime runtime_;
};

}  // namespace

void serve_cells(Channel line) {
    try {
        CellEnvironment(std::move(line)).serve();
    } catch (const std::exception& error) {
        fmt::print(stderr, "dynlab: {}\n", error.what());
    }
    ::_exit(1);
}

}  // namespace dynlab::inline app
