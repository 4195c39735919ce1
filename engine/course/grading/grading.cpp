#include "course/grading/grading.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/reader.h"
#include "course/grading/class_owners.h"
#include "course/grading/class_results.h"
#include "course/grading/deadlines.h"
#include "course/grading/feedback.h"
#include "course/grading/grading_memory.h"
#include "course/grading/late_penalties.h"
#include "course/grading/manual_marks.h"
#include "course/grading/shared_grading.h"
#include "course/intake/course_clock.h"
#include "course/intake/staging.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/locks/file_lock.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/progress.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// The grading of one class, by several threads.
class ClassGrader {
  public:
    ClassGrader(const GradingRequest& request, GradingOutcome& outcome)
        : request_(request),
          outcome_(outcome),
          lock_(locked(request)),
          submissions_(submissions_in(opened(request), left_out_, request.out)),
          rules_(request.setup),
          manual_(request.out / "manual.csv"),
          documents_(request.setup.isolation, request.setup.program),
          late_(request.out, request.accept_late) {
        refuse_other_lessons(request);
        if (request.deadlines) deadlines_ = Deadlines(*request.deadlines);
        if (request.times) deadlines_.set_times(ArrivalTimes(*request.times));
        outcome_.complaints = rules_.try_solution(request.out / "runs/.worked_solution.cbor", request.regrade);
        if (const auto note = rules_.note_on_time()) outcome_.notes.push_back(*note);
        owners_.emplace(request);
        if (owners_->roster() != nullptr && owners_->roster()->converted())
            outcome_.complaints.push_back(
                Message("{} is not UTF-8; it was read as Latin-1 (Windows-1252)", request.roster->string()));
        for (const Message& clause : left_out_) outcome_.complaints.push_back(Message("{}; it is left out", clause));
        grades_.resize(submissions_.size());
        contents_.resize(submissions_.size());
        remember_inputs(request);
        chosen_ = owners_->chosen(submissions_, request.only);
        if (!request.on.empty()) shared_.emplace(request, rules_);
    }

    void run() {
        outcome_.submissions = static_cast<int>(submissions_.size());
        ProgressBar bar("grading", chosen_.size());
        std::vector<std::thread> threads;
        for (int i = 0; i < std::max(1, request_.setup.jobs); ++i) threads.emplace_back([&] { work(bar); });
        for (std::thread& thread : threads) thread.join();
        if (failure_) std::rethrow_exception(failure_);
        if (shared_) {
            shared_->conclude();
            for (Message& note : shared_->notes()) outcome_.notes.push_back(std::move(note));
        }
        take_the_others();
        tell_strays();
        tell_which_counts(results());
        // Threads end in any order.
        std::ranges::sort(outcome_.complaints, {}, [](const Message& complaint) { return message_text(complaint); });
        const ClassResults all = results();
        NeedsTheEye eye = what_needs_the_eye(all);
        outcome_.eye = std::move(eye.sentences);
        outcome_.unowned = static_cast<int>(eye.unowned);
        outcome_.unreadable = static_cast<int>(eye.unreadable);
        late_.conclude(outcome_);
        write_class_results(all);
    }

  private:
    static FileLock locked(const GradingRequest& request) {
        fs::create_directories(request.out);
        FileLock lock(request.out / ".lock");
        if (!lock.held())
            throw EnvironmentError("another dynlab grade is at work in {}; wait until it is done",
                                   request.out.string());
        return lock;
    }

    /// The folder itself, or what an LMS put into one zip.
    fs::path opened(const GradingRequest& request) {
        if (!fs::is_regular_file(request.submissions)) return request.submissions;
        left_out_ =
            unpack_export(request.submissions, export_.path() / "all", request.setup.isolation, request.setup.program);
        return export_.path() / "all";
    }

    /// What the instructor wrote about nobody, most likely by a slip of the pen.
    void tell_strays() {
        std::set<std::string> names;
        std::map<std::string, double> checks;  // and their points
        for (const Submission& submission : submissions_) names.insert(submission.name);
        for (const CheckDescription& check : rules_.checks()) checks[check.id] = check.points;
        for (Message& sentence : manual_.strays(names, checks)) outcome_.complaints.push_back(std::move(sentence));
        for (const std::string& name : deadlines_.strays(submissions_, owners_->all_names()))
            outcome_.complaints.push_back(Message("the deadline of \"{}\": there is no such submission", name));
        for (const std::string& name : owners_->strays(submissions_))
            outcome_.complaints.push_back(Message("the owner of \"{}\": there is no such submission", name));
    }

    fs::path folder_of(const Submission& submission) const { return request_.out / "results" / submission.name; }
    fs::path memory_of(const Submission& submission) const { return request_.out / "runs" / submission.name; }

    /// A submission whose runs are known, to be judged.
    struct Started {
        std::size_t index;
        GradingRules::Work work;
        std::string fingerprint, language;
        Message remark;
    };

    /// How many are judged in one box: enough to forget its start, few enough to keep all threads busy.
    std::size_t judged_together() const {
        constexpr std::size_t kMost = 16, kSharesOfAThread = 4;
        const auto threads = static_cast<std::size_t>(std::max(1, shared_ ? shared_->hands() : request_.setup.jobs));
        return std::clamp<std::size_t>(chosen_.size() / (kSharesOfAThread * threads), 1, kMost);
    }

    void work(ProgressBar& bar) {
        try {
            std::vector<Started> waiting;
            if (shared_) return work_with_others(bar);
            for (std::size_t k = next_++; k < chosen_.size() && !stopped_; k = next_++) {
                throw_if_interrupted();
                tried(chosen_[k], bar, [&] {
                    if (std::optional<Started> started = begun(chosen_[k], bar)) waiting.push_back(*std::move(started));
                });
                if (waiting.size() >= judged_together()) judge(std::exchange(waiting, {}), bar);
            }
            judge(std::move(waiting), bar);
        } catch (...) {
            stopped_ = true;
            const std::lock_guard lock(mutex_);
            if (!failure_) failure_ = std::current_exception();
        }
    }

    /// Where others run and judge: what they have done meanwhile is finished first, and no more are given out than they
    /// need. Submissions are given out in batches of neighbours, so that a run that goes on finds the same ones.
    void work_with_others(ProgressBar& bar) {
        const std::size_t size = judged_together();
        while (!stopped_) {
            throw_if_interrupted();
            if (finish_shared(bar)) continue;
            const std::size_t from = shared_->has_room() ? size * next_++ : chosen_.size();
            if (from < chosen_.size())
                give_out(from, std::min(from + size, chosen_.size()), bar);
            else if (!shared_->wait())
                return;
        }
    }

    void give_out(std::size_t from, std::size_t to, ProgressBar& bar) {
        std::vector<SharedGrading::Given> batch;
        std::vector<Started> known;  // their runs at least
        for (std::size_t k = from; k < to; ++k)
            tried(chosen_[k], bar, [&] {
                if (std::optional<Started> started = begun(chosen_[k], bar, &batch))
                    known.push_back(*std::move(started));
            });
        shared_->give(std::move(batch));
        judge(std::move(known), bar);
    }

    /// What one of the workers has done, if there is anything.
    bool finish_shared(ProgressBar& bar) {
        const auto batch = shared_->done();
        {
            const std::lock_guard lock(mutex_);
            bar.message(message_text(Message("grading on {}", shared_->sight())));
        }
        if (!batch) return false;
        for (const SharedGrading::Done& done : batch->submissions)
            tried(done.given.index, bar, [&] {
                if (!done.trouble.empty()) throw EnvironmentError(done.trouble);
                write_kept_runs(memory_of(submissions_[done.given.index]) / "run.cbor",
                                {done.given.of_runs, done.work, done.given.remark, done.given.language});
                Grade grade = done.grade;
                grade.fingerprint = done.given.fingerprint;
                grade.remark = done.given.remark, grade.language = done.given.language;
                complete(done.given.index, std::move(grade), false, bar);
            });
        shared_->forget(batch->key);
        return true;
    }

    /// What goes wrong with one submission stops no other.
    void tried(std::size_t index, ProgressBar& bar, const std::function<void()>& action) {
        try {
            action();
        } catch (const Interrupted&) {
            throw;
        } catch (const std::exception& error) {
            leave_ungraded(index, message_of(error), bar);
        }
    }

    /// Finishes what is known already or cannot be judged; gives the others, as far as they do not go into `batch`.
    std::optional<Started> begun(std::size_t index, ProgressBar& bar,
                                 std::vector<SharedGrading::Given>* batch = nullptr) {
        const Submission& submission = submissions_[index];
        contents_[index] = hash_of_content(submission);
        const std::string fingerprint = rules_.fingerprint(contents_[index], owners_->seed_of(submission));
        std::optional<Grade> grade = request_.regrade ? std::nullopt : earlier_grade(folder_of(submission));
        if (grade && grade->fingerprint == fingerprint) {
            complete(index, *std::move(grade), true, bar);
            return {};
        }
        try {
            return with_runs(index, fingerprint, batch);
        } catch (const SubmissionError& error) {
            Grade unreadable = rules_.unreadable(submission.name, error.message());
            unreadable.fingerprint = fingerprint;
            complete(index, std::move(unreadable), false, bar);
            return {};
        }
    }

    void judge(std::vector<Started> started, ProgressBar& bar) {
        if (started.empty() || stopped_) return;
        std::vector<GradingRules::Work> works;
        for (const Started& one : started) works.push_back(one.work);
        std::vector<Grade> grades;
        try {
            grades = rules_.judged(std::move(works));
        } catch (const Interrupted&) {
            throw;
        } catch (const std::exception& error) {  // of one of them: the others are judged without it
            if (started.size() == 1) return leave_ungraded(started[0].index, message_of(error), bar);
            for (Started& one : started) judge({std::move(one)}, bar);
            return;
        }
        for (std::size_t i = 0; i < started.size(); ++i)
            tried(started[i].index, bar, [&] {
                Grade& grade = grades[i];
                grade.fingerprint = started[i].fingerprint;
                grade.remark = started[i].remark, grade.language = started[i].language;
                complete(started[i].index, std::move(grade), false, bar);
            });
    }

    /// With what the roster and the deadlines say of it.
    void complete(std::size_t index, Grade grade, bool kept, ProgressBar& bar) {
        const Submission& submission = submissions_[index];
        owners_->address(submission, grade);
        const LatePenalties::Counted late = lateness_of(submission);
        grade.late_hours = late.hours;
        grade.lateness = late.reason;
        finish(submission, std::move(grade), late.percent, index);
        advance(bar, kept ? &outcome_.kept : &outcome_.made);
    }

    LatePenalties::Counted lateness_of(const Submission& submission) {
        return late_.counted(submission.name, deadlines_.of(submission, owners_->names_of(submission)));
    }

    void advance(ProgressBar& bar, int* count = nullptr) {
        const std::lock_guard lock(mutex_);
        if (count != nullptr) ++*count;
        bar.advance(++done_);
    }

    /// Of several hand-ins of one owner, each that does not count says so: known only when all are graded.
    void tell_which_counts(const ClassResults& all) {
        const std::vector<std::string> instead = counted_instead(all);
        for (std::size_t i = 0; i < submissions_.size(); ++i) {
            const bool known =
                !grades_[i] || (grades_[i]->counts_instead == instead[i] &&
                                (instead[i].empty() || grades_[i]->newest_counts == request_.newest_counts));
            std::optional<Grade> grade = known ? std::nullopt : earlier_grade(folder_of(submissions_[i]));
            if (!grade) continue;
            grade->counts_instead = instead[i];
            grade->newest_counts = request_.newest_counts;
            finish(submissions_[i], *std::move(grade), lateness_of(submissions_[i]).percent, i);
        }
    }

    /// What the grader itself cannot do costs nobody points and stops nobody else; nothing is written, so that the next
    /// run tries again.
    void leave_ungraded(std::size_t index, const Message& reason, ProgressBar& bar) {
        advance(bar);
        const std::string& name = submissions_[index].name;
        Grade grade = rules_.unreadable(name, {});
        grade.unreadable = false;
        const std::lock_guard lock(mutex_);
        grades_[index] = std::move(grade);
        outcome_.complaints.push_back(Message("\"{}\" could not be graded: {}", name, reason));
    }

    /// The runs of before where nothing that they depend on has changed; nothing where the submission goes into a batch
    /// for others. Throws SubmissionError.
    std::optional<Started> with_runs(std::size_t index, const std::string& fingerprint,
                                     std::vector<SharedGrading::Given>* batch) {
        const Submission& submission = submissions_[index];
        const fs::path kept_file = memory_of(submission) / "run.cbor";
        const GradingRules::GroupSeed seed = owners_->seed_of(submission);
        const std::string of_runs = rules_.run_fingerprint(contents_[index], seed);
        if (auto kept = request_.regrade ? std::nullopt : read_kept_runs(kept_file, of_runs))
            return Started{index,
                           {submission.name, std::move(kept->work), seed, "the runs are those of before\n"},
                           fingerprint,
                           kept->language,
                           kept->remark};
        const TemporaryFolder work;
        const StagedWork staged =
            stage_submission(submission, work.path(), request_.setup.isolation, request_.setup.program);
        if (batch != nullptr) {
            batch->push_back({index, fingerprint, of_runs, staged.language, staged.remark,
                              sent_submission(submission.name, staged, seed)});
            return {};
        }
        std::string log;
        CheckedSubmission checked = rules_.work_in(staged.folder, seed, log, staged.of_notebook);
        write_kept_runs(kept_file, {of_runs, checked, staged.remark, staged.language});
        return Started{
            index, {submission.name, std::move(checked), seed, log}, fingerprint, staged.language, staged.remark};
    }

    /// Marks, penalty and files; the file of results last, as it tells that the work is done.
    void finish(const Submission& submission, Grade grade, double late_percent, std::size_t index) {
        grade.penalty = 0;
        Grade marked = manual_.applied(grade);
        grade.penalty = marked.penalty = marked.earned() * late_percent / 100;
        const fs::path folder = folder_of(submission);
        const std::string results = to_results_json(grade, marked);
        grades_[index] = marked;
        const bool written = fs::exists(folder / (request_.pdf ? "feedback.pdf" : "feedback.md")) &&
                             fs::exists(folder / "results.json") && read_file(folder / "results.json") == results;
        if (written && !request_.regrade) return;
        fs::create_directories(folder);
        try {
            const fs::path made = memory_of(submission) / "feedback";
            if (request_.regrade) fs::remove(made);
            set_feedback(marked, folder / "feedback.pdf", made, request_.pdf ? &documents_ : nullptr);
        } catch (const EnvironmentError& error) {  // one that cannot be set stops no other, and no mark
            const std::lock_guard lock(mutex_);
            outcome_.complaints.push_back(Message("\"{}\": {}", submission.name, error.message()));
        }
        std::vector<NewFile> files = {{folder / "feedback.md", feedback_markdown(marked)}};
        if (!grade.log.empty()) {
            const fs::path logs = request_.out / "logs" / submission.name;
            fs::create_directories(logs);
            files.push_back({logs / "log.txt", terminal_text(grade.log)});
        }
        files.push_back({folder / "results.json", results});
        write_files_atomically(files);
    }

    /// Results of an earlier run for those that are not wanted now.
    void take_the_others() {
        for (std::size_t i = 0; i < submissions_.size(); ++i) {
            if (grades_[i]) continue;
            std::optional<Grade> grade = earlier_grade(folder_of(submissions_[i]));
            if (!grade) continue;
            try {
                contents_[i] = hash_of_content(submissions_[i]);
            } catch (const fs::filesystem_error&) {  // cannot be looked into, so that its content is none
            }
            if (grade->fingerprint != rules_.fingerprint(contents_[i], owners_->seed_of(submissions_[i])))
                outcome_.complaints.push_back(
                    Message("the marks of \"{}\" are from before it, the checks or the program changed; grade it, too",
                            submissions_[i].name));
            grades_[i] = manual_.applied(*std::move(grade));
        }
        for (const auto& grade : grades_)
            if (grade && !grade->whole() && !grade->unreadable) ++outcome_.not_whole;
    }

    /// Needed where the newest hand-in counts; 0 for what cannot even be looked into.
    long received(const Submission& submission) const {
        try {
            return request_.newest_counts ? deadlines_.received(submission, owners_->names_of(submission)) : 0;
        } catch (const fs::filesystem_error&) {
            return 0;
        }
    }

    ClassResults results() const {
        ClassResults results;
        results.out = request_.out;
        results.setup = &request_.setup;
        results.pdf = request_.pdf, results.documents = &documents_;
        results.roster = owners_->roster();
        results.newest_counts = request_.newest_counts;
        results.deadlines = request_.deadlines.has_value();
        for (std::size_t i = 0; i < submissions_.size(); ++i) {
            const Submission& one = submissions_[i];
            results.entries.push_back({one, grades_[i], owners_->of(one), received(one), contents_[i]});
        }
        results.complaints = outcome_.complaints;
        return results;
    }

    const GradingRequest& request_;
    GradingOutcome& outcome_;
    FileLock lock_;
    TemporaryFolder export_;
    std::vector<Message> left_out_;
    std::vector<Submission> submissions_;
    GradingRules rules_;
    ManualMarks manual_;
    BoxedDocuments documents_;
    Deadlines deadlines_;
    LatePenalties late_;
    std::optional<ClassOwners> owners_;
    std::vector<std::optional<Grade>> grades_;
    std::vector<std::string> contents_;  ///< hashes, of those that were looked at
    std::vector<std::size_t> chosen_;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> stopped_{false};
    std::size_t done_ = 0;
    std::mutex mutex_;
    std::exception_ptr failure_;
    std::optional<SharedGrading> shared_;  ///< where others run and judge
};

}  // namespace

GradingOutcome grade_class(const GradingRequest& request) {
    if (const auto obstacle = obstacle_to(request.setup.isolation)) throw EnvironmentError(*obstacle);
    if (!request.timezone.empty()) const CourseClock clock(request.timezone);  // of times in zips, too
    GradingOutcome outcome;
    ClassGrader(request, outcome).run();
    return outcome;
}

}  // namespace dynlab::inline course
