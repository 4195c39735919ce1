#pragma once
#include <vector>

#include "numerics/criteria/output_error_model.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// A column of a regression with a row for each sample k: weight signal(k - late) + constant, the constant alone where
/// k < late.
struct LateColumn {
    VectorView signal;
    Index late = 0;
    double weight = 1, constant = 0;
};

/// The sums of products of prediction errors and of their sensitivities over the samples `first` .. `first` + `rows` -
/// 1, made while the columns are filtered: nothing of the size of the regression is stored, and eight columns are
/// worked on together. With w the `error` before its noise model C/D (monic polynomials in q^-1, of orders nc and nd),
/// the columns of which all products are made are, in this order,
///     D/C of each of `columns`;  e = D/C w;  q^-j e/C, j = 1..nc;  -q^-i w/C, i = 1..nd.
/// The first nd rows are the past of the others and do not count; the recursions begin after them with zeros.
/// Symmetric, columns + 1 + nc + nd.
Matrix prediction_error_products(const std::vector<LateColumn>& columns, const LateColumn& error, Index first,
                                 Index rows, const Vector& C, const Vector& D);

/// The same without a noise model.
Matrix prediction_error_products(const std::vector<LateColumn>& columns, const LateColumn& error, Index first,
                                 Index rows);

/// Adds such products to the sums of a search: `places` holds the parameter of each column, -1 for the one of the
/// errors.
void add_to(OutputErrorProducts& sums, const Matrix& products, const std::vector<Index>& places);

}  // namespace dynlab::inline numerics
