#include "app/workbench/session_text.h"

#include <chrono>
#include <thread>

#include "documents/error.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline app {
namespace {

constexpr std::size_t kMaxSteps = 500;

}  // namespace

SessionText::SessionText(std::filesystem::path file, std::vector<std::string> past)
    : file_(std::move(file)), past_(std::move(past)) {
    if (std::filesystem::exists(file_)) text_ = saved_ = text_of_source(file_);
}

bool SessionText::obey(const ScriptOrder& order) {
    if (!order.unsaved) take_from_file();
    if (order.revision != revision_) return false;
    change(order.whole ? order.text : with_edits(text_, order.edits), order.goes_on);
    if (!order.unsaved) save();
    return true;
}

void SessionText::put(const std::string& text) {
    change(text, false);
    save();
}

void SessionText::undo() {
    take_from_file();
    if (past_.empty()) return;
    future_.push_back(std::exchange(text_, past_.back()));
    past_.pop_back();
    ++revision_;
    save();
}

void SessionText::redo() {
    take_from_file();
    if (future_.empty()) return;
    past_.push_back(std::exchange(text_, future_.back()));
    future_.pop_back();
    ++revision_;
    save();
}

bool SessionText::read_changed_file() {
    if (!std::filesystem::exists(file_)) return false;
    const std::string now = text_of_source(file_);
    if (now == saved_ || now.empty()) return false;  // empty: an editor is about to write it
    saved_ = now;
    unsaved_ = Message();
    if (now == text_) return false;
    change(now, false);
    return true;
}

void SessionText::take_from_file() {
    wait_for_editor();
    try {
        read_changed_file();
    } catch (const EnvironmentError&) {
    }
}

void SessionText::wait_for_editor() const {
    constexpr auto kPause = std::chrono::milliseconds(5);
    constexpr int kMaxPauses = 60;
    const auto is_emptied = [this] {
        std::error_code missing;
        return !saved_.empty() && std::filesystem::file_size(file_, missing) == 0 && !missing;
    };
    for (int pause = 0; pause < kMaxPauses && is_emptied(); ++pause) std::this_thread::sleep_for(kPause);
}

void SessionText::change(std::string text, bool goes_on) {
    if (text == text_) return;
    if (text.size() > kMaxSourceSize)
        throw DocumentError(
            Message("the change was not applied, because the script would exceed {} MB", kMaxSourceSize >> 20));
    if (!goes_on) past_.push_back(text_);
    if (past_.size() > kMaxSteps) past_.erase(past_.begin());
    future_.clear();
    text_ = std::move(text);
    ++revision_;
}

bool SessionText::save() {
    unsaved_ = Message();
    if (text_ == saved_) return false;
    try {
        write_file_atomically(file_, text_);
        saved_ = text_;
    } catch (const EnvironmentError& error) {
        unsaved_ = error.message();
    }
    return unsaved_.empty();
}

}  // namespace dynlab::inline app
