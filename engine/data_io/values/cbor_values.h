#pragma once
#include <string>
#include <string_view>

#include "data_io/values/described.h"

namespace dynlab::inline data_io {

/// CBOR (RFC 8949), for caches and sandboxes: every number is stored bit by bit, NaN and infinity too, so that equal
/// bytes are equal values. Arrays are typed arrays of RFC 8746, little-endian: tag 86, matrices in tag 1040 with their
/// rows and columns, complex ones with a dimension of 2 (complex vectors in tag 40). Objects are maps of indefinite
/// length, their members in the order of the description. Texts keep their bytes, UTF-8 or not.
class CborWriter final : public ValueWriter {
  public:
    const std::string& bytes() const { return bytes_; }
    std::string take() { return std::move(bytes_); }
    void encoded(const std::string& bytes) { bytes_ += bytes; }  ///< what another one wrote

    bool keeps_all() const override { return true; }
    void nothing() override;
    void truth(bool value) override;
    void whole(std::int64_t value) override;
    void number(double value) override;
    void text(std::string_view value) override;
    void array(const NumberArray& value) override;
    void json_text(const std::string& value) override { text(value); }
    void begin_list(std::size_t size) override;
    void end_list() override {}
    void begin_map(std::size_t size) override;
    void key(std::string_view name) override { text(name); }
    void end_map() override {}
    void begin_object() override;
    void member(const char* name) override { text(name); }
    void end_object() override;

  private:
    std::string bytes_;
};

/// Reads it again, from anybody: only what the caller asks for is taken from the bytes, and memory only for that. The
/// bytes must live as long as the reader.
class CborReader final : public ValueReader {
  public:
    explicit CborReader(std::string_view bytes, const ValueLimits& limits = {});
    bool at_end() const { return !has_token_ && rest_.empty(); }
    void expect_end() const;  ///< throws ValueError where bytes are left

    bool keeps_all() const override { return true; }
    Kind next() override;
    void nothing() override;
    bool truth() override;
    std::int64_t whole(std::int64_t low, std::int64_t high) override;
    double number() override;

    struct Token {
        enum class Type {
            kNatural,
            kNegative,
            kNumber,
            kTruth,
            kNothing,
            kText,
            kBytes,
            kList,
            kMap,
            kObject,
            kTag,
            kBreak,
            kOther
        } type = Type::kOther;
        std::uint64_t value = 0;  ///< of whole numbers (-1 - value for negative ones) and tags; sizes
        double number = 0;
        std::string_view text = {};
    };

  private:
    using Type = Token::Type;
    const Token& peek();
    Token take(Type requested);
    std::string_view take_text() override;
    std::string take_json_text() override { return std::string(take_text()); }
    NumberArray take_array(std::optional<ArrayForm> requested) override;
    std::size_t open_list() override;
    std::size_t open_map() override;
    void open_object() override;
    void to_element(std::size_t) override {}
    std::string_view to_entry(std::size_t) override { return take_text(); }
    bool to_member(const char* name) override;
    void close_object() override;

    std::string_view rest_;
    Token token_;
    bool has_token_ = false;
};

template <class T>
std::string cbor_of(const T& value) {
    CborWriter writer;
    write_value(writer, value);
    return writer.take();
}

/// Throws ValueError.
template <class T>
T from_cbor(std::string_view bytes, const ValueLimits& limits = {}) {
    CborReader reader(bytes, limits);
    T value = read_fresh<T>(reader);
    reader.expect_end();
    return value;
}

}  // namespace dynlab::inline data_io
