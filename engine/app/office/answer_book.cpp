#include "app/office/answer_book.h"

#include <fmt/format.h>

#include "base/error.h"
#include "course/answers/hidden_names.h"
#include "course/intake/staging.h"
#include "documents/text_lines.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline app {
namespace {

std::vector<TextPart> parts_in_pack(const SubmittedWork& work) {
    const TemporaryFolder folder;
    Submission submission;
    submission.name = work.hash;
    // Archives are recognized by their names.
    const auto stem = archive_stem(work.name);
    submission.path = folder.path() / ("pack" + (stem ? work.name.substr(stem->size()) : ".zip"));
    submission.archive = true;
    std::filesystem::create_directories(folder.path() / "work");
    std::filesystem::copy_file(work.file, submission.path);
    return text_parts_in(
        stage_submission(submission, folder.path() / "work", strongest_isolation(), running_program()).folder);
}

std::string names_in(const std::vector<Student>& roster) {
    std::string all;
    for (const Student& student : roster) {
        all += student.id + "\n" + student.name + "\n" + student.mail + "\n" + student.group + "\n";
        for (const FormerName& former : student.former) all += former.name + "\n" + former.mail + "\n";
    }
    return digest_of(all).hex();
}

}  // namespace

AnswerBook::AnswerBook(std::function<void()> more)
    : more_(std::move(more)), reader_([this](const std::stop_token& stop) { read_packs(stop); }) {}

AnswerBook::~AnswerBook() = default;

const AnswerBook::Read* AnswerBook::read(const SubmittedWork& work) {
    if (const auto known = read_.find(work.hash); known != read_.end()) return &known->second;
    if (work.part == "script") {
        Read& read = read_[work.hash];
        try {
            read.parts = text_parts_of_script(text_of_source(work.file));
        } catch (const std::exception& error) {
            read.error_reason = message_of(error);
        }
        return &read;
    }
    if (requested_.insert(work.hash).second) {
        waiting_.push_back(work);
        changed_.notify_all();
    }
    return nullptr;
}

void AnswerBook::read_packs(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
        const SubmittedWork work = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        Read read;
        try {
            read.parts = parts_in_pack(work);
        } catch (const std::exception& error) {
            read.error_reason = message_of(error);
        }
        lock.lock();
        read_[work.hash] = std::move(read);
        requested_.erase(work.hash);
        lock.unlock();
        more_();
        lock.lock();
    }
}

std::vector<AnswerBook::Answer> AnswerBook::answers(const std::vector<SubmittedWork>& work,
                                                    const LessonQuestions& lesson, const QuestionName& question,
                                                    const std::vector<Student>& roster) {
    const std::lock_guard lock(mutex_);
    if (const std::string names = names_in(roster); names != roster_) hidden_.clear(), roster_ = names;
    std::optional<HiddenNames> names;  // reading a roster takes a while
    std::vector<Answer> answers;
    for (const SubmittedWork& one : work) {
        const Read* const read = this->read(one);
        if (read == nullptr) {
            answers.push_back({"", {}, true});
            continue;
        }
        const std::string title = question.titles.empty() ? "" : *question.titles.begin();
        const std::string key = fmt::format("{}\n{}\n{}\n{}", one.hash, one.group, question.number, title);
        auto hidden = hidden_.find(key);
        if (hidden == hidden_.end()) {
            if (!names) names.emplace(roster);
            const std::string text = written_answer(read->parts, question, lesson.given());
            hidden = hidden_.emplace(key, text.empty() ? text : names->hidden_in(text, one.authors)).first;
        }
        answers.push_back({hidden->second, read->error_reason, false});
    }
    return answers;
}

}  // namespace dynlab::inline app
