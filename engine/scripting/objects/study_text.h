#pragma once
#include <string>

#include "base/reader.h"
#include "numerics/validation/arx_selection.h"
#include "numerics/validation/monte_carlo.h"
#include "numerics/validation/order_selection.h"

namespace dynlab::inline scripting {

/// Truth, mean, scatter, reported standard errors and Cramer-Rao bound of every method, and in words what is amiss.
std::string monte_carlo_text(const MonteCarlo& study, const Reader& reader);

/// All candidates in a table, the chosen one marked, and why it was chosen.
std::string order_table_text(const OrderSelection& selection, const OrderChoice& choice, const Reader& reader);
std::string arx_table_text(const ArxSelection& selection, const OrderChoice& choice, const Reader& reader);

}  // namespace dynlab::inline scripting
