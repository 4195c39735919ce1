#pragma once
#include <type_traits>

#include "data_io/variable.h"

namespace dynlab {

inline bool equal(const VariableTable& a, const VariableTable& b);

inline bool equal(const Variable& a, const Variable& b) {
    if (a.value.index() != b.value.index()) return false;
    return std::visit(
        [&](const auto& left) {
            using Kind = std::decay_t<decltype(left)>;
            const Kind& right = std::get<Kind>(b.value);
            if constexpr (std::is_same_v<Kind, std::shared_ptr<VariableTable>>) {
                return equal(*left, *right);
            } else if constexpr (std::is_same_v<Kind, std::shared_ptr<VariableList>>) {
                return std::equal(left->begin(), left->end(), right->begin(), right->end(),
                                  [](const Variable& x, const Variable& y) { return equal(x, y); });
            } else if constexpr (requires { left.rows(); }) {
                return left.rows() == right.rows() && left.cols() == right.cols() && left == right;
            } else {
                return left == right;
            }
        },
        a.value);
}

inline bool equal(const VariableTable& a, const VariableTable& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& left, const auto& right) {
        return left.first == right.first && equal(left.second, right.second);
    });
}

/// One variable of every kind, nested ones too.
inline VariableTable sample_variables() {
    VariableTable inner;
    inner["gain"] = {2.5};
    inner["names"] = {std::make_shared<VariableList>(VariableList{{std::string("u")}, {std::string("y")}})};
    VariableTable all;
    all["number"] = {-1.0 / 3};
    all["truth"] = {true};
    all["falsehood"] = {false};
    all["text"] = {std::string("Temp\xC3\xA9rature \xE2\x84\xA6 \xF0\x9F\x8E\x93")};
    all["no_text"] = {std::string()};
    all["vector"] = {Vector{{1, 2.5, -3e300}}};
    all["nothing"] = {Vector()};
    all["matrix"] = {Matrix{{1, 2, 3}, {4, 5, 6}}};
    all["complex_vector"] = {Eigen::VectorXcd{{Complex(1, -2), Complex(0, 1)}}};
    all["complex_matrix"] = {Eigen::MatrixXcd{{Complex(1, 2), Complex(3, 4)}, {Complex(5, 6), Complex(7, 8)}}};
    all["structure"] = {std::make_shared<VariableTable>(inner)};
    all["list"] = {std::make_shared<VariableList>(
        VariableList{{7.0}, {std::make_shared<VariableTable>(inner)}, {Vector{{1, 2}}}, {std::string("end")}})};
    all["empty_list"] = {std::make_shared<VariableList>()};
    all["empty_structure"] = {std::make_shared<VariableTable>()};
    return all;
}

}  // namespace dynlab
