#include "data_io/variable.h"

#include "data_io/values/array_descriptions.h"
#include "data_io/values/described.h"

namespace dynlab::inline data_io {
namespace {

Variable read_numbers_of(ValueReader& reader) {
    const NumberArray numbers = reader.array({});
    const auto copied = [&numbers](auto values) -> Variable {
        if (numbers.bytes() > 0) std::memcpy(values.data(), numbers.numbers, numbers.bytes());
        return {std::move(values)};
    };
    switch (numbers.form) {
        case ArrayForm::kVector:
            return copied(Vector(numbers.rows));
        case ArrayForm::kMatrix:
            return copied(Matrix(numbers.rows, numbers.columns));
        case ArrayForm::kComplexVector:
            return copied(Eigen::VectorXcd(numbers.rows));
        case ArrayForm::kComplexMatrix:
            break;
    }
    return copied(Eigen::MatrixXcd(numbers.rows, numbers.columns));
}

}  // namespace

void write_whole_value(ValueWriter& writer, const Variable& variable) {
    std::visit(
        [&writer](const auto& content) {
            if constexpr (requires { content->size(); })
                write_value(writer, *content);
            else
                write_value(writer, content);
        },
        variable.value);
}

void read_whole_value(ValueReader& reader, Variable& variable) {
    using Kind = ValueReader::Kind;
    switch (reader.next()) {
        case Kind::kTruth:
            variable = {reader.truth()};
            break;
        case Kind::kText:
            variable = {reader.text()};
            break;
        case Kind::kArray:
            variable = read_numbers_of(reader);
            break;
        case Kind::kMap:
            variable = {std::make_shared<VariableTable>(read_fresh<VariableTable>(reader))};
            break;
        case Kind::kList:
            variable = {std::make_shared<VariableList>(read_fresh<VariableList>(reader))};
            break;
        default:
            variable = {reader.number()};
    }
}

}  // namespace dynlab::inline data_io
