#pragma once
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline data_io {

class ValueReader;
class ValueWriter;
struct Variable;
using VariableTable = std::map<std::string, Variable>;
using VariableList = std::vector<Variable>;

/// What a data file holds under one name. Vectors (1 x n or n x 1) come as columns; 1 x 1 as a number.
struct Variable {
    std::variant<double, bool, std::string, Vector, Matrix, Eigen::VectorXcd, Eigen::MatrixXcd,
                 std::shared_ptr<VariableTable>,  // a struct
                 std::shared_ptr<VariableList>>   // a cell array or an array of structs, column by column
        value;
};

/// As values/described.h stores it.
void write_whole_value(ValueWriter& writer, const Variable& variable);
void read_whole_value(ValueReader& reader, Variable& variable);

}  // namespace dynlab::inline data_io
