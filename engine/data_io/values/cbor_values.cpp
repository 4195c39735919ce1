#include "data_io/values/cbor_values.h"

#include <cbor.h>

#include <algorithm>
#include <bit>

#include "numerics/linalg/types.h"

namespace dynlab::inline data_io {
namespace {

static_assert(std::endian::native == std::endian::little, "typed arrays are written as they lie in memory");

constexpr std::uint64_t kNumbersTag = 86, kRowsTag = 40, kColumnsTag = 1040;  // RFC 8746
constexpr std::size_t kHeadBytes = 9;                                         // of any item without its content

/// One item's head, by a function of libcbor.
template <class Encode, class... Values>
void append_head(std::string& bytes, Encode encode, Values... values) {
    unsigned char head[kHeadBytes];
    bytes.append(reinterpret_cast<const char*>(head), encode(values..., head, sizeof head));
}

using Token = CborReader::Token;

template <Token::Type kType, class Value>
void take_value(void* token, Value value) {
    *static_cast<Token*>(token) = {kType, value};
}

template <Token::Type kType>
void take_bytes(void* token, cbor_data data, std::size_t size) {
    *static_cast<Token*>(token) = {kType, size, 0, {reinterpret_cast<const char*>(data), size}};
}

template <class Number>
void take_number(void* token, Number number) {
    *static_cast<Token*>(token) = {Token::Type::kNumber, 0, static_cast<double>(number)};
}

template <Token::Type kType>
void take_plain(void* token) {
    *static_cast<Token*>(token) = {kType};
}

cbor_callbacks make_callbacks() {
    using Type = Token::Type;
    cbor_callbacks to = cbor_empty_callbacks;
    to.uint8 = take_value<Type::kNatural>, to.uint16 = take_value<Type::kNatural>;
    to.uint32 = take_value<Type::kNatural>, to.uint64 = take_value<Type::kNatural>;
    to.negint8 = take_value<Type::kNegative>, to.negint16 = take_value<Type::kNegative>;
    to.negint32 = take_value<Type::kNegative>, to.negint64 = take_value<Type::kNegative>;
    to.byte_string = take_bytes<Type::kBytes>, to.string = take_bytes<Type::kText>;
    to.byte_string_start = take_plain<Type::kOther>, to.string_start = take_plain<Type::kOther>;
    to.array_start = take_value<Type::kList>, to.indef_array_start = take_plain<Type::kOther>;
    to.map_start = take_value<Type::kMap>, to.indef_map_start = take_plain<Type::kObject>;
    to.tag = take_value<Type::kTag>;
    to.float2 = take_number, to.float4 = take_number, to.float8 = take_number;
    to.undefined = take_plain<Type::kOther>, to.null = take_plain<Type::kNothing>;
    to.boolean = take_value<Type::kTruth>, to.indef_break = take_plain<Type::kBreak>;
    return to;
}

Message token_name(Token::Type type) {
    const Message names[] = {Message("a whole number"),
                             Message("a negative number"),
                             Message("a number"),
                             Message("a Boolean value"),
                             Message("nothing"),
                             Message("a string"),
                             Message("bytes"),
                             Message("a list"),
                             Message("a map"),
                             Message("an object"),
                             Message("a tag"),
                             Message("the object's end"),
                             Message("something unknown")};
    return names[static_cast<std::size_t>(type)];
}

Message array_name(std::optional<ArrayForm> form) {
    if (!form) return Message("an array of numbers");
    const Message names[] = {Message("a vector"), Message("a matrix"), Message("a complex vector"),
                             Message("a complex matrix")};
    return names[static_cast<std::size_t>(*form)];
}

}  // namespace

void CborWriter::nothing() {
    append_head(bytes_, cbor_encode_null);
}

void CborWriter::truth(bool value) {
    append_head(bytes_, cbor_encode_bool, value);
}

void CborWriter::whole(std::int64_t value) {
    if (value >= 0)
        append_head(bytes_, cbor_encode_uint, static_cast<std::uint64_t>(value));
    else
        append_head(bytes_, cbor_encode_negint, static_cast<std::uint64_t>(-(value + 1)));
}

void CborWriter::number(double value) {
    append_head(bytes_, cbor_encode_double, value);
}

void CborWriter::text(std::string_view value) {
    append_head(bytes_, cbor_encode_string_start, value.size());
    bytes_ += value;
}

void CborWriter::array(const NumberArray& value) {
    if (value.form != ArrayForm::kVector) {
        append_head(bytes_, cbor_encode_tag, value.form == ArrayForm::kComplexVector ? kRowsTag : kColumnsTag);
        begin_list(2);
        begin_list(value.form == ArrayForm::kComplexMatrix ? 3 : 2);
        if (value.form == ArrayForm::kComplexMatrix) whole(2);
        whole(value.rows);
        whole(value.form == ArrayForm::kComplexVector ? 2 : value.columns);
    }
    append_head(bytes_, cbor_encode_tag, kNumbersTag);
    append_head(bytes_, cbor_encode_bytestring_start, value.bytes());
    constexpr std::size_t kWhatFollows = 4096;  // space so that the text need not double after long data
    bytes_.reserve(bytes_.size() + value.bytes() + kWhatFollows);
    if (value.bytes() > 0) bytes_.append(static_cast<const char*>(value.numbers), value.bytes());
}

void CborWriter::begin_list(std::size_t size) {
    append_head(bytes_, cbor_encode_array_start, size);
}

void CborWriter::begin_map(std::size_t size) {
    append_head(bytes_, cbor_encode_map_start, size);
}

void CborWriter::begin_object() {
    append_head(bytes_, cbor_encode_indef_map_start);
}

void CborWriter::end_object() {
    append_head(bytes_, cbor_encode_break);
}

CborReader::CborReader(std::string_view bytes, const ValueLimits& limits) : ValueReader(limits), rest_(bytes) {
    if (bytes.size() > limits.bytes) refuse(Message("the value exceeds the limit of {} bytes", limits.bytes));
}

void CborReader::expect_end() const {
    if (!at_end()) refuse(Message("extra bytes follow the value"));
}

const CborReader::Token& CborReader::peek() {
    static const cbor_callbacks kCallbacks = make_callbacks();
    if (has_token_) return token_;
    token_ = {};
    const cbor_decoder_result result =
        cbor_stream_decode(reinterpret_cast<cbor_data>(rest_.data()), rest_.size(), &kCallbacks, &token_);
    if (result.status != CBOR_DECODER_FINISHED)
        refuse(result.status == CBOR_DECODER_ERROR ? Message("the bytes are not CBOR")
                                                   : Message("the bytes end too early"));
    rest_.remove_prefix(result.read);
    has_token_ = true;
    return token_;
}

Token CborReader::take(Type requested) {
    if (peek().type != requested) refuse_kind(token_name(requested), token_name(peek().type));
    has_token_ = false;
    return token_;
}

ValueReader::Kind CborReader::next() {
    switch (peek().type) {
        case Type::kNatural:
        case Type::kNegative:
            return Kind::kWhole;
        case Type::kNumber:
            return Kind::kNumber;
        case Type::kTruth:
            return Kind::kTruth;
        case Type::kNothing:
            return Kind::kNothing;
        case Type::kText:
            return Kind::kText;
        case Type::kList:
            return Kind::kList;
        case Type::kMap:
            return Kind::kMap;
        case Type::kObject:
            return Kind::kObject;
        case Type::kTag:
            return Kind::kArray;
        default:
            return Kind::kOther;
    }
}

void CborReader::nothing() {
    take(Type::kNothing);
}

bool CborReader::truth() {
    return take(Type::kTruth).value != 0;
}

std::int64_t CborReader::whole(std::int64_t low, std::int64_t high) {
    const bool negative = peek().type == Type::kNegative;
    const Token token = take(negative ? Type::kNegative : Type::kNatural);
    const bool fits = std::cmp_less_equal(token.value, std::numeric_limits<std::int64_t>::max());
    const auto size = static_cast<std::int64_t>(fits ? token.value : 0);
    const std::int64_t value = negative ? -1 - size : size;
    if (!fits || value < low || value > high)
        refuse(Message("expected a whole number from {} to {}, got {}", low, high,
                       (negative ? "-" : "") + std::to_string(token.value)));
    return value;
}

double CborReader::number() {
    if (peek().type == Type::kNatural) return static_cast<double>(take(Type::kNatural).value);
    if (peek().type == Type::kNegative) return -1 - static_cast<double>(take(Type::kNegative).value);
    return take(Type::kNumber).number;
}

std::string_view CborReader::take_text() {
    return take(Type::kText).text;
}

NumberArray CborReader::take_array(std::optional<ArrayForm> requested) {
    constexpr std::int64_t kMax = std::int64_t{1} << 31;
    const auto take_tag = [this, requested] {
        if (peek().type != Type::kTag) refuse_kind(array_name(requested), token_name(peek().type));
        return take(Type::kTag).value;
    };
    std::uint64_t tag = take_tag();
    NumberArray array{ArrayForm::kVector, 0, 1, nullptr};
    if (tag == kColumnsTag || tag == kRowsTag) {
        if (open_list() != 2) refuse(Message("an array must consist of its dimensions and its numbers"));
        const std::size_t dimensions = open_list();
        const bool complex = tag == kRowsTag || dimensions == 3;
        if (dimensions != (tag == kColumnsTag && complex ? 3 : 2)) refuse(Message("an array must have two dimensions"));
        if (tag == kColumnsTag && complex) whole(2, 2);
        array.rows = whole(0, kMax);
        array.columns = tag == kRowsTag ? whole(2, 2) - 1 : whole(0, kMax);
        array.form =
            tag == kRowsTag ? ArrayForm::kComplexVector : (complex ? ArrayForm::kComplexMatrix : ArrayForm::kMatrix);
        tag = take_tag();
    }
    if (tag != kNumbersTag) refuse_kind(array_name(requested), Message("tag {}", std::to_string(tag)));
    if (peek().type != Type::kBytes) refuse_kind(Message("the numbers of an array"), token_name(peek().type));
    const std::string_view numbers = take(Type::kBytes).text;
    const std::size_t each = array.is_complex() ? sizeof(Complex) : sizeof(double);
    const auto count = static_cast<Index>(numbers.size() / each);
    if (array.form == ArrayForm::kVector) array.rows = count;
    const bool fits = array.columns == 0 ? count == 0 : array.rows <= count / array.columns;
    if (!fits || array.bytes() != numbers.size())
        refuse(Message("{} x {} numbers do not match a length of {} bytes", array.rows, array.columns, numbers.size()));
    if (requested && *requested != array.form) refuse_kind(array_name(requested), array_name(array.form));
    array.numbers = numbers.data();
    return array;
}

std::size_t CborReader::open_list() {
    const std::uint64_t count = take(Type::kList).value;
    if (count > rest_.size()) refuse(Message("the value declares more elements than the data have bytes"));
    return count;
}

std::size_t CborReader::open_map() {
    const std::uint64_t count = take(Type::kMap).value;
    if (count > rest_.size()) refuse(Message("the value declares more entries than the data have bytes"));
    return count;
}

void CborReader::open_object() {
    take(Type::kObject);
}

bool CborReader::to_member(const char* name) {
    if (peek().type != Type::kText || peek().text != name) return false;
    has_token_ = false;
    return true;
}

void CborReader::close_object() {
    if (peek().type == Type::kText) refuse(Message("the value has an unknown or misplaced member"));
    take(Type::kBreak);
}

}  // namespace dynlab::inline data_io
