#include "data_io/values/value_stream.h"

#include <fmt/format.h>

#include "data_io/values/json_values.h"

namespace dynlab::inline data_io {
namespace {

/// A key for messages. The key is untrusted.
std::string shown_key(const std::string& key) {
    constexpr std::size_t kMaxLength = 40;
    std::string shown;
    for (const char c : key.substr(0, kMaxLength)) shown += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    return key.size() > kMaxLength ? shown + "..." : shown;
}

}  // namespace

Message ValueReader::location() const {
    std::string text;
    for (const Step& step : steps_) {
        if (step.in == Step::In::kList && step.index > 0)
            text += fmt::format("[{}]", step.index);
        else if (step.in == Step::In::kMap && step.index > 0)
            text += fmt::format("[\"{}\"]", shown_key(step.key));
        else if (step.in == Step::In::kObject && step.name)
            text += (text.empty() ? "" : ".") + std::string(step.name);
    }
    return text.empty() ? Message("the value") : Message::verbatim(text);
}

void ValueReader::refuse(const Message& sentence) const {
    throw ValueError(Message("{}: {}", location(), sentence));
}

void ValueReader::refuse_kind(const Message& requested, const Message& given) const {
    refuse(Message("expected {}, got {}", requested, given));
}

void ValueReader::lacks(const char* member) const {
    refuse(Message("the member \"{}\" is missing", member));
}

void ValueReader::charge(std::size_t bytes) {
    if (bytes > memory_left_) refuse(Message("the value exceeds the allowed {} bytes", limits_.memory));
    memory_left_ -= bytes;
}

void ValueReader::enter(Step step) {
    if (steps_.size() >= limits_.depth) refuse(Message("the value is nested deeper than {} levels", limits_.depth));
    charge(sizeof(Step));
    steps_.push_back(std::move(step));
}

std::string ValueReader::text() {
    const std::string_view text = take_text();
    charge(text.size());
    return limits_.only_utf8 ? in_utf8(text) : std::string(text);
}

std::string ValueReader::json_text() {
    std::string text = take_json_text();
    charge(text.size());
    return text;
}

std::size_t ValueReader::one_of(std::span<const char* const> names) {
    const std::string_view name = take_text();
    for (std::size_t i = 0; i < names.size(); ++i)
        if (name == names[i]) return i;
    refuse(Message("expected one of {}, got another string", listed({names.begin(), names.end()})));
}

NumberArray ValueReader::array(std::optional<ArrayForm> requested) {
    const NumberArray numbers = take_array(requested);
    charge(numbers.bytes());
    return numbers;
}

std::size_t ValueReader::begin_list(std::size_t element_bytes) {
    const std::size_t count = open_list();
    if (count > limits_.memory) refuse(Message("the value has too many elements"));
    enter({Step::In::kList});
    charge(count * element_bytes);
    return count;
}

void ValueReader::element() {
    to_element(steps_.back().index++);
}

void ValueReader::end_list() {
    close_list();
    steps_.pop_back();
}

std::size_t ValueReader::begin_map(std::size_t entry_bytes) {
    constexpr std::size_t kNodeBytes = 64;  // of a std::map, with its key
    const std::size_t count = open_map();
    if (count > limits_.memory) refuse(Message("the value has too many entries"));
    enter({Step::In::kMap});
    charge(count * (entry_bytes + kNodeBytes));
    return count;
}

std::string ValueReader::key() {
    const std::string_view key = to_entry(steps_.back().index++);
    charge(key.size());
    return steps_.back().key = limits_.only_utf8 ? in_utf8(key) : std::string(key);
}

void ValueReader::end_map() {
    close_map();
    steps_.pop_back();
}

void ValueReader::begin_object() {
    open_object();
    enter({Step::In::kObject});
}

bool ValueReader::member(const char* name) {
    steps_.back().name = nullptr;
    if (!to_member(name)) return false;
    steps_.back().name = name;
    return true;
}

void ValueReader::end_members() {
    steps_.back().name = nullptr;
}

void ValueReader::end_object() {
    end_members();
    close_object();
    steps_.pop_back();
}

}  // namespace dynlab::inline data_io
