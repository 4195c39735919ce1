#include "course/grading/grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

#include "course/grading/class_results.h"
#include "course/grading/content_hash.h"
#include "course/grading/deadlines.h"
#include "course/grading/feedback.h"
#include "course/grading/grading_memory.h"
#include "course/grading/manual_marks.h"
#include "course/grading/roster.h"
#include "course/hand_ins/owners.h"
#include "course/hand_ins/staging.h"
#include "course/store/course_clock.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/locks/abandoned_folders.h"
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
          manual_(prepared(request) / "manual.csv"),
          documents_(request.setup.isolation, request.setup.program) {
        if (!request.timezone.empty()) const CourseClock clock(request.timezone);
        if (request.deadlines) deadlines_ = Deadlines(*request.deadlines);
        read_owners();
        for (std::string& sentence : rules_.try_solution()) outcome_.complaints.push_back(std::move(sentence));
        for (const std::string& clause : left_out_) outcome_.complaints.push_back(clause + "; it is left out");
        grades_.resize(submissions_.size());
        contents_.resize(submissions_.size());
        remember();
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
        tell_which_counts(results());
        std::sort(outcome_.complaints.begin(), outcome_.complaints.end());  // threads end in any order
        const ClassResults all = results();
        NeedsTheEye eye = what_needs_the_eye(all);
        outcome_.eye = std::move(eye.sentences);
        outcome_.unowned = static_cast<int>(eye.unowned);
        outcome_.unreadable = static_cast<int>(eye.unreadable);
        write_class_results(all);
    }

  private:
    static FileLock locked(const GradingRequest& request) {
        fs::create_directories(request.out);
        FileLock lock(request.out / ".lock");
        if (!lock.held())
            throw EnvironmentError(
                fmt::format("another dynlab grade is at work in {}; wait until it is done", request.out.string()));
        return lock;
    }

    /// Refuses to put marks of another kind beside those that are there.
    void remember() {
        GradingMemory now;
        now.lesson = request_.setup.lesson.slug;
        now.lesson_checks = remembered_file(request_.setup.lesson.folder / "checks.lua");
        now.lesson_checks.name = request_.setup.lesson.slug + "/checks.lua";  // wherever it is installed
        now.checks = remembered_folder(request_.setup.more_checks);
        now.secret = remembered_text("--secret", request_.setup.secret);
        now.roster = remembered_file(request_.roster);
        now.owners = remembered_file(request_.owners);
        now.deadlines = remembered_file(request_.deadlines);
        now.keep = request_.newest_counts ? "newest" : "best";
        now.timezone = request_.timezone;
        const std::optional<GradingMemory> then = read_grading_memory(request_.out);
        if (request_.again && !request_.only.empty())
            throw EnvironmentError("--again grades all of the class anew; leave --only out");
        if (then && !request_.again)
            if (const auto differences = differences_of(*then, now, request_.only.empty()); !differences.empty())
                throw EnvironmentError(fmt::format(
                    "the marks in {} were made with other inputs: {}. Give the same again{}, or another --out",
                    request_.out.string(), fmt::join(differences, ", "),
                    request_.only.empty() ? ", or --again to grade all with these" : ""));
        write_grading_memory(request_.out, now);
    }

    /// The folder itself, or what an LMS put into one zip.
    fs::path opened(const GradingRequest& request) {
        if (!fs::is_regular_file(request.submissions)) return request.submissions;
        left_out_ =
            unpack_export(request.submissions, export_.path() / "all", request.setup.isolation, request.setup.program);
        return export_.path() / "all";
    }

    void read_owners() {
        if (request_.owners && !request_.roster)
            throw EnvironmentError("--owners tells who of a roster handed in what; give --roster CSV, too");
        if (!request_.roster) return;
        roster_.emplace(*request_.roster);
        if (roster_->converted())
            outcome_.complaints.push_back(
                fmt::format("{} is not UTF-8; it was read as Latin-1 (Windows-1252)", request_.roster->string()));
        owners_.emplace(roster_->students());
        if (request_.owners) owners_->read_list(*request_.owners);
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
        std::vector<std::string> known;
        for (std::size_t i = 0; roster_ && i < roster_->students().size(); ++i) add_names_of(i, known);
        for (const std::string& name : deadlines_.strays(submissions_, known))
            outcome_.complaints.push_back(fmt::format("the deadline of \"{}\": there is no such submission", name));
        if (!owners_) return;
        for (const std::string& name : owners_->strays(submissions_))
            outcome_.complaints.push_back(fmt::format("the owner of \"{}\": there is no such submission", name));
    }

    std::vector<std::size_t> chosen() const {
        std::vector<std::size_t> indices;
        for (const std::string& word : request_.only) {
            const std::size_t before = indices.size();
            for (std::size_t i = 0; i < submissions_.size(); ++i)
                if (is_meant(submissions_[i], word)) indices.push_back(i);
            if (indices.size() == before)
                throw EnvironmentError(
                    fmt::format("there is no submission \"{}\", nor one of a group or student of that name", word));
        }
        if (request_.only.empty())
            for (std::size_t i = 0; i < submissions_.size(); ++i) indices.push_back(i);
        std::sort(indices.begin(), indices.end());
        indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
        return indices;
    }

    /// By its name, its number, or its owner's group, id or name.
    bool is_meant(const Submission& submission, const std::string& word) const {
        const bool by_name = submission.name == word || submission.lms_id == word || submission.person == word ||
                             submission.path.filename() == word;
        if (by_name || !owners_) return by_name;
        Submission wanted;
        wanted.name = word;
        const std::vector<std::size_t> owners = owners_->find(wanted).students;
        return !owners.empty() && owners == owners_->find(submission).students;
    }

    void add_names_of(std::size_t student, std::vector<std::string>& names) const {
        const Student& s = roster_->students()[student];
        for (const std::string& name : {s.group, s.id, s.name})
            if (!name.empty()) names.push_back(name);
    }

    /// By what else than its own name a submission is known.
    std::vector<std::string> names_of_owners(const Submission& submission) const {
        std::vector<std::string> names;
        if (owners_)
            for (const std::size_t student : owners_->find(submission).students) add_names_of(student, names);
        return names;
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
        contents_[index] = hash_of_content(submission);
        const std::string fingerprint = rules_.fingerprint(contents_[index], seed_of(submission));
        std::optional<Grade> grade = request_.regrade ? std::nullopt : earlier(folder_of(submission));
        const bool keep = grade && grade->fingerprint == fingerprint;
        if (!keep) {
            grade = graded(submission, contents_[index]);
            grade->fingerprint = fingerprint;
        }
        address(submission, *grade);
        const Deadlines::Lateness late = deadlines_.of(submission, names_of_owners(submission));
        grade->late_hours = late.hours;
        grade->lateness = late.reason("en");
        grade->lateness_told = late.reason(grade->language);
        finish(submission, *std::move(grade), late.percent, index);
        const std::lock_guard lock(mutex_);
        ++(keep ? outcome_.kept : outcome_.made);
    }

    /// Whom the feedback is for, and in which language, as far as the outside and the roster tell.
    void address(const Submission& submission, Grade& grade) const {
        grade.title = submission.person;
        if (!owners_) return;
        const Owners::Found owner = owners_->find(submission);
        if (!owner.group.empty()) grade.title = owner.group;
        for (const std::size_t student : owner.students) {
            const Student& one = roster_->students()[student];
            if (owner.group.empty()) grade.title = one.name.empty() ? one.id : one.name;
            if (!one.language.empty()) grade.language = one.language;
        }
    }

    /// Of several hand-ins of one owner, each that does not count says so: known only when all are graded.
    void tell_which_counts(const ClassResults& all) {
        const std::vector<std::string> instead = counted_instead(all);
        for (std::size_t i = 0; i < submissions_.size(); ++i) {
            std::optional<Grade> grade = grades_[i] ? earlier(folder_of(submissions_[i])) : std::nullopt;
            const bool known = grade && grade->counts_instead == instead[i] &&
                               (instead[i].empty() || grade->newest_counts == request_.newest_counts);
            if (!grade || known) continue;
            grade->counts_instead = instead[i];
            grade->newest_counts = request_.newest_counts;
            const double percent = deadlines_.of(submissions_[i], names_of_owners(submissions_[i])).percent;
            finish(submissions_[i], *std::move(grade), percent, i);
        }
    }

    /// What the grader itself cannot do costs nobody points and stops nobody else; nothing is written, so that the next
    /// run tries again.
    void leave_ungraded(std::size_t index, const std::string& reason) {
        const std::string& name = submissions_[index].name;
        Grade grade = rules_.unreadable(name, "");
        grade.unreadable = false;
        const std::lock_guard lock(mutex_);
        grades_[index] = std::move(grade);
        outcome_.complaints.push_back(fmt::format("\"{}\" could not be graded: {}", name, reason));
    }

    GradingRules::GroupSeed seed_of(const Submission& submission) const {
        const auto owners = owners_ ? owners_->find(submission).students : std::vector<std::size_t>{};
        return owners.empty() ? std::nullopt : roster_->students()[owners.front()].seed;
    }

    Grade graded(const Submission& submission, const std::string& content) const {
        const fs::path kept_file = request_.out / "runs" / submission.name / "run.cbor";
        const GradingRules::GroupSeed seed = seed_of(submission);
        const std::string fingerprint = rules_.run_fingerprint(content, seed);
        if (const auto kept = request_.regrade ? std::nullopt : read_kept_runs(kept_file, fingerprint)) {
            Grade grade = rules_.judged(submission.name, kept->work, seed, "the runs are those of before\n");
            grade.remark = kept->remark, grade.language = kept->language;
            return grade;
        }
        const TemporaryFolder work;
        try {
            const StagedWork staged =
                stage_submission(submission, work.path(), request_.setup.isolation, request_.setup.program);
            std::string log;
            const CheckedSubmission checked = rules_.work_in(staged.folder, seed, log);
            write_kept_runs(kept_file, {fingerprint, checked, staged.remark, staged.language});
            Grade grade = rules_.judged(submission.name, checked, seed, log);
            grade.remark = staged.remark, grade.language = staged.language;
            return grade;
        } catch (const SubmissionError& error) {
            return rules_.unreadable(submission.name, error.what());
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
        for (std::size_t i = 0; i < submissions_.size(); ++i) {
            if (grades_[i]) continue;
            std::optional<Grade> grade = earlier(folder_of(submissions_[i]));
            if (!grade) continue;
            try {
                contents_[i] = hash_of_content(submissions_[i]);
            } catch (const fs::filesystem_error&) {  // cannot be looked into, so that its content is none
            }
            if (grade->fingerprint != rules_.fingerprint(contents_[i], seed_of(submissions_[i])))
                outcome_.complaints.push_back(fmt::format(
                    "the marks of \"{}\" are from before it, the checks or the program changed; grade it, too",
                    submissions_[i].name));
            grades_[i] = manual_.applied(*std::move(grade));
        }
        for (const auto& grade : grades_)
            if (grade && !grade->whole() && !grade->unreadable) ++outcome_.not_whole;
    }

    /// Needed where the newest hand-in counts; 0 for what cannot even be looked into.
    long received(const Submission& submission) const {
        try {
            return request_.newest_counts ? deadlines_.received(submission, names_of_owners(submission)) : 0;
        } catch (const fs::filesystem_error&) {
            return 0;
        }
    }

    ClassResults results() const {
        ClassResults results;
        results.out = request_.out;
        results.setup = &request_.setup;
        results.pdf = request_.pdf, results.documents = &documents_;
        results.roster = roster_ ? &*roster_ : nullptr;
        results.newest_counts = request_.newest_counts;
        results.deadlines = request_.deadlines.has_value();
        for (std::size_t i = 0; i < submissions_.size(); ++i) {
            const Submission& one = submissions_[i];
            results.entries.push_back(
                {one, grades_[i], owners_ ? owners_->find(one) : Owners::Found{}, received(one), contents_[i]});
        }
        results.complaints = outcome_.complaints;
        return results;
    }

    const GradingRequest& request_;
    GradingOutcome& outcome_;
    FileLock lock_;
    TemporaryFolder export_;
    std::vector<std::string> left_out_;
    std::vector<Submission> submissions_;
    GradingRules rules_;
    ManualMarks manual_;
    BoxedDocuments documents_;
    Deadlines deadlines_;
    std::optional<Roster> roster_;
    std::optional<Owners> owners_;
    std::vector<std::optional<Grade>> grades_;
    std::vector<std::string> contents_;  ///< hashes, of those that were looked at
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
    remove_abandoned_folders();
    GradingOutcome outcome;
    ClassGrader(request, outcome).run();
    return outcome;
}

}  // namespace dynlab::inline course
