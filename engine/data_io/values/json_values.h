#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "data_io/values/described.h"

namespace dynlab::inline data_io {

/// JSON, for files that people and other programs read: keys sorted, numbers with 17 digits; those that JSON lacks
/// are the texts "NaN", "Infinity" and "-Infinity". Vectors are lists, matrices {"rows", "columns", "values"} column by
/// column, complex numbers pairs. Members for programs only are left out.
class JsonWriter final : public ValueWriter {
  public:
    JsonWriter();
    ~JsonWriter() override;
    const nlohmann::json& value() const { return *root_; }
    /// With `indent` spaces, on one line when negative. What is not UTF-8 is replaced.
    std::string dump(int indent) const;

    bool keeps_all() const override { return false; }
    void nothing() override;
    void truth(bool value) override;
    void whole(std::int64_t value) override;
    void number(double value) override;
    void text(std::string_view value) override;
    void array(const NumberArray& value) override;
    void json_text(const std::string& value) override;
    void begin_list(std::size_t size) override;
    void end_list() override { open_.pop_back(); }
    void begin_map(std::size_t) override { begin_object(); }
    void key(std::string_view name) override { name_ = name; }
    void end_map() override { open_.pop_back(); }
    void begin_object() override;
    void member(const char* name) override { name_ = name; }
    void end_object() override { open_.pop_back(); }

  private:
    nlohmann::json& put(nlohmann::json&& value);

    std::unique_ptr<nlohmann::json> root_;
    std::vector<nlohmann::json*> open_;  ///< lists and objects that are not at their end
    std::string name_;                   ///< of the member that comes next
};

/// A text with U+FFFD for what is not UTF-8.
std::string in_utf8(std::string_view text);

/// JSON text from an untrusted source as a value in memory, within the limits; throws ValueError.
nlohmann::json parsed_json(std::string_view text, const ValueLimits& limits = {});

/// Reads what JsonWriter made; members in any order, others are passed over.
class JsonReader final : public ValueReader {
  public:
    explicit JsonReader(const nlohmann::json& value, const ValueLimits& limits = {});  ///< `value` must outlive it
    /// Of parsed_json's value.
    static JsonReader of_text(std::string_view text, const ValueLimits& limits = {});
    ~JsonReader() override;
    const nlohmann::json& here() const { return *at_; }  ///< the value that is read next

    bool keeps_all() const override { return false; }
    Kind next() override;
    void nothing() override;
    bool truth() override;
    std::int64_t whole(std::int64_t low, std::int64_t high) override;
    double number() override;

  private:
    [[noreturn]] void refuse_json(const Message& requested) const;
    void read_numbers(const nlohmann::json& list, bool complex);
    std::string_view take_text() override;
    std::string take_json_text() override;
    NumberArray take_array(std::optional<ArrayForm> requested) override;
    std::size_t open_list() override;
    std::size_t open_map() override;
    void open_object() override;
    void to_element(std::size_t index) override;
    std::string_view to_entry(std::size_t index) override;
    bool to_member(const char* name) override;
    void close_list() override { open_.pop_back(); }
    void close_map() override;
    void close_object() override { open_.pop_back(); }

    JsonReader(std::unique_ptr<const nlohmann::json> value, const ValueLimits& limits);

    struct Entries;
    std::unique_ptr<const nlohmann::json> own_;
    const nlohmann::json* at_;
    std::vector<const nlohmann::json*> open_;
    std::vector<Entries> entries_;  ///< of the maps among them
    std::vector<double> numbers_;   ///< of the last array
};

template <class T>
std::string json_of(const T& value, int indent = -1) {
    JsonWriter writer;
    write_value(writer, value);
    return writer.dump(indent);
}

template <class T>
T value_of_json(const nlohmann::json& json, const ValueLimits& limits = {}) {
    JsonReader reader(json, limits);
    return read_fresh<T>(reader);
}

/// Throws ValueError.
template <class T>
T from_json(std::string_view text, const ValueLimits& limits = {}) {
    JsonReader reader = JsonReader::of_text(text, limits);
    return read_fresh<T>(reader);
}

}  // namespace dynlab::inline data_io
