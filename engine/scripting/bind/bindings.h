#pragma once
#include <lua.hpp>

#include "scripting/runtime/function_entry.h"
#include "scripting/runtime/type_entry.h"

namespace dynlab::inline scripting {

/// The functions of each area; catalog_of_functions() (interpreter/catalog.h) joins them in the order of help().
FunctionEntries vector_functions();
FunctionEntries column_statistics();
FunctionEntries element_functions();
FunctionEntries linear_algebra();
FunctionEntries vector_comparisons();
FunctionEntries random_functions();
FunctionEntries signal_functions();
FunctionEntries estimator_functions();
FunctionEntries transfer_estimator_functions();
FunctionEntries noise_model_functions();
FunctionEntries loop_functions();
FunctionEntries recursive_functions();
FunctionEntries discrete_estimator_functions();
FunctionEntries subspace_functions();
FunctionEntries hammerstein_functions();
FunctionEntries idgrey_functions();
FunctionEntries greyest_functions();
FunctionEntries learning_functions();
FunctionEntries nonparametric_functions();
FunctionEntries frequency_functions();
FunctionEntries regression_functions();
FunctionEntries validation_functions();
FunctionEntries residual_functions();
FunctionEntries prediction_functions();
FunctionEntries interval_functions();
FunctionEntries order_functions();
FunctionEntries study_functions();
FunctionEntries model_functions();
FunctionEntries data_functions();
FunctionEntries preprocess_functions();
FunctionEntries advice_functions();
FunctionEntries saving_functions();
FunctionEntries plant_functions();
FunctionEntries simulation_functions();
FunctionEntries noisy_simulation_functions();
FunctionEntries figure_functions();
FunctionEntries control_functions();
FunctionEntries report_functions();
FunctionEntries answer_functions();
FunctionEntries program_functions();
FunctionEntries help_functions();

/// The kinds of objects; catalog_of_types() joins them with those of objects/.
TypeEntries vector_types();
TypeEntries matrix_types();
TypeEntries complex_types();
TypeEntries data_types();
TypeEntries response_types();
TypeEntries model_types();
TypeEntries idgrey_types();
TypeEntries greyest_types();
TypeEntries regression_types();
TypeEntries study_types();
TypeEntries figure_types();

}  // namespace dynlab::inline scripting
