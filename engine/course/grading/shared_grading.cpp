#include "course/grading/shared_grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "course/checks/check_descriptions.h"
#include "course/grading/grade_description.h"
#include "data_io/values/cbor_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/program_lookup.h"
#include "platform/system_call.h"
#include "platform/temporary_folder.h"
#include "workflow/shares/shared_identity.h"

namespace dynlab::inline course {

/// What all submissions of a class are graded by.
struct SharedRules {
    std::string lesson, lesson_folder, lesson_digest;
    bool own_checks = false;
    std::vector<SentFile> checks;  ///< the instructor's folder
    std::string secret, isolation;
    std::int64_t time_ms = 0;  ///< of processor time
    int clock_multiple = 0;
    std::vector<std::string> broken;
    std::map<std::string, double> solution_seconds;
};

struct SubmissionBatch {
    std::vector<SentSubmission> submissions;
};

struct GradedSubmission {
    CheckedSubmission work;
    Grade grade;
    std::string log;
};

struct GradedBatch {
    std::vector<GradedSubmission> submissions;
};

DYNLAB_DESCRIBE(SentFile, path, bytes)
DYNLAB_DESCRIBE(SharedRules, lesson, lesson_folder, lesson_digest, own_checks, checks, secret, isolation, time_ms,
                clock_multiple, broken, solution_seconds)
DYNLAB_DESCRIBE(SentSubmission, name, files, seed, of_notebook, linked_data)
DYNLAB_DESCRIBE(SubmissionBatch, submissions)
DYNLAB_DESCRIBE(GradedSubmission, work, grade, log)
DYNLAB_DESCRIBE(GradedBatch, submissions)

namespace {

namespace fs = std::filesystem;

constexpr char kGradeKind[] = "grade", kDataFolder[] = "data";
constexpr std::uint64_t kMostBytesOfABatch = 32 << 20;
constexpr auto kMostOfABatch = std::chrono::seconds(2);
constexpr auto kMarginOfASubmission = std::chrono::seconds(900);  // its checks, also one by one, and its document

enum class Links { kFollowed, kLeft };

std::vector<SentFile> files_to_send(const fs::path& folder, Links links) {
    std::vector<SentFile> files;
    const auto options =
        links == Links::kFollowed ? fs::directory_options::follow_directory_symlink : fs::directory_options::none;
    for (const auto& entry : fs::recursive_directory_iterator(folder, options)) {
        const std::string path = entry.path().lexically_relative(folder).generic_string();
        if (links == Links::kLeft && entry.is_symlink()) continue;
        if (entry.is_directory())
            files.push_back({path + "/", ""});
        else if (entry.is_regular_file())
            files.push_back({path, read_file(entry.path())});
    }
    std::sort(files.begin(), files.end(), [](const SentFile& a, const SentFile& b) { return a.path < b.path; });
    return files;
}

/// Folders stand before what is in them.
void write_sent_files(const std::vector<SentFile>& files, const fs::path& folder) {
    fs::create_directories(folder);
    for (const SentFile& file : files)
        if (file.path.ends_with("/"))
            fs::create_directories(folder / file.path);
        else if (std::ofstream to(folder / file.path, std::ios::binary); !(to << file.bytes).flush())
            throw EnvironmentError("cannot write {}: {} (in {})", file.path, system_reason(errno), folder.string());
}

SharedRules shared_rules(const GradingRules& rules) {
    const GradingSetup& setup = rules.setup();
    SharedRules shared;
    shared.lesson = setup.lesson.slug;
    shared.lesson_folder = fs::absolute(setup.lesson.folder).string();
    shared.lesson_digest = digest_of_folder(setup.lesson.folder).hex();
    shared.own_checks = setup.more_checks.has_value();
    if (setup.more_checks) shared.checks = files_to_send(*setup.more_checks, Links::kFollowed);
    shared.secret = setup.secret;
    shared.isolation = isolation_name(setup.isolation);
    shared.time_ms = setup.time.processor.count();
    shared.clock_multiple = setup.time.clock_multiple;
    shared.broken = {rules.broken_checks().begin(), rules.broken_checks().end()};
    shared.solution_seconds = rules.solution_seconds();
    return shared;
}

/// Beside the results, which may lie where the spool does not: who can write into the spool cannot read it.
fs::path key_beside(const fs::path& out) {
    return out / ".spool.key";
}

/// The rules of one class, which a worker keeps from submission to submission.
class RulesOfClass {
  public:
    explicit RulesOfClass(const SharedRules& shared) {
        GradingSetup setup;
        const fs::path folder = shared.lesson_folder;
        const auto there = fs::is_directory(folder) ? lesson_in(folder) : std::nullopt;
        setup.lesson = there ? *there : find_lesson(shared.lesson);
        if (digest_of_folder(setup.lesson.folder).hex() != shared.lesson_digest)
            throw EnvironmentError("the lesson {} is another one on this machine", shared.lesson);
        if (shared.own_checks) {
            write_sent_files(shared.checks, checks_.path() / "checks");
            setup.more_checks = checks_.path() / "checks";
        }
        setup.secret = shared.secret;
        setup.isolation = shared.isolation == isolation_name(Isolation::kFull) ? Isolation::kFull : Isolation::kProcess;
        setup.time = {std::chrono::milliseconds(shared.time_ms), shared.clock_multiple};
        setup.program = running_program();
        rules_ = std::make_unique<GradingRules>(std::move(setup));
        rules_->leave_ungraded({shared.broken.begin(), shared.broken.end()});
        rules_->compare_with_solution(shared.solution_seconds);
    }

    /// As many of them, from the first on, as take about kMostOfABatch: little is lost with a worker then.
    GradedBatch graded(const SubmissionBatch& batch, const std::string& node) const {
        const auto latest = std::chrono::steady_clock::now() + kMostOfABatch;
        GradedBatch done;
        std::vector<GradingRules::Work> works;
        for (const SentSubmission& submission : batch.submissions) {
            if (!works.empty() && std::chrono::steady_clock::now() > latest) break;
            const TemporaryFolder folder;
            write_sent_files(submission.files, folder.path() / "work");
            if (submission.linked_data)
                fs::create_directory_symlink(shared_folder() / kDataFolder, folder.path() / "work" / kDataFolder);
            std::string log = fmt::format("on {}, isolation {}\n", node, isolation_name(rules_->setup().isolation));
            GradedSubmission one;
            one.work = rules_->work_in(folder.path() / "work", submission.seed, log, submission.of_notebook);
            works.push_back({submission.name, one.work, submission.seed, log});
            done.submissions.push_back(std::move(one));
        }
        std::vector<Grade> grades = rules_->judged(std::move(works));
        for (std::size_t i = 0; i < grades.size(); ++i) {
            done.submissions[i].log = std::move(grades[i].log);
            done.submissions[i].grade = std::move(grades[i]);
        }
        return done;
    }

  private:
    TemporaryFolder checks_;
    std::unique_ptr<GradingRules> rules_;
};

}  // namespace

SharedGrading::SharedGrading(const GradingRequest& request, const GradingRules& rules) {
    const fs::path out = fs::absolute(request.out).lexically_normal();
    SpoolIdentity identity;
    identity.purpose = fmt::format("grade {} into {}", request.setup.lesson.slug, out.string());
    identity.program = shared_identity();
    identity.isolation = isolation_name(request.setup.isolation);
    identity.lease_ms = 1000 * request.lease_seconds;
    const fs::path folder = request.spool ? fs::absolute(*request.spool) : out / ".spool";
    Spool spool = Spool::begin(folder, key_beside(out), identity);
    WorkerCommand command;
    command.words = worker_words(spool.folder());
    command.longest_job = std::chrono::duration_cast<std::chrono::seconds>(request.setup.time.clock()) *
                              static_cast<int>(rules.runs_of_a_submission()) +
                          kMarginOfASubmission;
    auto engine = engine_of(request.on, spool, command);
    hands_ = engine->wanted();
    common_ = spool.put_common(cbor_of(shared_rules(rules)));
    coordinator_ = std::make_unique<Coordinator>(std::move(spool), std::move(engine));
}

SentSubmission sent_submission(const std::string& name, const StagedWork& staged, const GradingRules::GroupSeed& seed) {
    return {name, files_to_send(staged.folder, Links::kLeft), seed, staged.of_notebook,
            fs::is_symlink(staged.folder / kDataFolder)};
}

/// In parts, where it is large: a worker has it in its memory more than once.
void SharedGrading::give(std::vector<Given> batch) {
    std::vector<Given> part;
    std::uint64_t bytes = 0;
    for (Given& one : batch) {
        std::uint64_t more = 0;
        for (const SentFile& file : one.submission.files) more += file.bytes.size();
        if (!part.empty() && bytes + more > kMostBytesOfABatch) {
            give_at_once(std::exchange(part, {}));
            bytes = 0;
        }
        bytes += more;
        part.push_back(std::move(one));
    }
    if (!part.empty()) give_at_once(std::move(part));
}

void SharedGrading::give_at_once(std::vector<Given> batch) {
    SubmissionBatch sent;
    for (const Given& one : batch) sent.submissions.push_back(one.submission);
    const std::string& first = batch.front().submission.name;
    const std::string title = batch.size() == 1 ? first : fmt::format("{} and {} more", first, batch.size() - 1);
    const ShareJob job{kGradeKind, common_, title, cbor_of(sent)};
    const std::lock_guard lock(mutex_);  // before its result can come back
    out_[coordinator_->put(job)] = std::move(batch);
}

std::optional<SharedGrading::DoneBatch> SharedGrading::done() {
    auto finished = coordinator_->finished();
    if (!finished) return {};
    std::vector<Given> batch;
    {
        const std::lock_guard lock(mutex_);
        batch = std::move(out_.extract(finished->key).mapped());
    }
    Message trouble = finished->trouble;
    if (finished->result && finished->result->trouble)
        trouble = Message("{} says: {}", finished->result->node, *finished->result->trouble);
    if (!trouble.empty() && batch.size() > 1) {
        for (Given& one : batch) give({std::move(one)});
        return done();
    }
    DoneBatch all{finished->key, {}};
    GradedBatch graded;
    if (trouble.empty()) graded = from_cbor<GradedBatch>(finished->result->bytes);
    if (trouble.empty() && graded.submissions.size() < batch.size()) {
        const auto rest = batch.begin() + static_cast<std::ptrdiff_t>(graded.submissions.size());
        give({std::make_move_iterator(rest), std::make_move_iterator(batch.end())});
        batch.erase(rest, batch.end());
    }
    for (std::size_t i = 0; i < batch.size(); ++i) {
        batch[i].submission.files.clear();
        Done one{std::move(batch[i]), {}, {}, trouble};
        if (trouble.empty()) {
            GradedSubmission& from = graded.submissions.at(i);
            one.work = std::move(from.work), one.grade = std::move(from.grade);
            one.grade.log = std::move(from.log);
        }
        all.submissions.push_back(std::move(one));
    }
    return all;
}

ShareWork grading_share() {
    struct Kept {
        std::string common;
        std::unique_ptr<RulesOfClass> rules;
    };
    return [kept = std::make_shared<Kept>()](WorkingHand& hand, const Spool::Claimed& claimed) {
        hand.finish(claimed, [&] {
            if (kept->common != claimed.job.common || !kept->rules) {
                kept->rules.reset();
                const auto bytes = hand.spool().common(claimed.job.common);
                if (!bytes) throw EnvironmentError("what all submissions are graded by cannot be read");
                kept->rules = std::make_unique<RulesOfClass>(from_cbor<SharedRules>(*bytes));
                kept->common = claimed.job.common;
            }
            return cbor_of(kept->rules->graded(from_cbor<SubmissionBatch>(claimed.job.bytes), hand.node()));
        });
    };
}

}  // namespace dynlab::inline course
