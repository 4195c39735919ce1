#include "scripting/interpreter/catalog.h"

#include <map>

#include "scripting/bind/bindings.h"
#include "scripting/objects/simulated_model.h"
#include "scripting/objects/traced_value.h"

namespace dynlab::inline scripting {
namespace {

/// Of the options that are members of structs of numerics: by the member.
const std::map<std::string_view, const char*>& names_by_member() {
    static const std::map<std::string_view, const char*> names = [] {
        std::map<std::string_view, const char*> made;
        for (const FunctionEntry& function : catalog_of_functions())
            for (const OptionTable table : function.options)
                for (const OptionEntry& option : table)
                    if (*option.facts.member != '\0') made.emplace(option.facts.member, option.name);
        return made;
    }();
    return names;
}

}  // namespace

const std::vector<FunctionEntry>& catalog_of_functions() {
    static const std::vector<FunctionEntry> catalog = [] {
        std::vector<FunctionEntry> all;
        for (FunctionEntries area : {data_functions(),        preprocess_functions(),
                                     saving_functions(),      plant_functions(),
                                     vector_functions(),      column_statistics(),
                                     element_functions(),     linear_algebra(),
                                     vector_comparisons(),    random_functions(),
                                     signal_functions(),      model_functions(),
                                     simulation_functions(),  noisy_simulation_functions(),
                                     estimator_functions(),   transfer_estimator_functions(),
                                     noise_model_functions(), loop_functions(),
                                     recursive_functions(),   discrete_estimator_functions(),
                                     subspace_functions(),    hammerstein_functions(),
                                     idgrey_functions(),      greyest_functions(),
                                     learning_functions(),    nonparametric_functions(),
                                     frequency_functions(),   advice_functions(),
                                     regression_functions(),  validation_functions(),
                                     residual_functions(),    prediction_functions(),
                                     interval_functions(),    order_functions(),
                                     study_functions(),       figure_functions(),
                                     control_functions(),     report_functions(),
                                     answer_functions(),      program_functions(),
                                     help_functions()})
            all.insert(all.end(), area.begin(), area.end());
        return all;
    }();
    return catalog;
}

const FunctionEntry* find_function(const std::string& name) {
    for (const FunctionEntry& entry : catalog_of_functions())
        if (name == entry.name) return &entry;
    return nullptr;
}

std::string option_name(std::string_view member) {
    const auto found = names_by_member().find(member);
    return found == names_by_member().end() ? "`" + std::string(member) + "`" : found->second;
}

std::vector<std::string> translated_options() {
    std::vector<std::string> members;
    for (const auto& [member, name] : names_by_member()) members.emplace_back(member);
    return members;
}

const std::vector<TypeEntry>& catalog_of_types() {
    static const std::vector<TypeEntry> catalog = [] {
        std::vector<TypeEntry> all;
        for (TypeEntries types : {vector_types(), matrix_types(), complex_types(), data_types(), response_types(),
                                  model_types(), simulated_types(), idgrey_types(), greyest_types(), traced_types(),
                                  regression_types(), study_types(), figure_types()})
            all.insert(all.end(), types.begin(), types.end());
        return all;
    }();
    return catalog;
}

const ShownCalls& shown_calls() {
    static const ShownCalls calls(catalog_of_functions());
    return calls;
}

}  // namespace dynlab::inline scripting
