#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>

#include "data_io/mat_variable.h"
#include "numerics/error.h"
#include "platform/error.h"
#include "platform/utf8.h"

namespace dynlab::inline data_io {
namespace {

constexpr int kAllDigits = 17;  // which no two numbers share

void check_name(const std::string& name) {
    constexpr std::size_t kMaxLength = 63;
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)); };
    const auto is_allowed = [&](char c) {
        return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) || c == '_';
    };
    if (name.empty() || name.size() > kMaxLength || !is_letter(name[0]) || !std::ranges::all_of(name, is_allowed)) {
        throw InvalidArgument(
            "\"{}\" is not a valid MATLAB variable name: begin with a letter, use only letters, digits and _, and "
            "use at most {} characters",
            name, kMaxLength);
    }
}

MatVariable created(matvar_t* variable) {
    if (!variable) throw EnvironmentError("cannot create a MATLAB variable: not enough memory");
    return MatVariable(variable);
}

/// The nearest number with `digits` significant digits.
double rounded_to_digits(double value, int digits) {
    char text[32];
    const auto [end, error] = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1);
    std::from_chars(text, end, value);
    return value;
}

/// Makes the libmatio variable for the alternative it is called with; the numbers of real arrays are copied only where
/// they are rounded.
class ToMat {
  public:
    ToMat(const char* name, int digits) : name_(name), digits_(digits) {}

    MatVariable operator()(double number) const {
        const double kept = digits_ < kAllDigits ? rounded_to_digits(number, digits_) : number;
        return array(MAT_C_DOUBLE, MAT_T_DOUBLE, 1, 1, &kept);
    }
    MatVariable operator()(bool truth) const {
        const std::uint8_t byte = truth;
        return array(MAT_C_UINT8, MAT_T_UINT8, 1, 1, &byte, MAT_F_LOGICAL);
    }
    MatVariable operator()(const std::string& text) const {
        const std::u16string units = utf16_of(text);
        return array(MAT_C_CHAR, MAT_T_UINT16, units.empty() ? 0 : 1, units.size(), units.data());
    }
    MatVariable operator()(const Vector& v) const { return real(v.rows(), v.size() == 0 ? 0 : 1, v.data()); }
    MatVariable operator()(const Matrix& m) const { return real(m.rows(), m.cols(), m.data()); }
    MatVariable operator()(const Eigen::VectorXcd& v) const { return complex(v); }
    MatVariable operator()(const Eigen::MatrixXcd& m) const { return complex(m); }

    MatVariable operator()(const std::shared_ptr<VariableTable>& table) const {
        std::vector<const char*> names;
        std::vector<MatVariable> fields;
        for (const auto& [field, value] : *table) {
            names.push_back(field.c_str());
            fields.push_back(to_mat(value, field, digits_));
        }
        std::size_t size[2] = {1, 1};
        auto variable = created(Mat_VarCreateStruct(name_, 2, size, names.data(), static_cast<unsigned>(names.size())));
        for (std::size_t i = 0; i < fields.size(); ++i) {
            Mat_VarSetStructFieldByIndex(variable.get(), i, 0, fields[i].release());
        }
        return variable;
    }
    MatVariable operator()(const std::shared_ptr<VariableList>& list) const {
        std::vector<MatVariable> parts;
        for (const Variable& part : *list) parts.push_back(std::visit(ToMat(nullptr, digits_), part.value));
        std::vector<matvar_t*> pointers;
        for (const MatVariable& part : parts) pointers.push_back(part.get());
        auto variable = array(MAT_C_CELL, MAT_T_CELL, pointers.size(), pointers.empty() ? 0 : 1, pointers.data());
        for (MatVariable& part : parts) part.release();  // now the cell array's
        return variable;
    }

  private:
    MatVariable array(matio_classes kind, matio_types type, std::size_t rows, std::size_t columns, const void* data,
                      int flags = 0) const {
        std::size_t size[2] = {rows, columns};
        return created(Mat_VarCreate(name_, kind, type, 2, size, const_cast<void*>(data), flags));
    }
    MatVariable real(Index rows, Index columns, const double* data) const {
        const auto height = static_cast<std::size_t>(rows), width = static_cast<std::size_t>(columns);
        if (digits_ >= kAllDigits) return array(MAT_C_DOUBLE, MAT_T_DOUBLE, height, width, data, MAT_F_DONT_COPY_DATA);
        std::vector<double> rounded(data, data + rows * columns);
        for (double& value : rounded) value = rounded_to_digits(value, digits_);
        return array(MAT_C_DOUBLE, MAT_T_DOUBLE, height, width, rounded.data());
    }
    MatVariable complex(const Eigen::MatrixXcd& m) const {
        Matrix re = m.real(), im = m.imag();
        const mat_complex_split_t parts{re.data(), im.data()};
        return array(MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<std::size_t>(m.rows()), static_cast<std::size_t>(m.cols()),
                     &parts, MAT_F_COMPLEX);
    }

    const char* name_;
    int digits_;
};

}  // namespace

MatVariable to_mat(const Variable& variable, const std::string& name, int digits) {
    check_name(name);
    return std::visit(ToMat(name.c_str(), digits), variable.value);
}

}  // namespace dynlab::inline data_io
