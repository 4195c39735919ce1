#include "data_io/values/json_values.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "numerics/linalg/types.h"

namespace dynlab::inline data_io {
namespace {

using nlohmann::json;

constexpr const char *kNanText = "NaN", *kInfinite = "Infinity", *kMinusInfinite = "-Infinity";

json json_number(double value) {
    if (std::isnan(value)) return kNanText;
    if (std::isinf(value)) return value > 0 ? kInfinite : kMinusInfinite;
    return value;
}

std::optional<double> number_in(const json& value) {
    if (value.is_number()) return value.get<double>();
    if (!value.is_string()) return {};
    if (value == kNanText) return kNaN;
    if (value == kInfinite) return kInfinity;
    if (value == kMinusInfinite) return -kInfinity;
    return {};
}

json list_of_numbers(const NumberArray& array) {
    const auto* const numbers = static_cast<const double*>(array.numbers);
    const auto count = static_cast<std::size_t>(array.rows * array.columns);
    json list = json::array();
    list.get_ref<json::array_t&>().reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (array.is_complex())
            list.push_back({json_number(numbers[2 * i]), json_number(numbers[2 * i + 1])});
        else
            list.push_back(json_number(numbers[i]));
    }
    return list;
}

/// Counts values and levels before the tree is made. A callback of json::parse could count them as well, but makes
/// the time grow with the square of a list's length.
class LimitCheck final : public nlohmann::json_sax<json> {
  public:
    explicit LimitCheck(const ValueLimits& limits) : limits_(limits), memory_left_(limits.memory) {}

    bool null() override { return count(); }
    bool boolean(bool) override { return count(); }
    bool number_integer(number_integer_t) override { return count(); }
    bool number_unsigned(number_unsigned_t) override { return count(); }
    bool number_float(number_float_t, const string_t&) override { return count(); }
    bool string(string_t&) override { return count(); }
    bool binary(binary_t&) override { return false; }  // JSON has none
    bool start_object(std::size_t) override { return begin(); }
    bool key(string_t&) override { return count(); }
    bool end_object() override { return end(); }
    bool start_array(std::size_t) override { return begin(); }
    bool end_array() override { return end(); }
    bool parse_error(std::size_t, const std::string&, const json::exception&) override { return false; }

  private:
    bool count() {
        if (depth_ > limits_.depth) throw ValueError("the JSON text is nested too deeply");
        constexpr std::size_t kNodeBytes = 64;  // of one value, with its place in a list or map
        if (memory_left_ < kNodeBytes) throw ValueError("the JSON text contains too many values");
        memory_left_ -= kNodeBytes;
        return true;
    }
    bool begin() {
        count();
        ++depth_;
        return true;
    }
    bool end() {
        --depth_;
        return count();
    }

    const ValueLimits& limits_;
    std::size_t memory_left_, depth_ = 0;
};

}  // namespace

JsonWriter::JsonWriter() : root_(std::make_unique<json>()) {}
JsonWriter::~JsonWriter() = default;

json& JsonWriter::put(json&& value) {
    if (open_.empty()) return *root_ = std::move(value);
    json& parent = *open_.back();
    if (parent.is_object()) return parent[name_] = std::move(value);
    parent.push_back(std::move(value));
    return parent.back();
}

std::string JsonWriter::dump(int indent) const {
    return root_->dump(indent, ' ', false, json::error_handler_t::replace);
}

void JsonWriter::json_text(const std::string& value) {
    put(json::parse(value));
}

void JsonWriter::nothing() {
    put(nullptr);
}

void JsonWriter::truth(bool value) {
    put(value);
}

void JsonWriter::whole(std::int64_t value) {
    put(value);
}

void JsonWriter::number(double value) {
    put(json_number(value));
}

void JsonWriter::text(std::string_view value) {
    put(std::string(value));
}

void JsonWriter::array(const NumberArray& value) {
    const bool list = value.form == ArrayForm::kVector || value.form == ArrayForm::kComplexVector;
    if (list)
        put(list_of_numbers(value));
    else
        put({{"rows", value.rows}, {"columns", value.columns}, {"values", list_of_numbers(value)}});
}

void JsonWriter::begin_list(std::size_t size) {
    json& list = put(json::array());
    list.get_ref<json::array_t&>().reserve(size);
    open_.push_back(&list);
}

void JsonWriter::begin_object() {
    open_.push_back(&put(json::object()));
}

std::string in_utf8(std::string_view text) {
    const bool ascii = std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    if (ascii) return std::string(text);
    return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

json parsed_json(std::string_view text, const ValueLimits& limits) {
    if (text.size() > limits.bytes) throw ValueError("the JSON text exceeds the length limit");
    LimitCheck check(limits);
    if (!json::sax_parse(text, &check)) throw ValueError("the text is not JSON");
    return json::parse(text);
}

struct JsonReader::Entries {
    json::const_iterator next;
};

JsonReader::JsonReader(const json& value, const ValueLimits& limits) : ValueReader(limits), at_(&value) {}
JsonReader::JsonReader(std::unique_ptr<const json> value, const ValueLimits& limits)
    : ValueReader(limits), own_(std::move(value)), at_(own_.get()) {}
JsonReader::~JsonReader() = default;

JsonReader JsonReader::of_text(std::string_view text, const ValueLimits& limits) {
    return JsonReader(std::make_unique<const json>(parsed_json(text, limits)), limits);
}

void JsonReader::refuse_json(const Message& requested) const {
    refuse_kind(requested, Message("a JSON value of type {}", at_->type_name()));
}

ValueReader::Kind JsonReader::next() {
    if (at_->is_null()) return Kind::kNothing;
    if (at_->is_boolean()) return Kind::kTruth;
    if (at_->is_number_integer()) return Kind::kWhole;
    if (at_->is_number()) return Kind::kNumber;
    if (at_->is_string()) return Kind::kText;
    return at_->is_array() ? Kind::kList : Kind::kObject;
}

void JsonReader::nothing() {
    if (!at_->is_null()) refuse_json(Message("nothing"));
}

bool JsonReader::truth() {
    if (!at_->is_boolean()) refuse_json(Message("a Boolean value"));
    return at_->get<bool>();
}

std::int64_t JsonReader::whole(std::int64_t low, std::int64_t high) {
    if (!at_->is_number_integer()) refuse_json(Message("a whole number"));
    const bool fits = !at_->is_number_unsigned() || std::cmp_less_equal(at_->get<std::uint64_t>(), high);
    const auto value = at_->get<std::int64_t>();
    if (!fits || value < low || value > high)
        refuse_kind(Message("a whole number from {} to {}", low, high), Message::verbatim(at_->dump()));
    return value;
}

double JsonReader::number() {
    const auto number = number_in(*at_);
    if (!number) refuse_json(Message("a number"));
    return *number;
}

std::string_view JsonReader::take_text() {
    if (!at_->is_string()) refuse_json(Message("a string"));
    return at_->get_ref<const std::string&>();
}

std::string JsonReader::take_json_text() {
    return at_->dump(-1, ' ', false, json::error_handler_t::replace);
}

void JsonReader::read_numbers(const json& list, bool complex) {
    const auto add = [this](const json& value) {
        const auto number = number_in(value);
        if (!number)
            refuse_kind(Message("a list of numbers"),
                        Message("a list with a JSON value of type {}", value.type_name()));
        numbers_.push_back(*number);
    };
    if (!list.is_array()) refuse_json(Message("a list of numbers"));
    numbers_.clear();
    for (const json& value : list) {
        if (!complex) {
            add(value);
            continue;
        }
        if (!value.is_array() || value.size() != 2)
            refuse(Message("a complex number must consist of a real and an imaginary part"));
        add(value[0]), add(value[1]);
    }
}

NumberArray JsonReader::take_array(std::optional<ArrayForm> requested) {
    const ArrayForm form = requested.value_or(at_->is_array() ? ArrayForm::kVector : ArrayForm::kMatrix);
    NumberArray array{form, 0, 1, nullptr};
    if (form == ArrayForm::kVector || form == ArrayForm::kComplexVector) {
        read_numbers(*at_, array.is_complex());
        array.rows = static_cast<Index>(numbers_.size()) / (array.is_complex() ? 2 : 1);
    } else {
        const auto size = [&](const char* name) {
            constexpr std::int64_t kMax = std::int64_t{1} << 31;
            if (!at_->is_object() || !at_->contains(name) || !at_->at(name).is_number_integer())
                refuse_json(Message("a matrix with rows, columns and values"));
            const auto value = at_->at(name).get<std::int64_t>();
            if (value < 0 || value > kMax) refuse(Message("the number of {} is out of range", name));
            return static_cast<Index>(value);
        };
        array.rows = size("rows"), array.columns = size("columns");
        if (!at_->contains("values")) lacks("values");
        read_numbers(at_->at("values"), array.is_complex());
        const auto count = static_cast<Index>(numbers_.size()) / (array.is_complex() ? 2 : 1);
        const bool fits = array.columns == 0 ? count == 0 : array.rows <= count / array.columns;
        if (!fits || array.rows * array.columns != count)
            refuse_kind(Message("{} x {} numbers", array.rows, array.columns), Message("a different number of values"));
    }
    array.numbers = numbers_.data();
    return array;
}

std::size_t JsonReader::open_list() {
    if (!at_->is_array()) refuse_json(Message("a list"));
    open_.push_back(at_);
    return at_->size();
}

std::size_t JsonReader::open_map() {
    if (!at_->is_object()) refuse_json(Message("an object"));
    open_.push_back(at_);
    entries_.push_back({at_->begin()});
    return at_->size();
}

void JsonReader::close_map() {
    open_.pop_back();
    entries_.pop_back();
}

void JsonReader::open_object() {
    if (!at_->is_object()) refuse_json(Message("an object"));
    open_.push_back(at_);
}

void JsonReader::to_element(std::size_t index) {
    at_ = &(*open_.back())[index];
}

std::string_view JsonReader::to_entry(std::size_t) {
    const auto entry = entries_.back().next++;
    at_ = &*entry;
    return entry.key();
}

bool JsonReader::to_member(const char* name) {
    const auto found = open_.back()->find(name);
    if (found == open_.back()->end()) return false;
    at_ = &*found;
    return true;
}

}  // namespace dynlab::inline data_io
