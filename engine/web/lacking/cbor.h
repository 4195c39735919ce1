#pragma once
/// What data_io/values calls of libcbor: the heads of items (RFC 8949, section 3) and the decoder of one item.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

using cbor_data = const unsigned char*;

enum cbor_decoder_status { CBOR_DECODER_FINISHED, CBOR_DECODER_NEDATA, CBOR_DECODER_ERROR };
struct cbor_decoder_result {
    std::size_t read;
    cbor_decoder_status status;
};

struct cbor_callbacks {
    using Number = void (*)(void*, std::uint64_t);
    using Bytes = void (*)(void*, cbor_data, std::size_t);
    using Size = void (*)(void*, std::size_t);
    using Plain = void (*)(void*);
    void (*uint8)(void*, std::uint8_t), (*negint8)(void*, std::uint8_t);
    void (*uint16)(void*, std::uint16_t), (*negint16)(void*, std::uint16_t);
    void (*uint32)(void*, std::uint32_t), (*negint32)(void*, std::uint32_t);
    Number uint64, negint64, tag;
    Bytes byte_string, string;
    Size array_start, map_start;
    void (*float2)(void*, float), (*float4)(void*, float);
    void (*float8)(void*, double);
    void (*boolean)(void*, bool);
    Plain byte_string_start, string_start, indef_array_start, indef_map_start, undefined, null, indef_break;
};
inline constexpr cbor_callbacks cbor_empty_callbacks{};

namespace cbor_heads {
enum Major { kNatural, kNegative, kBytes, kText, kList, kMap, kTag, kOther };

/// The shortest head of this kind with this number.
inline std::size_t write(Major major, std::uint64_t value, unsigned char* to, std::size_t capacity) {
    const int extra = value < 24 ? 0 : value <= 0xFF ? 1 : value <= 0xFFFF ? 2 : value <= 0xFFFFFFFF ? 4 : 8;
    if (capacity < std::size_t(1 + extra)) return 0;
    to[0] = static_cast<unsigned char>(major << 5 | (extra == 0 ? value : 23 + std::bit_width(unsigned(extra))));
    for (int i = 0; i < extra; ++i) to[1 + i] = static_cast<unsigned char>(value >> (8 * (extra - 1 - i)));
    return std::size_t(1 + extra);
}
}  // namespace cbor_heads

inline std::size_t cbor_encode_uint(std::uint64_t value, unsigned char* to, std::size_t capacity) {
    return cbor_heads::write(cbor_heads::kNatural, value, to, capacity);
}
inline std::size_t cbor_encode_negint(std::uint64_t value, unsigned char* to, std::size_t capacity) {
    return cbor_heads::write(cbor_heads::kNegative, value, to, capacity);
}
inline std::size_t cbor_encode_bytestring_start(std::size_t size, unsigned char* to, std::size_t capacity) {
    return cbor_heads::write(cbor_heads::kBytes, size, to, capacity);
}
inline std::size_t cbor_encode_string_start(std::size_t size, unsigned char* to, std::size_t capacity) {
    return cbor_heads::write(cbor_heads::kText, size, to, capacity);
}
inline std::size_t cbor_encode_array_start(std::size_t size, unsigned char* to, std::size_t capacity) {
    return cbor_heads::write(cbor_heads::kList, size, to, capacity);
}
inline std::size_t cbor_encode_map_start(std::size_t size, unsigned char* to, std::size_t capacity) {
    return cbor_heads::write(cbor_heads::kMap, size, to, capacity);
}
inline std::size_t cbor_encode_tag(std::uint64_t value, unsigned char* to, std::size_t capacity) {
    return cbor_heads::write(cbor_heads::kTag, value, to, capacity);
}
inline std::size_t cbor_one_byte(unsigned char byte, unsigned char* to, std::size_t capacity) {
    if (capacity > 0) to[0] = byte;
    return capacity > 0 ? 1 : 0;
}
inline std::size_t cbor_encode_null(unsigned char* to, std::size_t capacity) {
    return cbor_one_byte(0xF6, to, capacity);
}
inline std::size_t cbor_encode_bool(bool value, unsigned char* to, std::size_t capacity) {
    return cbor_one_byte(value ? 0xF5 : 0xF4, to, capacity);
}
inline std::size_t cbor_encode_indef_map_start(unsigned char* to, std::size_t capacity) {
    return cbor_one_byte(0xBF, to, capacity);
}
inline std::size_t cbor_encode_break(unsigned char* to, std::size_t capacity) {
    return cbor_one_byte(0xFF, to, capacity);
}
inline std::size_t cbor_encode_double(double value, unsigned char* to, std::size_t capacity) {
    if (capacity < 9) return 0;
    const auto bits = std::bit_cast<std::uint64_t>(value);
    to[0] = 0xFB;
    for (int i = 0; i < 8; ++i) to[1 + i] = static_cast<unsigned char>(bits >> (56 - 8 * i));
    return 9;
}

inline cbor_decoder_result cbor_stream_decode(cbor_data from, std::size_t size, const cbor_callbacks* to,
                                              void* context) {
    using namespace cbor_heads;
    constexpr int kIndefinite = 31;
    const cbor_decoder_result early{0, CBOR_DECODER_NEDATA}, wrong{0, CBOR_DECODER_ERROR};
    if (size == 0) return early;
    const int major = from[0] >> 5, detail = from[0] & 31;
    const std::size_t extra = detail < 24 ? 0 : detail < 28 ? std::size_t{1} << (detail - 24) : 0;
    if (detail >= 28 && detail != kIndefinite) return wrong;
    if (size < 1 + extra) return early;
    std::uint64_t value = extra == 0 ? std::uint64_t(detail) : 0;
    for (std::size_t i = 0; i < extra; ++i) value = value << 8 | from[1 + i];
    std::size_t read = 1 + extra;
    const bool open = detail == kIndefinite;
    switch (major) {
        case kNatural:
            if (open) return wrong;
            to->uint64(context, value);
            break;
        case kNegative:
            if (open) return wrong;
            to->negint64(context, value);
            break;
        case kBytes:
        case kText:
            if (open) {
                (major == kBytes ? to->byte_string_start : to->string_start)(context);
                break;
            }
            if (size - read < value) return early;
            (major == kBytes ? to->byte_string : to->string)(context, from + read, static_cast<std::size_t>(value));
            read += static_cast<std::size_t>(value);
            break;
        case kList:
            if (open)
                to->indef_array_start(context);
            else
                to->array_start(context, static_cast<std::size_t>(value));
            break;
        case kMap:
            if (open)
                to->indef_map_start(context);
            else
                to->map_start(context, static_cast<std::size_t>(value));
            break;
        case kTag:
            if (open) return wrong;
            to->tag(context, value);
            break;
        default:
            if (detail == 20 || detail == 21)
                to->boolean(context, detail == 21);
            else if (detail == 22)
                to->null(context);
            else if (detail == 23)
                to->undefined(context);
            else if (detail == 26)
                to->float4(context, std::bit_cast<float>(static_cast<std::uint32_t>(value)));
            else if (detail == 27)
                to->float8(context, std::bit_cast<double>(value));
            else if (open)
                to->indef_break(context);
            else
                return wrong;
    }
    return {read, CBOR_DECODER_FINISHED};
}
