#pragma once
#include "data_io/values/described.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline data_io {

/// How described.h stores vectors and matrices, and a complex number as a complex vector of one element.
template <class T>
concept Dense = std::derived_from<T, Eigen::PlainObjectBase<T>>;

template <Dense T>
constexpr ArrayForm form_of_array() {
    constexpr bool vector = T::ColsAtCompileTime == 1;
    if constexpr (std::same_as<typename T::Scalar, Complex>)
        return vector ? ArrayForm::kComplexVector : ArrayForm::kComplexMatrix;
    else
        return vector ? ArrayForm::kVector : ArrayForm::kMatrix;
}

template <Dense T>
void write_whole_value(ValueWriter& writer, const T& value) {
    writer.array({form_of_array<T>(), value.rows(), value.cols(), value.data()});
}

template <Dense T>
void read_whole_value(ValueReader& reader, T& value) {
    const NumberArray numbers = reader.array(form_of_array<T>());
    value.resize(numbers.rows, numbers.columns);
    if (numbers.bytes() > 0) std::memcpy(value.data(), numbers.numbers, numbers.bytes());
}

template <std::same_as<Complex> T>
void write_whole_value(ValueWriter& writer, const T& value) {
    writer.array({ArrayForm::kComplexVector, 1, 1, &value});
}

template <std::same_as<Complex> T>
void read_whole_value(ValueReader& reader, T& value) {
    ComplexVector one;
    read_whole_value(reader, one);
    if (one.size() != 1) reader.refuse(Message("expected one complex number"));
    value = one[0];
}

}  // namespace dynlab::inline data_io
