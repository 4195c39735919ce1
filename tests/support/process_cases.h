#pragma once
#include <vector>

#include "numerics/models/process_model.h"

namespace dynlab::test {

/// One process model of every structure with lively values; `unit` stretches its times.
inline std::vector<ProcessModel> every_process(double unit = 1) {
    std::vector<ProcessModel> models;
    for (const char* poles : {"P1", "P2", "P3", "P2U", "P3U"})
        for (const char* extra : {"", "D", "I", "Z", "DI", "DZ", "IZ", "DIZ"}) {
            const ProcessStructure structure = ProcessStructure::parse(std::string(poles) + extra);
            std::vector<double> values;
            for (const std::string& name : structure.parameter_names()) {
                if (name == "Kp") values.push_back(1.3);
                if (name == "Tp1") values.push_back(1.7 * unit);
                if (name == "Tp2") values.push_back(0.7 * unit);
                if (name == "Tp3") values.push_back(0.3 * unit);
                if (name == "Tw") values.push_back(0.5 * unit);
                if (name == "Zeta") values.push_back(0.35);
                if (name == "Tz") values.push_back(-0.45 * unit);
                if (name == "Td") values.push_back(0.373 * unit);
            }
            models.emplace_back(structure, Vector::Map(values.data(), static_cast<Index>(values.size())));
        }
    return models;
}

}  // namespace dynlab::test
