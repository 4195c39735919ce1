#pragma once
#include <optional>
#include <string>
#include <vector>

#include "data_io/dataset_index.h"

namespace dynlab::inline workflow {

/// Signals of a data file and how their samples lie in time, to be written down in Lua.
class Recording {
  public:
    /// `name`: a .mat or .csv file or a data set. `Ts`: sampling time in seconds instead of what the file says; without
    /// it the file's own, or a column t or time. Throws EnvironmentError for a name that is not a column of numbers
    /// there (listing those there are), signals of different lengths, unknown sampling.
    Recording(const std::string& name, const std::string& input, const std::vector<std::string>& outputs,
              std::optional<double> Ts);

    /// The lines that load the file into `variable`.
    std::string loading(const std::string& variable) const;
    /// The call of iddata for one output of the file that was loaded into `variable`.
    std::string data(const std::string& variable, const std::string& output) const;

  private:
    const Vector& signal(const std::string& name) const;
    std::vector<std::string> signals() const;
    void find_sampling(std::optional<double> given);
    void look_at_instants();
    std::string unit(const char* option, const std::string& column) const;

    std::string name_, input_;
    LoadedData loaded_;
    std::string time_;      ///< the column of instants; empty when Ts is all that is needed
    std::string sampling_;  ///< third argument of iddata, in which {0} stands for the variable
    bool even_ = true;
};

}  // namespace dynlab::inline workflow
