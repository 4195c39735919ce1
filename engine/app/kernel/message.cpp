#include "app/kernel/message.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <chrono>

#include "platform/hash.h"
#include "platform/keys/secure_random.h"

namespace dynlab::inline app {
namespace {

using nlohmann::json;

constexpr const char* kProtocolVersion = "5.3";
constexpr const char* kDelimiter = "<IDS|MSG>";
constexpr std::size_t kMaxStoredSignatures = 1 << 16;  // signatures, as Jupyter's own clients keep them
constexpr int kMaxNesting = 100;
constexpr std::size_t kPartsBehind = 5;  // signature, header, parent, metadata, content

/// What is nested deeper would exhaust the stack where a message is copied or written, which goes by recursion.
json object_of(const std::string& frame, const char* what) {
    const auto shallow = [what](int depth, json::parse_event_t, const json&) {
        if (depth > kMaxNesting)
            throw BadMessage("the {} of a message is nested more than {} levels deep", what, kMaxNesting);
        return true;
    };
    json object = json::parse(frame, shallow, false);
    if (!object.is_object()) throw BadMessage("the {} of a message is not a JSON object", what);
    return object;
}

std::string dumped(const json& object) {
    return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string time_now() {
    const auto now = std::chrono::time_point_cast<std::chrono::microseconds>(std::chrono::system_clock::now());
    const auto micros = now.time_since_epoch().count() % 1'000'000;
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:06}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(now)), micros);
}

}  // namespace

MessageWire::MessageWire(std::string key) : key_(std::move(key)), session_(secure_hex(16)) {}

KernelMessage MessageWire::read(const std::vector<std::string>& frames) {
    const auto delimiter = std::find(frames.begin(), frames.end(), kDelimiter);
    if (frames.end() - delimiter < static_cast<std::ptrdiff_t>(kPartsBehind + 1))
        throw BadMessage("a message has too few parts");
    const std::string *const signature = &delimiter[1], *const parts = &delimiter[2];
    if (!equal_in_constant_time(*signature, hmac_sha256(key_, {parts[0], parts[1], parts[2], parts[3]})))
        throw BadMessage("a message is not signed with this kernel's key");
    refuse_repetition(*signature);
    KernelMessage message;
    message.identities.assign(frames.begin(), delimiter);
    message.header = object_of(parts[0], "header");
    message.parent = object_of(parts[1], "parent header");
    message.content = object_of(parts[3], "content");
    if (!message.header.contains("msg_type") || !message.header["msg_type"].is_string())
        throw BadMessage("a message has no type");
    return message;
}

/// Each header has a unique id, so that no two messages have the same signature.
void MessageWire::refuse_repetition(const std::string& signature) {
    const std::lock_guard lock(reading_);
    if (!read_.insert(signature).second) throw BadMessage("a message was received twice");
    order_.push_back(signature);
    if (order_.size() <= kMaxStoredSignatures) return;
    read_.erase(order_.front());
    order_.pop_front();
}

std::vector<std::string> MessageWire::write(const KernelMessage& message) const {
    const std::string header = dumped(message.header), parent = dumped(message.parent), metadata = "{}",
                      content = dumped(message.content);
    std::vector<std::string> frames = message.identities;
    frames.emplace_back(kDelimiter);
    frames.push_back(hmac_sha256(key_, {header, parent, metadata, content}));
    for (const std::string& part : {header, parent, metadata, content}) frames.push_back(part);
    return frames;
}

KernelMessage MessageWire::made(const std::string& type, json content, const KernelMessage& parent) {
    KernelMessage message;
    message.header = {{"msg_id", fmt::format("{}-{}", session_, ++count_)},
                      {"session", session_},
                      {"username", "kernel"},
                      {"date", time_now()},
                      {"msg_type", type},
                      {"version", kProtocolVersion}};
    message.parent = parent.header;
    message.content = std::move(content);
    return message;
}

}  // namespace dynlab::inline app
