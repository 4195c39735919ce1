#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <type_traits>

#include "data_io/mat_variable.h"
#include "data_io/reading_memory.h"
#include "platform/error.h"
#include "platform/utf8.h"

namespace dynlab::inline data_io {
namespace {

constexpr int kMaxDepth = 50;  // levels of structs and cells

/// The number of values that one byte of a file can encode: deflate makes at most 1032 bytes from one.
constexpr double kLargestDeflateRatio = 1032;
/// Of a value: as a number, and as the one that is made from it or goes to the process that asked.
constexpr double kBytesOfValue = 2 * sizeof(double);

void refuse_unsupported(const matvar_t& variable, const std::string& name, int depth) {
    if (depth > kMaxDepth)
        throw EnvironmentError("variable {} has more than {} levels of structures and cell arrays", name, kMaxDepth);
    switch (variable.class_type) {
        case MAT_C_OBJECT:
        case MAT_C_OPAQUE:
            throw EnvironmentError(
                "variable {} is an object, a table or a string array, which dynlab cannot read; save its parts as "
                "plain arrays",
                name);
        case MAT_C_FUNCTION:
            throw EnvironmentError("variable {} is a function handle, which dynlab cannot read", name);
        case MAT_C_EMPTY:  // as a part it is [], on its own a class libmatio does not know
            if (depth == 0)
                throw EnvironmentError("variable {} has an unsupported class; save its parts as plain arrays", name);
            return;
        default:
            return;
    }
}

template <class Unit>
std::u32string widen(const void* data, std::size_t bytes) {
    const Unit* units = static_cast<const Unit*>(data);
    return std::u32string(units, units + bytes / sizeof(Unit));
}

/// Characters, or units of UTF-16 where it stores those.
std::u32string units_of(const matvar_t& variable) {
    if (!variable.data) return {};
    switch (variable.data_type) {
        case MAT_T_UINT16:
        case MAT_T_INT16:
        case MAT_T_UTF16:
            return widen<std::uint16_t>(variable.data, variable.nbytes);
        case MAT_T_UINT32:
        case MAT_T_INT32:
        case MAT_T_UTF32:
            return widen<std::uint32_t>(variable.data, variable.nbytes);
        case MAT_T_UTF8:
            return characters_in({static_cast<const char*>(variable.data), variable.nbytes});
        default:  // one byte for each character, Latin-1
            return widen<std::uint8_t>(variable.data, variable.nbytes);
    }
}

/// Rows of a MATLAB char array (rows x columns, stored column by column) as UTF-8. Throws EnvironmentError when
/// there are fewer characters than the size says.
std::vector<std::string> text_rows(const matvar_t& variable, const std::string& name, std::size_t rows,
                                   std::size_t columns) {
    const std::u32string units = units_of(variable);
    if (units.size() < rows * columns)
        throw EnvironmentError("variable {} is damaged: it has fewer characters than its size indicates", name);
    std::vector<std::string> texts(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        std::u16string text;
        for (std::size_t column = 0; column < columns; ++column) {
            const char32_t unit = units[row + rows * column];
            if (unit < 0x10000)
                text += static_cast<char16_t>(unit);
            else
                text += utf16_of(utf8_of(unit));
        }
        texts[row] = utf8_of(text);
    }
    return texts;
}

/// The parts of a struct (field after field of each element) or cell array that are there.
std::vector<const matvar_t*> parts_of(const matvar_t& variable) {
    const bool has_parts = variable.class_type == MAT_C_STRUCT || variable.class_type == MAT_C_CELL;
    if (!has_parts || !variable.data) return {};
    const auto* parts = static_cast<const matvar_t* const*>(variable.data);
    return {parts, parts + variable.nbytes / sizeof(matvar_t*)};
}

void check_header(const matvar_t& variable, const std::string& name, std::size_t file_bytes, bool links, int depth) {
    refuse_unsupported(variable, name, depth);
    bool is_empty = false;
    double values = 1;  // not an integer, as hostile sizes overflow
    for (int i = 0; variable.dims && i < variable.rank; ++i) {
        is_empty = is_empty || variable.dims[i] == 0;
        values *= static_cast<double>(variable.dims[i]);
    }
    const bool sparse = variable.class_type == MAT_C_SPARSE;  // the file holds few of its values
    if (!is_empty && !links && !sparse && values > kLargestDeflateRatio * static_cast<double>(file_bytes))
        throw EnvironmentError(
            "variable {} is damaged: it declares {} values, more than a file of its size can contain", name,
            significant(values, 6));
    if (!is_empty && kBytesOfValue * values > static_cast<double>(memory_for_reading(file_bytes))) {
        const ReadingMegabytes megabytes = megabytes_for_reading(file_bytes);
        throw EnvironmentError(
            "variable {} has {} values: reading it requires more than {} MB of memory, the limit for a file of {} MB",
            name, significant(values, 6), megabytes.limit, megabytes.of_file);
    }
    for (const matvar_t* part : parts_of(variable)) {
        if (part) check_header(*part, part->name ? name + "." + part->name : name + "{}", file_bytes, links, depth + 1);
    }
}

class Converter {
  public:
    Converter(const matvar_t& variable, const std::string& name, int depth)
        : variable_(variable), name_(name), depth_(depth) {}

    Variable convert() {
        refuse_unsupported(variable_, name_, depth_);
        find_size();
        switch (variable_.class_type) {
            case MAT_C_EMPTY:
                return {Vector()};
            case MAT_C_CHAR:
                return text();
            case MAT_C_STRUCT:
                return structs();
            case MAT_C_CELL:
                return cells();
            case MAT_C_SPARSE:
                return variable_.isComplex ? full<Complex>() : full<double>();
            default:
                return variable_.isComplex ? complex_numbers() : numbers();
        }
    }

  private:
    [[noreturn]] void fail_without_values() const {
        throw EnvironmentError("variable {} is damaged: its values are missing", name_);
    }

    void find_size() {
        if (variable_.class_type == MAT_C_EMPTY) return;
        if (variable_.rank < 1 || !variable_.dims) throw EnvironmentError("variable {} has no size", name_);
        for (int i = 2; i < variable_.rank; ++i) {
            if (variable_.dims[i] != 1) {
                throw EnvironmentError("variable {} has {} dimensions; only vectors and matrices can be read", name_,
                                       variable_.rank);
            }
        }
        rows_ = variable_.dims[0];
        columns_ = variable_.rank > 1 ? variable_.dims[1] : 1;
        constexpr std::size_t kMax = std::numeric_limits<std::int32_t>::max();
        if (rows_ > kMax || columns_ > kMax || (rows_ > 0 && columns_ > kMax / rows_))
            throw EnvironmentError("variable {} is too large", name_);
    }

    std::size_t count() const { return rows_ * columns_; }
    bool is_vector() const { return rows_ == 1 || columns_ == 1 || count() == 0; }

    /// Calls `use` with a typed pointer to the first of count() stored numbers.
    template <class Use>
    void with_numbers(const void* data, Use use) const {
        if (!data) fail_without_values();
        switch (variable_.data_type) {
            case MAT_T_DOUBLE:
                return use(static_cast<const double*>(data));
            case MAT_T_SINGLE:
                return use(static_cast<const float*>(data));
            case MAT_T_INT8:
                return use(static_cast<const std::int8_t*>(data));
            case MAT_T_UINT8:
                return use(static_cast<const std::uint8_t*>(data));
            case MAT_T_INT16:
                return use(static_cast<const std::int16_t*>(data));
            case MAT_T_UINT16:
                return use(static_cast<const std::uint16_t*>(data));
            case MAT_T_INT32:
                return use(static_cast<const std::int32_t*>(data));
            case MAT_T_UINT32:
                return use(static_cast<const std::uint32_t*>(data));
            case MAT_T_INT64:
                return use(static_cast<const std::int64_t*>(data));
            case MAT_T_UINT64:
                return use(static_cast<const std::uint64_t*>(data));
            default:
                throw EnvironmentError("variable {} has an unsupported class", name_);
        }
    }

    Matrix matrix_of(const void* data) const {
        Matrix matrix(static_cast<Index>(rows_), static_cast<Index>(columns_));
        fill(matrix.data(), data);
        return matrix;
    }

    void fill(double* numbers, const void* data) const {
        if (count() == 0) return;
        if (variable_.nbytes / Mat_SizeOf(variable_.data_type) < count()) {
            throw EnvironmentError("variable {} is damaged: it has fewer values than its size indicates", name_);
        }
        with_numbers(data, [&](const auto* stored) {
            for (std::size_t i = 0; i < count(); ++i) numbers[i] = static_cast<double>(stored[i]);
        });
    }

    Variable numbers() const {
        if (is_vector() && count() > 1) {
            Vector vector(static_cast<Index>(count()));
            fill(vector.data(), variable_.data);
            return {std::move(vector)};
        }
        Matrix matrix = matrix_of(variable_.data);
        if (matrix.size() == 1 && variable_.isLogical) return {matrix(0) != 0};
        if (matrix.size() == 1) return {matrix(0)};
        if (is_vector() && !is_empty_matrix()) return {Vector(matrix.reshaped())};
        return {std::move(matrix)};
    }

    Variable complex_numbers() const {
        const auto* parts = static_cast<const mat_complex_split_t*>(variable_.data);
        if (!parts && count() > 0) fail_without_values();
        Eigen::MatrixXcd matrix(static_cast<Index>(rows_), static_cast<Index>(columns_));
        if (count() > 0) {
            matrix.real() = matrix_of(parts->Re);
            matrix.imag() = matrix_of(parts->Im);
        }
        if (is_vector() && !is_empty_matrix()) return {Eigen::VectorXcd(matrix.reshaped())};
        return {std::move(matrix)};
    }

    /// A sparse matrix with all its zeros.
    template <class Scalar>
    Variable full() const {
        using Full = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
        Full matrix = Full::Zero(static_cast<Index>(rows_), static_cast<Index>(columns_));
        const auto* stored = static_cast<const mat_sparse_t*>(variable_.data);
        if (count() > 0 && (!stored || !stored->jc || static_cast<std::size_t>(stored->njc) != columns_ + 1))
            fail_without_values();
        const auto stored_count = count() == 0 ? 0 : static_cast<std::size_t>(stored->jc[columns_]);
        if (stored_count > 0 && (!stored->ir || static_cast<std::size_t>(stored->nir) < stored_count ||
                                 static_cast<std::size_t>(stored->ndata) < stored_count))
            fail_without_values();
        std::size_t column = 0;
        const auto place = [&](std::size_t k, const auto& put) {
            while (column + 1 < columns_ && k >= static_cast<std::size_t>(stored->jc[column + 1])) ++column;
            const auto row = static_cast<std::size_t>(stored->ir[k]);
            if (row >= rows_) fail_without_values();
            put(matrix(static_cast<Index>(row), static_cast<Index>(column)));
        };
        const auto take = [&](const void* data, const auto& put) {
            column = 0;
            with_numbers(data, [&](const auto* numbers) {
                for (std::size_t k = 0; k < stored_count; ++k)
                    place(k, [&](Scalar& value) { put(value, static_cast<double>(numbers[k])); });
            });
        };
        if constexpr (std::is_same_v<Scalar, double>) {
            if (stored_count > 0) take(stored->data, [](double& value, double number) { value = number; });
            if (matrix.size() == 1) return {matrix(0)};
            if (is_vector() && !is_empty_matrix()) return {Vector(matrix.reshaped())};
        } else {
            const auto* parts = stored_count > 0 ? static_cast<const mat_complex_split_t*>(stored->data) : nullptr;
            if (parts) take(parts->Re, [](Complex& value, double number) { value.real(number); });
            if (parts) take(parts->Im, [](Complex& value, double number) { value.imag(number); });
            if (is_vector() && !is_empty_matrix()) return {Eigen::VectorXcd(matrix.reshaped())};
        }
        return {std::move(matrix)};
    }

    /// Empty, but with a size worth keeping, as 0 x 3.
    bool is_empty_matrix() const { return count() == 0 && std::max(rows_, columns_) > 1; }

    Variable text() const {
        if (count() == 0) return {std::string()};
        std::vector<std::string> rows = text_rows(variable_, name_, rows_, columns_);
        if (rows.size() == 1) return {rows.front()};
        auto list = std::make_shared<VariableList>();
        for (std::string& row : rows) {
            row.erase(row.find_last_not_of(' ') + 1);
            list->push_back({std::move(row)});
        }
        return {std::move(list)};
    }

    Variable element(const matvar_t* part, const std::string& part_name) const {
        if (!part) return {Vector()};
        return Converter(*part, part_name, depth_ + 1).convert();
    }

    Variable structs() const {
        const unsigned fields = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&variable_));
        char* const* names = Mat_VarGetStructFieldnames(&variable_);
        check_parts(fields);
        const auto* parts = static_cast<matvar_t* const*>(variable_.data);
        auto list = std::make_shared<VariableList>();
        for (std::size_t i = 0; i < count(); ++i) {
            auto table = std::make_shared<VariableTable>();
            for (std::size_t field = 0; field < fields; ++field) {
                if (!names || !names[field])
                    throw EnvironmentError("variable {} is damaged: a field has no name", name_);
                (*table)[names[field]] = element(parts[i * fields + field], name_ + "." + names[field]);
            }
            list->push_back({std::move(table)});
        }
        if (count() == 1) return list->front();
        return {std::move(list)};
    }

    Variable cells() const {
        check_parts(1);
        const auto* parts = static_cast<matvar_t* const*>(variable_.data);
        auto list = std::make_shared<VariableList>();
        for (std::size_t i = 0; i < count(); ++i) {
            list->push_back(element(parts[i], fmt::format("{}{{{}}}", name_, i + 1)));
        }
        return {std::move(list)};
    }

    /// The pointers to the parts must be there, as many as the size says.
    void check_parts(std::size_t each) const {
        const std::size_t requested = count() * each;
        if (requested == 0) return;
        if (!variable_.data || variable_.nbytes / sizeof(matvar_t*) < requested) {
            throw EnvironmentError("variable {} is damaged: it has fewer parts than its size indicates", name_);
        }
    }

    const matvar_t& variable_;
    const std::string& name_;
    int depth_;
    std::size_t rows_ = 0, columns_ = 0;
};

}  // namespace

void check_mat_header(const matvar_t& variable, const std::string& name, std::size_t file_bytes, bool links) {
    check_header(variable, name, file_bytes, links, 0);
}

Variable from_mat(const matvar_t& variable, const std::string& name) {
    return Converter(variable, name, 0).convert();
}

}  // namespace dynlab::inline data_io
