#include "workflow/shares/shared_study.h"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "data_io/values/cbor_values.h"
#include "figures/gnuplot_renderer.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/progress.h"
#include "workflow/run_script.h"
#include "workflow/shares/shared_identity.h"

namespace dynlab::inline workflow {

/// The script that all run.
struct StudyScript {
    std::string file, source;
    std::uint32_t seed = 1;
};

/// Some pieces of one of its calls.
struct StudyPart {
    std::size_t call = 0;  ///< the first that is shared out has the number 0
    std::string what;
    std::size_t pieces = 0, first = 0, count = 0;
    std::vector<std::vector<std::string>> earlier;  ///< keys of all parts of the calls before
};

DYNLAB_DESCRIBE(StudyScript, file, source, seed)
DYNLAB_DESCRIBE(StudyPart, call, what, pieces, first, count, earlier)

namespace {

namespace fs = std::filesystem;

constexpr char kStudyKind[] = "study";
constexpr std::size_t kParts = 256, kMostOfAPart = 4096;

std::optional<StudyPart> part_of(const Spool::Claimed& claimed, const std::string& common) {
    if (claimed.job.kind != kStudyKind || claimed.job.common != common) return {};
    return from_cbor<StudyPart>(claimed.job.bytes);
}

/// The script on a worker: at the call that a part belongs to, it makes this part and further ones of the call.
class StudyOnWorker : public SharedPieces {
  public:
    StudyOnWorker(WorkingHand& hand, Spool::Claimed first)
        : hand_(hand), common_(first.job.common), current_(std::move(first)) {}

    std::vector<std::string> all(const std::string& what, std::size_t pieces, const Some& some) override {
        const std::size_t call = calls_++;
        while (current_) {
            const auto part = part_of(*current_, common_);
            if (!part || part->call < call) break;  // other work, or a part of before: for a run of its own
            if (part->call > call) return parts_of(part->earlier.at(call));
            hand_.finish(*current_, [&] {
                if (part->what != what || part->pieces != pieces)
                    throw EnvironmentError(
                        "the script's call {} is {} of {} pieces here, but {} of {} where it began: it must do the "
                        "same in every run, and so must not ask for the time",
                        call + 1, what, pieces, part->what, part->pieces);
                return some(part->first, part->count);
            });
            current_ = hand_.next();
        }
        throw EnvironmentError("this worker's share is done");
    }

    /// After the script has ended: a job that it did not come to.
    void settle(const std::string& trouble) {
        if (!current_) return;
        const auto part = part_of(*current_, common_);
        if (!part || part->call < calls_) return hand_.take_back(*std::exchange(current_, std::nullopt));
        hand_.finish(*current_, [&]() -> std::string {
            throw EnvironmentError(trouble.empty()
                                       ? Message("the script ended before this call, other than where it began")
                                       : Message::verbatim(trouble));
        });
    }

  private:
    std::vector<std::string> parts_of(const std::vector<std::string>& keys) const {
        std::vector<std::string> parts;
        for (const std::string& key : keys) {
            auto result = hand_.spool().result(key);
            if (!result || result->trouble)
                throw EnvironmentError("a part of an earlier call cannot be read from the spool");
            parts.push_back(std::move(result->bytes));
        }
        return parts;
    }

    WorkingHand& hand_;
    std::string common_;
    std::optional<Spool::Claimed> current_;
    std::size_t calls_ = 0;
};

/// Pieces in one part: so few that there are parts for many workers, so many that handing them over is little. It
/// depends on their number alone, so that one that is started again finds its parts.
std::size_t pieces_of_a_part(std::size_t pieces) {
    return std::clamp<std::size_t>((pieces + kParts - 1) / kParts, 1, kMostOfAPart);
}

}  // namespace

SharedStudy::SharedStudy(const Request& request) : lock_(request.key.parent_path() / ".lock") {
    if (!lock_.held())
        throw EnvironmentError(
            "another dynlab study is at work in {}; wait until it is done, or name another folder with --out",
            request.key.parent_path().string());
    const fs::path script = fs::absolute(request.script).lexically_normal();
    SpoolIdentity identity;
    identity.purpose = "study " + script.string();
    identity.program = shared_identity();
    identity.lease_ms = 1000 * request.lease_seconds;
    Spool spool = Spool::begin(request.spool, request.key, identity);
    WorkerCommand command;
    command.words = worker_words(spool.folder());
    auto engine = engine_of(request.on, spool, command);
    common_ = spool.put_common(cbor_of(StudyScript{script.string(), read_file(script), request.seed}));
    coordinator_ = std::make_unique<Coordinator>(std::move(spool), std::move(engine));
}

std::vector<std::string> SharedStudy::all(const std::string& what, std::size_t pieces, const Some&) {
    const std::size_t size = pieces_of_a_part(pieces), count = (pieces + size - 1) / size;
    std::vector<std::string> bytes(count), keys(count);
    std::map<std::string, std::size_t> places;
    ProgressBar bar(what, pieces);
    std::size_t put = 0, done = 0;
    do {
        while (auto finished = coordinator_->finished()) {
            const std::size_t place = places.at(finished->key);
            const Message trouble =
                !finished->result ? finished->trouble : finished->result->trouble.value_or(Message());
            if (!trouble.empty())
                throw EnvironmentError("the pieces from {} on could not be made: {}", place * size + 1, trouble);
            bytes[place] = std::move(finished->result->bytes);
            bar.advance(std::min(pieces, ++done * size));
        }
        for (; put < count && coordinator_->has_room(); ++put) {
            const std::size_t first = put * size;
            const StudyPart part{calls_.size(), what, pieces, first, std::min(size, pieces - first), calls_};
            keys[put] =
                coordinator_->put({kStudyKind, common_, fmt::format("{} from {}", what, first + 1), cbor_of(part)});
            places[keys[put]] = put;
        }
        bar.message(message_text(Message("{} on {}", what, coordinator_->sight())));
    } while (coordinator_->wait());
    calls_.push_back(std::move(keys));
    return bytes;
}

ShareWork study_share() {
    return [](WorkingHand& hand, Spool::Claimed claimed) {
        const auto common = hand.spool().common(claimed.job.common);
        if (!common)
            return hand.finish(
                claimed, []() -> std::string { throw EnvironmentError("the script of the study cannot be read"); });
        const auto study = from_cbor<StudyScript>(*common);
        RunRequest request;
        request.script = parse_percent_script(study.source, study.file);
        request.seed = study.seed;
        StudyOnWorker shared(hand, std::move(claimed));
        request.shared = &shared;
        const TemporaryFolder files;  // what the script saves, it saves where it began
        request.out_folder = files.path();
        GnuplotRenderer renderer;
        const RunRecord record = run_script(request, renderer);
        shared.settle(record.error ? record.error->text() : "");
    };
}

}  // namespace dynlab::inline workflow
