#include "course/grading/grade_class.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/reader.h"
#include "course/grading/class_results.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/terminal/progress.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// Sends the work of a class through the pipeline, by several threads.
class ClassGrader {
  public:
    ClassGrader(const ClassWork& work, const EvaluatedRules& evaluated, const GradingOptions& options)
        : work_(work), options_(options), pipeline_(evaluated.rules, options, work), graded_(work.items.size()) {
        outcome_.submissions = static_cast<int>(work.items.size());
        outcome_.complaints = evaluated.complaints;
        outcome_.complaints.insert(outcome_.complaints.end(), work.complaints.begin(), work.complaints.end());
        outcome_.notes = work.notes;
        if (evaluated.note) outcome_.notes.push_back(*evaluated.note);
        outcome_.late = work.late;
        outcome_.unconfirmed = work.unconfirmed;
    }

    void grade_chosen() {
        ProgressBar bar("grading", work_.chosen.size());
        bar_ = &bar;
        std::vector<std::thread> threads;
        for (int i = 0; i < std::max(1, options_.setup.jobs); ++i) threads.emplace_back([&] { grade_some(); });
        for (std::thread& thread : threads) thread.join();
        bar_ = nullptr;
        if (failure_) std::rethrow_exception(failure_);
    }

    /// So far.
    const GradingOutcome& outcome() const { return outcome_; }

    GradingOutcome conclude(const std::function<std::vector<CountedMark>()>& count) {
        take_earlier_results();
        marks_ = count();
        say_which_counts();
        // Threads end in any order.
        std::ranges::sort(outcome_.complaints, {}, [](const Message& complaint) { return message_text(complaint); });
        const ClassResults all = results();
        Attention attention = what_needs_attention(all);
        if (auto problem = write_class_results(all, attention)) outcome_.notes.push_back(std::move(*problem));
        outcome_.attention = std::move(attention.sentences);
        outcome_.unowned = static_cast<int>(attention.unowned);
        outcome_.unreadable = static_cast<int>(attention.unreadable);
        for (const Message& note : pipeline_.documents().notes()) outcome_.notes.push_back(note);
        return std::move(outcome_);
    }

  private:
    using Waiting = std::pair<std::size_t, GradingPipeline::ToCheck>;

    /// The number of submissions that one sandbox checks: enough to make its start negligible, few enough to keep all
    /// threads busy.
    std::size_t checked_together() const {
        constexpr std::size_t kMax = 16, kSharesOfAThread = 4;
        const auto threads = static_cast<std::size_t>(std::max(1, options_.setup.jobs));
        return std::clamp<std::size_t>(work_.chosen.size() / (kSharesOfAThread * threads), 1, kMax);
    }

    void grade_some() {
        try {
            std::vector<Waiting> waiting;
            for (std::size_t k = next_++; k < work_.chosen.size() && !stopped_; k = next_++) {
                throw_if_interrupted();
                const std::size_t place = work_.chosen[k];
                guarded(place, [&] {
                    if (auto to_check = run(place)) waiting.emplace_back(place, *std::move(to_check));
                });
                if (waiting.size() >= checked_together()) check(std::exchange(waiting, {}));
            }
            check(std::move(waiting));
        } catch (...) {
            stopped_ = true;
            const std::lock_guard lock(mutex_);
            if (!failure_) failure_ = std::current_exception();
        }
    }

    /// What goes wrong with one submission stops no other.
    void guarded(std::size_t place, const std::function<void()>& action) {
        try {
            action();
        } catch (const Interrupted&) {
            throw;
        } catch (const std::exception& error) {
            leave_ungraded(place, message_of(error));
        }
    }

    /// Nothing where its grade is known without its checks: as it was made before, or as it cannot be read.
    std::optional<GradingPipeline::ToCheck> run(std::size_t place) {
        const WorkItem& item = work_.items[place];
        const std::string key = pipeline_.key_of(item);
        if (std::optional<Grade> kept = pipeline_.cached_grade(item, key)) {
            finish(place, *std::move(kept), outcome_.kept);
            return {};
        }
        try {
            if (!item.unreadable.empty()) throw SubmissionError(item.unreadable);
            return GradingPipeline::ToCheck{&item, key, pipeline_.run(item)};
        } catch (const SubmissionError& error) {
            finish(place, pipeline_.unreadable(item, key, error.message()), outcome_.made);
            return {};
        }
    }

    void check(std::vector<Waiting> waiting) {
        if (waiting.empty() || stopped_) return;
        std::vector<GradingPipeline::ToCheck> submissions;
        for (const Waiting& one : waiting) submissions.push_back(one.second);
        std::vector<Grade> grades;
        try {
            grades = pipeline_.check(std::move(submissions));
        } catch (const Interrupted&) {
            throw;
        } catch (const std::exception& error) {  // of one of them: the others are checked without it
            if (waiting.size() == 1) return leave_ungraded(waiting[0].first, message_of(error));
            for (Waiting& one : waiting) check({std::move(one)});
            return;
        }
        for (std::size_t i = 0; i < waiting.size(); ++i)
            guarded(waiting[i].first, [&] { finish(waiting[i].first, std::move(grades[i]), outcome_.made); });
    }

    void finish(std::size_t place, Grade grade, int& count) {
        keep(place, pipeline_.finish(work_.items[place], std::move(grade), options_.regrade));
        const std::lock_guard lock(mutex_);
        ++count;
        bar_->advance(++done_);
    }

    void keep(std::size_t place, GradingPipeline::Finished finished) {
        graded_[place] = std::move(finished.marked);
        if (finished.error_reason.empty()) return;
        const std::lock_guard lock(mutex_);
        outcome_.complaints.push_back(Message("\"{}\": {}", work_.items[place].submission.name, finished.error_reason));
    }

    /// What the grader itself cannot do costs no points and stops no other submission; nothing is written, so that the
    /// next run tries again.
    void leave_ungraded(std::size_t place, const Message& reason) {
        const std::string& name = work_.items[place].submission.name;
        Grade grade = pipeline_.rules().unreadable(name, {});
        grade.unreadable = false;
        const std::lock_guard lock(mutex_);
        graded_[place] = std::move(grade);
        outcome_.complaints.push_back(Message("\"{}\" could not be graded: {}", name, reason));
        ++outcome_.failed;
        bar_->advance(++done_);
    }

    /// Those of an earlier run for submissions that are not chosen now, with the marks and penalties of now.
    void take_earlier_results() {
        for (std::size_t i = 0; i < graded_.size(); ++i) {
            if (graded_[i]) continue;
            const WorkItem& item = work_.items[i];
            std::optional<Grade> grade = earlier_grade(pipeline_.results_of(item));
            if (!grade) continue;
            if (grade->fingerprint != pipeline_.key_of(item))
                outcome_.complaints.push_back(
                    Message("the marks of \"{}\" are out of date, because the submission, the checks or the program "
                            "changed after grading; include the submission in --only",
                            item.submission.name));
            keep(i, pipeline_.finish(item, *std::move(grade), false));
        }
        for (const std::optional<Grade>& grade : graded_)
            if (grade && !grade->whole() && !grade->unreadable) ++outcome_.not_whole;
    }

    /// Of several submissions of one student, each that does not count says so: known only when all are graded.
    void say_which_counts() {
        const std::vector<std::string> instead = counted_instead(results());
        for (std::size_t i = 0; i < graded_.size(); ++i) {
            if (!graded_[i]) continue;
            auto finished = pipeline_.finish_as_counted(work_.items[i], *graded_[i], instead[i]);
            if (finished) keep(i, *std::move(finished));
        }
    }

    ClassResults results() const {
        ClassResults results;
        results.work = &work_;
        results.out = options_.out;
        results.setup = &options_.setup;
        results.pdf = options_.pdf, results.documents = &pipeline_.documents();
        for (std::size_t i = 0; i < graded_.size(); ++i) results.entries.push_back({&work_.items[i], graded_[i]});
        results.marks = marks_;
        results.complaints = outcome_.complaints;
        return results;
    }

    const ClassWork& work_;
    const GradingOptions& options_;
    GradingOutcome outcome_;
    GradingPipeline pipeline_;
    std::vector<std::optional<Grade>> graded_;  ///< as work_.items
    std::vector<CountedMark> marks_;            ///< as work_.students
    ProgressBar* bar_ = nullptr;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> stopped_{false};
    std::size_t done_ = 0;
    std::mutex mutex_;
    std::exception_ptr failure_;
};

const GradingSetup& isolated(const GradingSetup& setup) {
    if (const auto obstacle = obstacle_to(setup.isolation)) throw EnvironmentError(*obstacle);
    return setup;
}

}  // namespace

FileLock lock_results(const fs::path& out) {
    fs::create_directories(out);
    FileLock lock(out / ".lock");
    if (!lock.held())
        throw EnvironmentError("another run of dynlab grade uses {}; wait until the other run ends", out.string());
    return lock;
}

EvaluatedRules::EvaluatedRules(const GradingOptions& options) : rules(isolated(options.setup)) {
    complaints = rules.try_solution(options.out / "runs/.worked_solution.cbor", options.regrade);
    note = rules.note_on_time();
}

GradingOutcome grade_class(const ClassWork& work, const EvaluatedRules& evaluated, const GradingOptions& options,
                           const std::function<std::vector<CountedMark>()>& count) {
    ClassGrader grader(work, evaluated, options);
    grader.grade_chosen();
    return grader.conclude(count);
}

GradingOutcome grade_part_of_class(const ClassWork& work, const WorkPart& part, const EvaluatedRules& evaluated,
                                   const GradingOptions& options) {
    ClassWork own = work;
    own.chosen.clear();
    for (std::size_t k = 0; k < work.chosen.size(); ++k)
        if (part.has(k)) own.chosen.push_back(work.chosen[k]);
    ClassGrader grader(own, evaluated, options);
    grader.grade_chosen();
    return grader.outcome();
}

MissingParts ungraded_parts(const ClassWork& work, int parts, const EvaluatedRules& evaluated,
                            const GradingOptions& options) {
    const GradingPipeline pipeline(evaluated.rules, options, work);
    MissingParts missing;
    for (std::size_t k = 0; k < work.chosen.size(); ++k) {
        const int part = WorkPart{1, parts}.part_of(k);
        const WorkItem& item = work.items[work.chosen[k]];
        if (!missing.parts.contains(part) && !pipeline.cached_grade(item, pipeline.key_of(item)))
            missing.parts.insert(part);
    }
    return missing;
}

}  // namespace dynlab::inline course
