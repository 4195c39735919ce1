#include "scripting/bind/estimation_readers.h"

namespace dynlab::inline scripting {
namespace {

std::vector<NamedReader> all_readers() {
    std::vector<NamedReader> all;
    for (const EstimationReaders readers :
         {transfer_estimation_readers(), noise_model_readers(), loop_readers(), recursive_readers()})
        all.insert(all.end(), readers.begin(), readers.end());
    return all;
}

}  // namespace

EstimationReader find_estimation_reader(const std::string& method) {
    for (const auto& [name, reader] : all_readers())
        if (method == name) return reader;
    return nullptr;
}

std::vector<std::string> estimation_names() {
    std::vector<std::string> names;
    for (const auto& [name, reader] : all_readers()) names.emplace_back(name);
    return names;
}

}  // namespace dynlab::inline scripting
