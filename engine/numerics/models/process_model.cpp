#include "numerics/models/process_model.h"

#include <algorithm>
#include <utility>

#include "numerics/error.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

/// The flag of a letter, or nullptr.
bool* flag(ProcessStructure& structure, char letter) {
    switch (letter) {
        case 'D':
            return &structure.delay;
        case 'I':
            return &structure.integrator;
        case 'Z':
            return &structure.zero;
        case 'U':
            return &structure.underdamped;
        default:
            return nullptr;
    }
}

}  // namespace

ProcessStructure ProcessStructure::parse(const std::string& text) {
    if (text.size() < 2 || text[0] != 'P' || text[1] < '1' || text[1] > '3')
        throw InvalidArgument(
            "process model: \"{}\" is not a process model structure. Write P1, P2 or P3, followed by any of D (delay), "
            "I (integrator), Z (zero) and U (underdamped, P2 and P3 only), such as P2DU",
            text);
    ProcessStructure structure;
    structure.poles = text[1] - '0';
    for (const char letter : text.substr(2)) {
        bool* chosen = flag(structure, letter);
        if (chosen == nullptr)
            throw InvalidArgument(
                "process model: \"{}\" has the unknown letter {}. Write P1, P2 or P3, followed by any of D (delay), I "
                "(integrator), Z (zero) and U (underdamped, P2 and P3 only), such as P2DU",
                text, std::string(1, letter));
        if (*chosen)
            throw InvalidArgument(
                "process model: \"{}\" has the letter {} twice. Write P1, P2 or P3, followed by any of D (delay), I "
                "(integrator), Z (zero) and U (underdamped, P2 and P3 only), such as P2DU",
                text, std::string(1, letter));
        *chosen = true;
    }
    if (structure.underdamped && structure.poles < 2)
        throw InvalidArgument(
            "process model: \"{}\" has too few poles for U. Write P1, P2 or P3, followed by any of D (delay), I "
            "(integrator), Z (zero) and U (underdamped, P2 and P3 only), such as P2DU",
            text);
    return structure;
}

std::string ProcessStructure::text() const {
    std::string result = "P";
    result += static_cast<char>('0' + poles);
    if (delay) result += 'D';
    if (integrator) result += 'I';
    if (zero) result += 'Z';
    if (underdamped) result += 'U';
    return result;
}

std::vector<std::string> ProcessStructure::parameter_names() const {
    std::vector<std::string> names = {"Kp"};
    for (int pole = underdamped ? 3 : 1; pole <= poles; ++pole) names.push_back("Tp" + std::to_string(pole));
    if (underdamped) names.insert(names.end(), {"Tw", "Zeta"});
    if (zero) names.emplace_back("Tz");
    if (delay) names.emplace_back("Td");
    return names;
}

ProcessModel::ProcessModel(ProcessStructure structure_, Vector parameters_)
    : structure(structure_), parameters(std::move(parameters_)) {
    const std::vector<std::string> names = structure.parameter_names();
    if (parameters.size() == static_cast<Index>(names.size())) return;
    throw InvalidArgument(
        "process model: {} needs values for the parameters {} ({} values), but the number of values is {}",
        structure.text(), listed(names), names.size(), parameters.size());
}

double ProcessModel::parameter(const std::string& name) const {
    const std::vector<std::string> names = structure.parameter_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw InvalidArgument("process model: {} has no parameter {}", structure.text(), name);
    return parameters(found - names.begin());
}

TransferFunction ProcessModel::transfer_function() const {
    const auto lag = [&](const std::string& name) { return Vector(Eigen::Vector2d(parameter(name), 1)); };
    Vector den = Vector::Ones(1);
    for (int pole = structure.underdamped ? 3 : 1; pole <= structure.poles; ++pole)
        den = multiply(den, lag("Tp" + std::to_string(pole)));
    if (structure.underdamped) {
        const double Tw = parameter("Tw");
        den = multiply(den, Eigen::Vector3d(Tw * Tw, 2 * parameter("Zeta") * Tw, 1));
    }
    if (structure.integrator) den = multiply(den, Eigen::Vector2d(1, 0));
    const Vector num = structure.zero ? lag("Tz") : Vector::Ones(1);
    return TransferFunction(parameter("Kp") * num, den, 0, structure.delay ? parameter("Td") : 0);
}

}  // namespace dynlab::inline numerics
