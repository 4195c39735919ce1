#include "figures/gnuplot_renderer.h"

#include <fmt/format.h>
#include <gnuplot-iostream.h>
#include <signal.h>

#include <deque>
#include <optional>
#include <regex>

#include "figures/figure_file.h"
#include "figures/gnuplot_process.h"
#include "figures/gnuplot_script.h"
#include "numerics/error.h"
#include "platform/interrupt.h"
#include "platform/system_call.h"

namespace dynlab {
namespace {

/// While one lives, writing to a gnuplot that has ended fails instead of ending this program too.
class BrokenPipeHeld {
  public:
    BrokenPipeHeld() {
        sigemptyset(&broken_pipe_);
        sigaddset(&broken_pipe_, SIGPIPE);
        pthread_sigmask(SIG_BLOCK, &broken_pipe_, &before_);
    }
    ~BrokenPipeHeld() {
        const timespec now{};
        if (!sigismember(&before_, SIGPIPE))
            while (sigtimedwait(&broken_pipe_, nullptr, &now) > 0) {
            }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    BrokenPipeHeld(const BrokenPipeHeld&) = delete;
    BrokenPipeHeld& operator=(const BrokenPipeHeld&) = delete;

  private:
    sigset_t broken_pipe_, before_;
};

/// The first error in what gnuplot wrote, as in `"/dev/stdin" line 7: undefined variable: x`, without its echo of the
/// command; nothing when there are but warnings.
std::optional<std::string> first_error(const std::string& complaints) {
    static const std::regex kComplaint(R"((?:^|\n)[ \t]*(?:"[^"\n]*" )?line \d+: (?![Ww]arning)([^\n]+))");
    std::smatch match;
    if (!std::regex_search(complaints, match, kComplaint)) return {};
    return match[1];
}

std::string last_words(const std::string& complaints) {
    const std::size_t end = complaints.find_last_not_of(" \n");
    if (end == std::string::npos) return "it said nothing";
    const std::size_t line = complaints.rfind('\n', end);
    return fmt::format("its last words were \"{}\"", complaints.substr(line + 1, end - line));
}

}  // namespace

struct GnuplotRenderer::Process {
    struct Pending {
        unsigned number;
        FigureFormat format;
        std::filesystem::path temporary, target;
    };

    GnuplotProcess child;
    Gnuplot gnuplot{child.take_input()};
    std::deque<Pending> pending;
    unsigned last_number = 0;

    ~Process() {
        child.end();
        for (const Pending& figure : pending) remove(figure);
    }

    static void remove(const Pending& figure) {
        std::error_code ignored;
        std::filesystem::remove(figure.temporary, ignored);
    }

    /// gnuplot ends at its first error; what it had in hand then is lost.
    [[noreturn]] void fail_as_ended(const std::filesystem::path& target) const {
        const std::string complaints = child.complaints();
        if (const auto error = first_error(complaints))
            throw FigureError(fmt::format("gnuplot could not draw \"{}\": {}", target.string(), *error));
        throw FigureError(fmt::format("gnuplot ended or no longer answered while it drew \"{}\"; {}", target.string(),
                                      last_words(complaints)));
    }

    void send(const std::string& script, const std::filesystem::path& target) {
        const BrokenPipeHeld held;
        gnuplot << script << std::flush;
        if (gnuplot) return;
        throw_if_interrupted();
        fail_as_ended(target);
    }

    /// Waits for one figure and puts it in place; returns what went wrong.
    std::optional<std::string> complete(const Pending& figure) {
        const std::optional<std::string> complaints = child.wait_for_report(figure.number);
        if (!complaints) fail_as_ended(figure.target);
        std::optional<std::string> error = first_error(*complaints);
        if (!error && !is_whole(figure.temporary, figure.format))
            error = "the file is not complete (is the disk full?)";
        if (error) {
            remove(figure);
            return fmt::format("gnuplot could not draw \"{}\": {}", figure.target.string(), *error);
        }
        if (figure.format == FigureFormat::kPdf) blank_creation_date(figure.temporary);
        if (figure.format == FigureFormat::kSvg) add_fallback_fonts(figure.temporary);
        std::error_code failure;
        std::filesystem::rename(figure.temporary, figure.target, failure);
        if (!failure) return {};
        remove(figure);
        return fmt::format("cannot write the figure \"{}\": {}", figure.target.string(),
                           system_reason(failure.value()));
    }
};

GnuplotRenderer::GnuplotRenderer() = default;
GnuplotRenderer::~GnuplotRenderer() = default;

void GnuplotRenderer::draw(const Figure& figure, const std::filesystem::path& file, FigureFormat format) {
    figure.validate();
    const std::filesystem::path target = std::filesystem::absolute(file);
    for (const char c : target.native())
        if (static_cast<unsigned char>(c) < 0x20)
            throw InvalidArgument("the name of a figure's file must not contain line breaks or control characters");
    if (!process_) process_ = std::make_unique<Process>();
    const unsigned number = ++process_->last_number;
    process_->pending.push_back({number, format, make_temporary_beside(target), target});
    const std::filesystem::path& temporary = process_->pending.back().temporary;
    try {
        process_->send(gnuplot_script(figure, temporary, format) + GnuplotProcess::report_command(number), target);
    } catch (...) {
        process_.reset();
        throw;
    }
}

void GnuplotRenderer::finish() {
    if (!process_) return;
    std::optional<std::string> first_complaint;
    try {
        for (; !process_->pending.empty(); process_->pending.pop_front()) {
            const auto complaint = process_->complete(process_->pending.front());
            if (!first_complaint) first_complaint = complaint;
        }
    } catch (...) {
        process_.reset();
        throw;
    }
    if (first_complaint) throw FigureError(*first_complaint);
}

}  // namespace dynlab
