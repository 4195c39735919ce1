#pragma once
#include <string>
#include <vector>

#include "base/reader.h"
#include "data_io/values/described.h"

namespace dynlab::inline app {

/// An argument or option as a control shows it.
struct FormField {
    std::string name;
    std::string kind;  ///< "orders" (whole numbers, `parts` names them), "number", "choice", "flag", "process" (letters
                       ///< of a process model), "text" (any expression)
    std::vector<std::string> parts;  ///< of orders: their names; of a choice: what can be chosen, as scripts write it
    std::string initial;             ///< what a new step is given; of an option, what it is without being given
    std::string words;               ///< its description
};
DYNLAB_DESCRIBE(FormField, name, kind, parts, initial, words)

/// The controls of one function that estimates a model from data.
struct EstimatorForm {
    std::string name, summary, structure, noise;
    std::string domain;                ///< "continuous" or "discrete"
    std::vector<FormField> arguments;  ///< behind the data
    std::vector<FormField> options;
};
DYNLAB_DESCRIBE(EstimatorForm, name, summary, structure, noise, domain, arguments, options)

/// All methods of the catalog that estimate a model from data, in the catalog's order, with their texts for the reader.
/// They follow from the catalog of methods and from the table of functions, so that a new method appears automatically.
std::vector<EstimatorForm> estimator_forms(const Reader& reader = {});

}  // namespace dynlab::inline app
