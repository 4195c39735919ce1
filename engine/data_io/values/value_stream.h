#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/message.h"
#include "data_io/values/value_limits.h"

namespace dynlab::inline data_io {

enum class ArrayForm { kVector, kMatrix, kComplexVector, kComplexMatrix };

/// Numbers in columns; complex ones as real and imaginary part in turn.
struct NumberArray {
    ArrayForm form;
    std::ptrdiff_t rows, columns;
    const void* numbers;

    bool is_complex() const { return form == ArrayForm::kComplexVector || form == ArrayForm::kComplexMatrix; }
    std::size_t bytes() const {
        return static_cast<std::size_t>(rows * columns) * sizeof(double) * (is_complex() ? 2 : 1);
    }
};

/// Takes a value piece by piece and makes CBOR or JSON of it. Lists, maps and objects enclose what follows; an object's
/// members are named and may be left out, a map's keys are data.
class ValueWriter {
  public:
    virtual ~ValueWriter() = default;
    /// Whether members that are for programs only are wanted, too (described.h).
    virtual bool keeps_all() const = 0;

    virtual void nothing() = 0;
    virtual void truth(bool value) = 0;
    virtual void whole(std::int64_t value) = 0;
    virtual void number(double value) = 0;
    virtual void text(std::string_view value) = 0;
    virtual void array(const NumberArray& value) = 0;
    virtual void json_text(const std::string& text) = 0;  ///< a value that is JSON already: in CBOR a text
    virtual void begin_list(std::size_t size) = 0;
    virtual void end_list() = 0;
    virtual void begin_map(std::size_t size) = 0;
    virtual void key(std::string_view name) = 0;
    virtual void end_map() = 0;
    virtual void begin_object() = 0;
    virtual void member(const char* name) = 0;
    virtual void end_object() = 0;
};

/// Gives a value piece by piece to a caller that knows its expected type. Every function throws ValueError if the input
/// has another type, or passes a limit; the message begins with its location. Members of an object come in the order in
/// which they were written.
class ValueReader {
  public:
    explicit ValueReader(const ValueLimits& limits) : limits_(limits), memory_left_(limits.memory) {}
    virtual ~ValueReader() = default;
    const ValueLimits& limits() const { return limits_; }
    virtual bool keeps_all() const = 0;

    enum class Kind { kNothing, kTruth, kWhole, kNumber, kText, kArray, kList, kMap, kObject, kOther };
    virtual Kind next() = 0;  ///< the kind at this place; nothing is consumed

    virtual void nothing() = 0;
    virtual bool truth() = 0;
    virtual std::int64_t whole(std::int64_t low, std::int64_t high) = 0;  ///< at least, at most
    virtual double number() = 0;
    std::string text();
    std::string json_text();  ///< what ValueWriter::json_text() wrote; of JSON, the value at this place
    std::size_t one_of(std::span<const char* const> names);  ///< the index of the text among them
    /// Numbers of this form, or of any; they are there until the next call.
    NumberArray array(std::optional<ArrayForm> requested);

    /// The number of elements, each of which will take `element_bytes`; call element() before each is read.
    std::size_t begin_list(std::size_t element_bytes);
    void element();
    void end_list();
    std::size_t begin_map(std::size_t entry_bytes);
    std::string key();
    void end_map();
    void begin_object();
    bool member(const char* name);  ///< whether it is there; then it is read next
    void end_members();             ///< what is refused from now on is the object itself
    void end_object();

    [[noreturn]] void refuse(const Message& sentence) const;
    [[noreturn]] void lacks(const char* member) const;

  protected:
    void charge(std::size_t bytes);  ///< before so much memory is taken
    [[noreturn]] void refuse_kind(const Message& requested, const Message& given) const;

  private:
    virtual std::string_view take_text() = 0;
    virtual std::string take_json_text() = 0;
    virtual NumberArray take_array(std::optional<ArrayForm> requested) = 0;
    virtual std::size_t open_list() = 0;
    virtual std::size_t open_map() = 0;
    virtual void open_object() = 0;
    virtual void to_element(std::size_t index) = 0;
    virtual std::string_view to_entry(std::size_t index) = 0;  ///< its key
    virtual bool to_member(const char* name) = 0;
    virtual void close_list() {}
    virtual void close_map() {}
    virtual void close_object() {}

    /// Where in a list (by number), a map (by key) or an object (by a name that lives on) the reader is.
    struct Step {
        enum class In { kList, kMap, kObject } in;
        std::size_t index = 0;  ///< of the next one
        std::string key = {};
        const char* name = nullptr;
    };
    void enter(Step step);
    Message location() const;

    ValueLimits limits_;
    std::size_t memory_left_;
    std::vector<Step> steps_;
};

}  // namespace dynlab::inline data_io
