#include "course/grading/grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

#include "course/grading/class_results.h"
#include "course/grading/deadlines.h"
#include "course/grading/feedback.h"
#include "course/grading/manual_marks.h"
#include "course/grading/roster.h"
#include "course/grading/submission.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/interrupt.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/progress.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// Of what is too large to be graded, its size alone: reading it may take for ever.
std::string hash_of_content(const Submission& submission) {
    const SubmissionLimits limits;
    const auto too_large = [](std::uintmax_t bytes) { return fmt::format("too large: {}", bytes); };
    if (submission.archive) {
        const std::uintmax_t bytes = fs::file_size(submission.path);
        return bytes > limits.bytes ? too_large(bytes) : sha256_of_file(submission.path);
    }
    Sha256 hash;
    std::vector<fs::path> files;
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(submission.path))
        if (entry.symlink_status().type() == fs::file_type::regular) {
            files.push_back(entry.path());
            bytes += entry.file_size();
        }
    if (bytes > limits.bytes) return too_large(bytes);
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
        const std::string name = file.lexically_relative(submission.path).string();
        hash.add(fmt::format("{}:{}:{}:", name.size(), name, fs::file_size(file))).add_file(file);
    }
    return hash.hex();
}

/// The grading of one class, by several threads.
class ClassGrader {
  public:
    ClassGrader(const GradingRequest& request, GradingOutcome& outcome)
        : request_(request),
          outcome_(outcome),
          submissions_(submissions_in(opened(request), left_out_)),
          rules_(request.setup),
          manual_(prepared(request) / "manual.csv"),
          documents_(request.setup.isolation, request.setup.program) {
        if (request.deadlines) deadlines_ = Deadlines(*request.deadlines);
        if (request.roster) roster_.emplace(*request.roster);
        outcome_.complaints = rules_.try_solution();
        for (const std::string& clause : left_out_) outcome_.complaints.push_back(clause + "; it is left out");
        grades_.resize(submissions_.size());
        chosen_ = chosen();
    }

    void run() {
        outcome_.submissions = static_cast<int>(submissions_.size());
        ProgressBar bar("grading", chosen_.size());
        std::vector<std::thread> threads;
        for (int i = 0; i < std::max(1, request_.setup.jobs); ++i) threads.emplace_back([&] { work(bar); });
        for (std::thread& thread : threads) thread.join();
        if (failure_) std::rethrow_exception(failure_);
        take_the_others();
        tell_strays();
        std::sort(outcome_.complaints.begin(), outcome_.complaints.end());  // threads end in any order
        write_class_results(results());
    }

  private:
    /// The folder itself, or what an LMS put into one zip.
    fs::path opened(const GradingRequest& request) {
        if (!fs::is_regular_file(request.submissions)) return request.submissions;
        left_out_ =
            unpack_export(request.submissions, export_.path() / "all", request.setup.isolation, request.setup.program);
        return export_.path() / "all";
    }

    static const fs::path& prepared(const GradingRequest& request) {
        const fs::path results = request.out / "results";
        fs::create_directories(results);
        for (const auto& entry : fs::directory_iterator(results)) {
            const std::optional<Grade> grade = earlier(entry.path());
            if (!grade || grade->lesson == request.setup.lesson.slug) continue;
            throw EnvironmentError(fmt::format("{} holds the results of lesson {}; name another folder with --out",
                                               request.out.string(), grade->lesson));
        }
        return request.out;
    }

    /// What the instructor wrote about nobody, most likely by a slip of the pen.
    void tell_strays() {
        std::set<std::string> names;
        std::map<std::string, double> checks;  // and their points
        for (const Submission& submission : submissions_) names.insert(submission.name);
        for (const CheckDescription& check : rules_.checks()) checks[check.id] = check.points;
        for (std::string& sentence : manual_.strays(names, checks)) outcome_.complaints.push_back(std::move(sentence));
        for (const std::string& name : deadlines_.strays(submissions_))
            outcome_.complaints.push_back(fmt::format("the deadline of \"{}\": there is no such submission", name));
    }

    std::vector<std::size_t> chosen() const {
        std::vector<std::size_t> indices;
        for (const std::string& name : request_.only) {
            const bool known = std::any_of(submissions_.begin(), submissions_.end(),
                                           [&](const Submission& s) { return s.name == name; });
            if (!known) throw EnvironmentError(fmt::format("there is no submission \"{}\"", name));
        }
        for (std::size_t i = 0; i < submissions_.size(); ++i) {
            const bool wanted = request_.only.empty() || std::find(request_.only.begin(), request_.only.end(),
                                                                   submissions_[i].name) != request_.only.end();
            if (wanted) indices.push_back(i);
        }
        return indices;
    }

    fs::path folder_of(const Submission& submission) const { return request_.out / "results" / submission.name; }

    void work(ProgressBar& bar) {
        try {
            for (std::size_t k = next_++; k < chosen_.size() && !stopped_; k = next_++) {
                throw_if_interrupted();
                try {
                    one(chosen_[k]);
                } catch (const Interrupted&) {
                    throw;
                } catch (const std::exception& error) {
                    leave_ungraded(chosen_[k], error.what());
                }
                const std::lock_guard lock(mutex_);
                bar.advance(++done_);
            }
        } catch (...) {
            stopped_ = true;
            const std::lock_guard lock(mutex_);
            if (!failure_) failure_ = std::current_exception();
        }
    }

    void one(std::size_t index) {
        const Submission& submission = submissions_[index];
        const std::string fingerprint = rules_.fingerprint(hash_of_content(submission), seed_of(submission));
        std::optional<Grade> grade = request_.regrade ? std::nullopt : earlier(folder_of(submission));
        const bool keep = grade && grade->fingerprint == fingerprint;
        if (!keep) {
            grade = graded(submission);
            grade->fingerprint = fingerprint;
        }
        const Deadlines::Lateness late = deadlines_.of(submission);
        grade->late_hours = late.hours;
        finish(submission, *std::move(grade), late.percent, index);
        const std::lock_guard lock(mutex_);
        ++(keep ? outcome_.kept : outcome_.made);
    }

    /// What the grader itself cannot do costs nobody points and stops nobody else; nothing is written, so that the next
    /// run tries again.
    void leave_ungraded(std::size_t index, const std::string& reason) {
        const std::string& name = submissions_[index].name;
        Grade grade = rules_.without_checks(name, "");
        for (CheckGrade& check : grade.checks) check.graded = false;
        const std::lock_guard lock(mutex_);
        grades_[index] = std::move(grade);
        outcome_.complaints.push_back(fmt::format("\"{}\" could not be graded: {}", name, reason));
    }

    GradingRules::GroupSeed seed_of(const Submission& submission) const {
        const auto owners = roster_ ? roster_->owners(submission) : std::vector<std::size_t>{};
        return owners.empty() ? std::nullopt : roster_->students()[owners.front()].seed;
    }

    Grade graded(const Submission& submission) const {
        const TemporaryFolder work;
        try {
            const fs::path folder =
                stage_submission(submission, work.path(), request_.setup.isolation, request_.setup.program);
            return rules_.grade(submission.name, folder, seed_of(submission));
        } catch (const SubmissionError& error) {
            return rules_.without_checks(submission.name, error.what());
        }
    }

    static std::optional<Grade> earlier(const fs::path& folder) {
        const fs::path file = folder / "results.json";
        if (!fs::exists(file)) return {};
        try {
            return from_results_json(read_file(file));
        } catch (const EnvironmentError&) {
            return {};
        }
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
            write_feedback(marked, folder, request_.pdf ? &documents_ : nullptr);
        } catch (const EnvironmentError& error) {  // one that cannot be set stops no other, and no mark
            const std::lock_guard lock(mutex_);
            outcome_.complaints.push_back(fmt::format("\"{}\": {}", submission.name, error.what()));
        }
        if (!grade.log.empty()) {
            const fs::path log = request_.out / "logs" / submission.name / "log.txt";
            fs::create_directories(log.parent_path());
            write_file_atomically(log, terminal_text(grade.log));
        }
        write_file_atomically(folder / "results.json", results);
    }

    /// Results of an earlier run for those that are not wanted now.
    void take_the_others() {
        for (std::size_t i = 0; i < submissions_.size(); ++i)
            if (!grades_[i])
                if (auto grade = earlier(folder_of(submissions_[i]))) grades_[i] = manual_.applied(*std::move(grade));
        for (const auto& grade : grades_)
            if (grade && !grade->whole()) ++outcome_.not_whole;
    }

    ClassResults results() const {
        ClassResults results;
        results.out = request_.out;
        results.setup = &request_.setup;
        results.pdf = request_.pdf, results.documents = &documents_;
        results.roster = roster_ ? &*roster_ : nullptr;
        for (std::size_t i = 0; i < submissions_.size(); ++i) results.entries.push_back({submissions_[i], grades_[i]});
        results.complaints = outcome_.complaints;
        return results;
    }

    const GradingRequest& request_;
    GradingOutcome& outcome_;
    TemporaryFolder export_;
    std::vector<std::string> left_out_;
    std::vector<Submission> submissions_;
    GradingRules rules_;
    ManualMarks manual_;
    BoxedDocuments documents_;
    Deadlines deadlines_;
    std::optional<Roster> roster_;
    std::vector<std::optional<Grade>> grades_;
    std::vector<std::size_t> chosen_;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> stopped_{false};
    std::size_t done_ = 0;
    std::mutex mutex_;
    std::exception_ptr failure_;
};

}  // namespace

GradingOutcome grade_class(const GradingRequest& request) {
    if (const auto obstacle = obstacle_to(request.setup.isolation)) throw EnvironmentError(*obstacle);
    GradingOutcome outcome;
    ClassGrader(request, outcome).run();
    return outcome;
}

}  // namespace dynlab::inline course
