#include "figures/gnuplot_renderer.h"

#include <fmt/format.h>
#include <gnuplot-iostream.h>
#include <re2/re2.h>
#include <signal.h>

#include <deque>
#include <fstream>
#include <optional>

#include "figures/figure.h"
#include "figures/figure_file.h"
#include "figures/figure_text.h"
#include "figures/gnuplot_process.h"
#include "figures/gnuplot_script.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/files/ends_with_program.h"
#include "platform/interrupt.h"
#include "platform/program_identity.h"
#include "platform/program_lookup.h"
#include "platform/system_call.h"
#include "platform/written_files.h"

namespace dynlab::inline figures {
namespace {

namespace fs = std::filesystem;

/// While one lives, writing to a gnuplot that has ended fails instead of ending this program too.
class BrokenPipeBlock {
  public:
    BrokenPipeBlock() {
        sigemptyset(&broken_pipe_);
        sigaddset(&broken_pipe_, SIGPIPE);
        pthread_sigmask(SIG_BLOCK, &broken_pipe_, &before_);
    }
    ~BrokenPipeBlock() {
        const timespec now{};
        if (!sigismember(&before_, SIGPIPE))
            while (sigtimedwait(&broken_pipe_, nullptr, &now) > 0) {
            }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    BrokenPipeBlock(const BrokenPipeBlock&) = delete;
    BrokenPipeBlock& operator=(const BrokenPipeBlock&) = delete;

  private:
    sigset_t broken_pipe_, before_;
};

/// The first error in what gnuplot wrote, as in `"/dev/stdin" line 7: undefined variable: x`, without its echo of the
/// command; nothing when there are but warnings.
std::optional<std::string> first_error(const std::string& complaints) {
    static const RE2 kComplaint(R"((?m)^[ \t]*(?:"[^"\n]*" )?line \d+: (.+))", RE2::Latin1);
    std::string complaint;
    for (re2::StringPiece rest = complaints; RE2::FindAndConsume(&rest, kComplaint, &complaint);)
        if (!complaint.starts_with("warning") && !complaint.starts_with("Warning")) return complaint;
    return {};
}

/// The last line; empty where there is none.
std::string last_words(const std::string& complaints) {
    const std::size_t end = complaints.find_last_not_of(" \n");
    if (end == std::string::npos) return "";
    const std::size_t line = complaints.rfind('\n', end);
    return complaints.substr(line + 1, end - line);
}

/// Which gnuplot draws: its file's name, size and date.
std::string gnuplot_version() {
    const auto gnuplot = find_program("gnuplot");
    return gnuplot ? file_stamp(*gnuplot) : std::string();
}

std::string name_of_drawing(FigureFormat format, const std::string& script) {
    return EntryName("figures").add(gnuplot_version()).add(std::to_string(static_cast<int>(format))).add(script).text();
}

}  // namespace

/// The figures on their way, in the order in which they were asked for: a file drawn twice is the later figure's.
class GnuplotRenderer::Work {
  public:
    explicit Work(const Cache* cache) : cache_(cache && cache->lasting() ? cache : nullptr) {}
    ~Work() { give_up(); }

    void draw(const Figure& figure, const fs::path& target, FigureFormat format, const Reader& reader) {
        const std::string script = gnuplot_script(figure, format, reader);
        TemporaryFile made = make_temporary_next_to(target);
        Pending next{0, format, std::move(made.path), target, std::move(made.file), {}, {}};
        next.ends = EndsWithProgram(next.temporary);
        if (cache_) next.name = name_of_drawing(format, script);
        pending_.push_back(std::move(next));
        try {
            if (!load_entry(pending_.back())) start_drawing(pending_.back(), script);
        } catch (...) {
            give_up();
            throw;
        }
    }

    void finish() {
        std::optional<Message> first_complaint;
        try {
            for (; !pending_.empty(); pending_.pop_front()) {
                const auto complaint = complete(pending_.front());
                if (!first_complaint) first_complaint = complaint;
            }
        } catch (...) {
            give_up();
            throw;
        }
        if (first_complaint) throw FigureError(*first_complaint);
    }

    CacheUse use() const { return use_; }

  private:
    struct Pending {
        unsigned number;  ///< of gnuplot's report; 0 for a figure from the cache
        FigureFormat format;
        fs::path temporary, target;
        FileDescriptor in_use;  ///< the lock of the temporary file
        std::string name;       ///< in the cache
        EndsWithProgram ends;   ///< the temporary file
    };
    struct Running {
        GnuplotProcess child;
        Gnuplot gnuplot{child.take_input()};
    };

    void give_up() {
        if (running_) running_->child.end();
        running_.reset();
        for (const Pending& figure : pending_) remove(figure);
        pending_.clear();
    }

    static void remove(const Pending& figure) {
        std::error_code ignored;
        fs::remove(figure.temporary, ignored);
    }

    bool load_entry(const Pending& figure) {
        const auto drawn = cache_ ? cache_->load_entry(figure.name) : std::nullopt;
        if (!drawn) return false;
        std::ofstream file(figure.temporary, std::ios::binary);
        file << *drawn;
        file.close();
        if (!file) return false;
        ++use_.from_cache;
        return true;
    }

    void start_drawing(Pending& figure, const std::string& script) {
        if (!running_) running_ = std::make_unique<Running>();
        figure.number = ++last_number_;
        send(fmt::format("output_file = {}\n{}{}", gnuplot_quoted(figure.temporary.string()), script,
                         GnuplotProcess::report_command(figure.number)),
             figure.target);
    }

    /// gnuplot ends at its first error; what it had in hand then is lost.
    [[noreturn]] void fail_as_ended(const fs::path& target) const {
        const std::string complaints = running_->child.last_complaints();
        if (const auto error = first_error(complaints))
            throw FigureError(Message("gnuplot could not draw \"{}\": {}", target.string(), *error));
        const std::string last = last_words(complaints);
        if (last.empty())
            throw FigureError(Message(
                "gnuplot exited or stopped responding while it drew \"{}\"; it printed no message", target.string()));
        throw FigureError(
            Message("gnuplot exited or stopped responding while it drew \"{}\"; its last message was \"{}\"",
                    target.string(), last));
    }

    void send(const std::string& script, const fs::path& target) {
        const BrokenPipeBlock held;
        running_->gnuplot << script << std::flush;
        if (running_->gnuplot) return;
        throw_if_interrupted();
        fail_as_ended(target);
    }

    /// Waits until gnuplot has drawn a figure; returns what went wrong.
    std::optional<Message> wait_for(const Pending& figure) {
        const std::optional<std::string> complaints = running_->child.wait_for_report(figure.number);
        if (!complaints) fail_as_ended(figure.target);
        if (const auto error = first_error(*complaints)) return Message::verbatim(*error);
        if (!is_complete(figure.temporary, figure.format)) return Message("the file is incomplete (is the disk full?)");
        if (figure.format == FigureFormat::kPdf) blank_creation_date(figure.temporary);
        if (figure.format == FigureFormat::kSvg) finish_svg(figure.temporary);
        ++use_.made;
        if (cache_) cache_->save_entry(figure.name, read_file(figure.temporary));
        return {};
    }

    /// Puts a figure in place, once it is drawn; returns what went wrong.
    std::optional<Message> complete(const Pending& figure) {
        if (figure.number > 0) {
            if (const auto error = wait_for(figure)) {
                remove(figure);
                return Message("gnuplot could not draw \"{}\": {}", figure.target.string(), *error);
            }
        }
        note_replacement(figure.target, figure.temporary);
        std::error_code failure;
        fs::rename(figure.temporary, figure.target, failure);
        if (!failure) return {};
        remove(figure);
        return Message("cannot write the figure \"{}\": {}", figure.target.string(), system_reason(failure.value()));
    }

    const Cache* cache_;
    CacheUse use_;
    std::unique_ptr<Running> running_;
    std::deque<Pending> pending_;
    unsigned last_number_ = 0;
};

GnuplotRenderer::GnuplotRenderer(const Cache* cache) : work_(std::make_unique<Work>(cache)) {}
GnuplotRenderer::~GnuplotRenderer() = default;

void GnuplotRenderer::draw(const Figure& figure, const fs::path& file, FigureFormat format, const Reader& reader) {
    figure.validate();
    const fs::path target = fs::absolute(file);
    for (const char c : target.native())
        if (static_cast<unsigned char>(c) < 0x20)
            throw InvalidArgument("the file name of a figure must not contain line breaks or control characters");
    work_->draw(figure, target, format, reader);
}

void GnuplotRenderer::finish() {
    work_->finish();
}

CacheUse GnuplotRenderer::use() const {
    return work_->use();
}

}  // namespace dynlab::inline figures
