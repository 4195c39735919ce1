#include <zlib.h>

#include <charconv>
#include <cstdint>
#include <cstring>

#include "data_io/mat_file.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/utf8.h"

// MAT files of a page in a browser: level 5, with or without compression (what MATLAB saves unless it is asked for
// v7.3). Reference: MathWorks, MAT-File Format (R2022b), chapter 1.
namespace dynlab::inline data_io {
namespace {

namespace fs = std::filesystem;
using Bytes = std::string_view;

enum Type : std::uint32_t {
    kInt8 = 1,
    kUint8,
    kInt16,
    kUint16,
    kInt32,
    kUint32,
    kSingle,
    kDouble = 9,
    kInt64 = 12,
    kUint64,
    kMatrix,
    kCompressed,
    kUtf8,
    kUtf16,
    kUtf32
};
enum Class { kCell = 1, kStruct, kObject, kChar, kSparse, kDoubles, kUint8s = 9, kFunction = 16, kOpaque };
constexpr std::uint32_t kComplexFlag = 1 << 11, kLogicalFlag = 1 << 9;
constexpr std::size_t kHeader = 128;
constexpr int kMaxDepth = 50;  // levels of structs and cells

template <class T>
T number_at(Bytes bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

struct Element {
    std::uint32_t type = 0;
    Bytes data;
};

/// What comes of a refusal: one variable is left out.
struct Damaged {};

/// Elements one after the other.
class Elements {
  public:
    explicit Elements(Bytes bytes) : rest_(bytes) {}
    bool ended() const { return rest_.size() < 8; }
    Element next() {
        if (ended()) throw Damaged();
        const auto tag = number_at<std::uint32_t>(rest_, 0);
        if (tag >> 16 != 0) {  // small: type and size in one word
            const Element small{tag & 0xffff, rest_.substr(4, std::min<std::size_t>(tag >> 16, 4))};
            rest_.remove_prefix(8);
            return small;
        }
        const std::size_t size = number_at<std::uint32_t>(rest_, 4);
        if (size > rest_.size() - 8) throw Damaged();
        const Element element{tag, rest_.substr(8, size)};
        const std::size_t padded = tag == kCompressed ? size : (size + 7) / 8 * 8;
        rest_.remove_prefix(std::min(8 + padded, rest_.size()));
        return element;
    }

  private:
    Bytes rest_;
};

std::string inflated(Bytes packed) {
    std::string text;
    z_stream stream = {};
    if (inflateInit(&stream) != Z_OK) throw Damaged();
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    int state = Z_OK;
    while (state == Z_OK) {
        char piece[1 << 15];
        stream.next_out = reinterpret_cast<Bytef*>(piece);
        stream.avail_out = sizeof piece;
        state = inflate(&stream, Z_NO_FLUSH);
        text.append(piece, sizeof piece - stream.avail_out);
    }
    inflateEnd(&stream);
    if (state != Z_STREAM_END) throw Damaged();
    return text;
}

template <class T>
void copy_numbers(Bytes data, double* numbers, std::size_t count) {
    if (data.size() / sizeof(T) < count) throw Damaged();
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<double>(number_at<T>(data, i * sizeof(T)));
}

void copy_numbers(const Element& element, double* numbers, std::size_t count) {
    switch (element.type) {
        case kInt8:
            return copy_numbers<std::int8_t>(element.data, numbers, count);
        case kUint8:
        case kUtf8:
            return copy_numbers<std::uint8_t>(element.data, numbers, count);
        case kInt16:
            return copy_numbers<std::int16_t>(element.data, numbers, count);
        case kUint16:
        case kUtf16:
            return copy_numbers<std::uint16_t>(element.data, numbers, count);
        case kInt32:
            return copy_numbers<std::int32_t>(element.data, numbers, count);
        case kUint32:
        case kUtf32:
            return copy_numbers<std::uint32_t>(element.data, numbers, count);
        case kSingle:
            return copy_numbers<float>(element.data, numbers, count);
        case kDouble:
            return copy_numbers<double>(element.data, numbers, count);
        case kInt64:
            return copy_numbers<std::int64_t>(element.data, numbers, count);
        case kUint64:
            return copy_numbers<std::uint64_t>(element.data, numbers, count);
        default:
            throw Damaged();
    }
}

/// An array as the file has it: flags, size, name, then what its class says.
class Array {
  public:
    Array(Bytes bytes, int depth) : elements_(bytes), depth_(depth) {
        if (depth > kMaxDepth) throw Damaged();
        if (bytes.empty()) return;  // []
        const Element flags = elements_.next(), size = elements_.next(), name = elements_.next();
        if (flags.data.size() < 8) throw Damaged();
        flags_ = number_at<std::uint32_t>(flags.data, 0);
        double sizes[2] = {1, 1};
        const std::size_t rank = size.data.size() / 4;
        for (std::size_t i = 0; i < rank; ++i) {
            const auto length = number_at<std::int32_t>(size.data, 4 * i);
            if (length < 0 || (i > 1 && length != 1)) throw Damaged();
            if (i < 2) sizes[i] = length;
        }
        if (sizes[0] * sizes[1] > 1e9) throw Damaged();
        rows_ = static_cast<std::size_t>(sizes[0]), columns_ = static_cast<std::size_t>(sizes[1]);
        name_ = std::string(name.data);
    }

    const std::string& name() const { return name_; }

    Variable value() {
        const int kind = static_cast<int>(flags_ & 0xff);
        if (kind == 0) return {Vector()};
        if (kind == kChar) return text();
        if (kind == kStruct) return structs();
        if (kind == kCell) return cells();
        if (kind < kDoubles || kind >= kFunction) throw Damaged();
        const Matrix real = numbers();
        const bool is_vector = std::min(rows_, columns_) == 1 || std::max(rows_, columns_) <= 1;
        if (flags_ & kComplexFlag) {
            Eigen::MatrixXcd both = real.cast<Complex>();
            both.imag() = numbers();
            if (is_vector) return {Eigen::VectorXcd(both.reshaped())};
            return {std::move(both)};
        }
        if (real.size() == 1 && (flags_ & kLogicalFlag)) return {real(0) != 0};
        if (real.size() == 1) return {real(0)};
        if (is_vector) return {Vector(real.reshaped())};
        return {real};
    }

  private:
    std::size_t count() const { return rows_ * columns_; }

    Matrix numbers() {
        const Element stored = elements_.next();
        if (count() > stored.data.size()) throw Damaged();
        Matrix matrix(static_cast<Index>(rows_), static_cast<Index>(columns_));
        copy_numbers(stored, matrix.data(), count());
        return matrix;
    }

    Variable text() {
        if (count() == 0) return {std::string()};
        Element stored = elements_.next();
        std::u16string units;
        if (stored.type == kUtf8) {
            units = utf16_of(stored.data);
        } else {
            std::vector<double> numbers(count());
            copy_numbers(stored, numbers.data(), count());
            for (const double unit : numbers) units += static_cast<char16_t>(unit);
        }
        if (units.size() < count()) throw Damaged();
        auto list = std::make_shared<VariableList>();
        for (std::size_t row = 0; row < rows_; ++row) {
            std::u16string line;
            for (std::size_t column = 0; column < columns_; ++column) line += units[row + rows_ * column];
            std::string written = utf8_of(line);
            if (rows_ == 1) return {std::move(written)};
            written.erase(written.find_last_not_of(' ') + 1);
            list->push_back({std::move(written)});
        }
        return {std::move(list)};
    }

    Variable part() {
        const Element element = elements_.next();
        if (element.type != kMatrix) throw Damaged();
        return Array(element.data, depth_ + 1).value();
    }

    Variable cells() {
        auto list = std::make_shared<VariableList>();
        for (std::size_t i = 0; i < count(); ++i) list->push_back(part());
        return {std::move(list)};
    }

    Variable structs() {
        const Element length = elements_.next(), names = elements_.next();
        if (length.data.size() < 4) throw Damaged();
        const auto each = static_cast<std::size_t>(number_at<std::int32_t>(length.data, 0));
        if (each == 0) throw Damaged();
        auto list = std::make_shared<VariableList>();
        for (std::size_t i = 0; i < count(); ++i) {
            auto table = std::make_shared<VariableTable>();
            for (std::size_t at = 0; at + each <= names.data.size(); at += each) {
                const std::string field(names.data.substr(at, each).substr(0, names.data.substr(at, each).find('\0')));
                (*table)[field] = part();
            }
            list->push_back({std::move(table)});
        }
        if (count() == 1) return list->front();
        return {std::move(list)};
    }

    Elements elements_;
    int depth_;
    std::uint32_t flags_ = 0;
    std::size_t rows_ = 0, columns_ = 0;
    std::string name_;
};

void put(std::string& bytes, std::uint32_t type, std::string_view data) {
    const std::uint32_t tag[2] = {type, static_cast<std::uint32_t>(data.size())};
    bytes.append(reinterpret_cast<const char*>(tag), sizeof tag).append(data);
    bytes.append((8 - bytes.size() % 8) % 8, '\0');
}

template <class T>
std::string_view bytes_of(const T& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0])};
}

/// The nearest number with so many significant digits.
double rounded(double value, int digits) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1).ptr;
    *end = '\0';
    return std::strtod(text, nullptr);
}

std::string matrix_of(const Variable& variable, const std::string& name, int digits);

std::string matrix_begin(int kind, std::size_t rows, std::size_t columns, const std::string& name) {
    std::string bytes;
    const std::array<std::uint32_t, 2> flags = {static_cast<std::uint32_t>(kind), 0};
    const std::array<std::int32_t, 2> size = {static_cast<std::int32_t>(rows), static_cast<std::int32_t>(columns)};
    put(bytes, kUint32, bytes_of(flags)), put(bytes, kInt32, bytes_of(size)), put(bytes, kInt8, name);
    return bytes;
}

std::string numbers_matrix(const Matrix& matrix, const std::string& name, int digits) {
    const auto rows = static_cast<std::size_t>(matrix.rows()), columns = static_cast<std::size_t>(matrix.cols());
    std::string bytes = matrix_begin(kDoubles, rows, columns, name);
    std::vector<double> values(matrix.data(), matrix.data() + matrix.size());
    if (digits < 17)
        for (double& value : values) value = rounded(value, digits);
    put(bytes, kDouble, bytes_of(values));
    return bytes;
}

std::string table_matrix(const VariableTable& table, const std::string& name, int digits) {
    constexpr std::size_t kEach = 32;
    std::string bytes = matrix_begin(kStruct, 1, 1, name), names;
    const std::array<std::int32_t, 1> each = {kEach};
    put(bytes, kInt32, bytes_of(each));
    for (const auto& [field, value] : table) names += (field + std::string(kEach, '\0')).substr(0, kEach);
    put(bytes, kInt8, names);
    for (const auto& [field, value] : table) put(bytes, kMatrix, matrix_of(value, "", digits));
    return bytes;
}

std::string matrix_of(const Variable& variable, const std::string& name, int digits) {
    if (const auto* number = std::get_if<double>(&variable.value))
        return numbers_matrix(Matrix::Constant(1, 1, *number), name, digits);
    if (const auto* vector = std::get_if<Vector>(&variable.value)) return numbers_matrix(*vector, name, digits);
    if (const auto* matrix = std::get_if<Matrix>(&variable.value)) return numbers_matrix(*matrix, name, digits);
    if (const auto* table = std::get_if<std::shared_ptr<VariableTable>>(&variable.value))
        return table_matrix(**table, name, digits);
    throw EnvironmentError("{}: in a browser, dynlab can save only numbers and tables of numbers in a MAT file", name);
}

}  // namespace

VariableTable read_mat_file(const fs::path& file, bool, std::vector<Message>* left_out) {
    const std::string bytes = read_file(file);
    if (bytes.size() < kHeader || bytes.compare(124, 4, std::string("\0\1IM", 4)) != 0)
        throw EnvironmentError(
            "{}: in a browser, dynlab can read only MAT files of versions 5 to 7; save the data as CSV", file.string());
    VariableTable variables;
    for (Elements all(Bytes(bytes).substr(kHeader)); !all.ended();) {
        try {
            Element element = all.next();
            std::string plain;
            if (element.type == kCompressed) {
                plain = inflated(element.data);
                element = Elements(plain).next();
            }
            if (element.type != kMatrix) throw Damaged();
            Array array(element.data, 0);
            if (array.name().empty()) continue;
            variables[array.name()] = array.value();
        } catch (const Damaged&) {
            if (left_out != nullptr)
                left_out->push_back(Message("a variable is damaged, or its class is not supported"));
        }
    }
    if (variables.empty()) throw EnvironmentError("{}: the file contains no variable that can be read", file.string());
    return variables;
}

void write_mat_file(const fs::path& file, const VariableTable& variables, int digits) {
    std::string bytes(kHeader, ' ');
    bytes.replace(0, 20, "MATLAB 5.0 MAT-file ");
    bytes.replace(124, 4, std::string("\0\1IM", 4));
    for (const auto& [name, variable] : variables) put(bytes, kMatrix, matrix_of(variable, name, digits));
    write_file_atomically(file, bytes);
}

}  // namespace dynlab::inline data_io
