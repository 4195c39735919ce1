#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

namespace dynlab::inline app {

/// The streams of server-sent events (WHATWG HTML, 9.2) of all tabs, each with what waits to be sent to it.
class EventStreams {
  public:
    class Stream;
    explicit EventStreams(std::size_t max_streams) : max_streams_(max_streams) {}

    std::shared_ptr<Stream> open();  ///< nothing when there are as many as may be
    void close(const std::shared_ptr<Stream>& stream);
    void send(const std::string& event, const std::string& data);
    void end();  ///< all streams, and those that come
    std::size_t count() const;

    /// One event as it is sent.
    static std::string written(const std::string& event, const std::string& data);

    class Stream {
      public:
        void put(const std::string& text);
        /// Waits for what is next, so long at most; empty after that time, nothing when the stream is over.
        std::optional<std::string> take(std::chrono::milliseconds max_wait);
        void end();

      private:
        static constexpr std::size_t kMaxByteCount = std::size_t{64} << 20;
        std::mutex mutex_;
        std::condition_variable changed_;
        std::deque<std::string> waiting_;
        std::size_t bytes_ = 0;
        bool over_ = false;
    };

  private:
    const std::size_t max_streams_;
    mutable std::mutex mutex_;
    std::set<std::shared_ptr<Stream>> streams_;
    bool ended_ = false;
};

}  // namespace dynlab::inline app
