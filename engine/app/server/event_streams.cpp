#include "app/server/event_streams.h"

#include "documents/text_lines.h"

namespace dynlab::inline app {

void EventStreams::Stream::put(const std::string& text) {
    const std::lock_guard lock(mutex_);
    bytes_ += text.size();
    over_ = over_ || bytes_ > kMaxByteCount;
    if (!over_) waiting_.push_back(text);
    changed_.notify_one();
}

std::optional<std::string> EventStreams::Stream::take(std::chrono::milliseconds max_wait) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, max_wait, [&] { return over_ || !waiting_.empty(); });
    if (over_) return {};
    if (waiting_.empty()) return "";
    std::string next = std::move(waiting_.front());
    waiting_.pop_front();
    bytes_ -= next.size();
    return next;
}

void EventStreams::Stream::end() {
    const std::lock_guard lock(mutex_);
    over_ = true;
    changed_.notify_one();
}

std::shared_ptr<EventStreams::Stream> EventStreams::open() {
    const std::lock_guard lock(mutex_);
    if (ended_ || streams_.size() >= max_streams_) return nullptr;
    return *streams_.insert(std::make_shared<Stream>()).first;
}

void EventStreams::close(const std::shared_ptr<Stream>& stream) {
    const std::lock_guard lock(mutex_);
    streams_.erase(stream);
}

void EventStreams::send(const std::string& event, const std::string& data) {
    const std::string text = written(event, data);
    const std::lock_guard lock(mutex_);
    for (const std::shared_ptr<Stream>& stream : streams_) stream->put(text);
}

void EventStreams::end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    for (const std::shared_ptr<Stream>& stream : streams_) stream->end();
}

std::size_t EventStreams::count() const {
    const std::lock_guard lock(mutex_);
    return streams_.size();
}

std::string EventStreams::written(const std::string& event, const std::string& data) {
    std::string text = "event: " + event + "\n";
    for (const std::string& line : lines_of(data)) text += "data: " + line + "\n";
    return text + "\n";
}

}  // namespace dynlab::inline app
