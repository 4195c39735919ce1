#pragma once
#include <optional>
#include <string>
#include <vector>

#include "data_io/dataset_index.h"
#include "platform/error.h"

namespace dynlab::inline workflow {

/// A file does not state when its samples were taken. The message says so; the possible remedies depend on the caller.
class UnknownSampling : public EnvironmentError {
  public:
    using EnvironmentError::EnvironmentError;
};

/// Signals of a data file and how their samples lie in time, to be written down in Lua.
class Recording {
  public:
    /// `name`: a data file or a data set. Signals are columns or variables by name, also by the header of a table's
    /// file, columns of a matrix: y2 is the second of y, or members of a struct: steps.y, whose time is steps.t. `Ts`:
    /// sampling time in seconds instead of what the file says; without it the column `time` of the unit `time_unit`, or
    /// what find_clock() finds, or the file's own. Throws EnvironmentError for a name that is not a column of numbers
    /// there (listing those there are), signals of different lengths or clocks, the question of find_clock();
    /// UnknownSampling.
    Recording(const std::string& name, const std::vector<std::string>& inputs, const std::vector<std::string>& outputs,
              std::optional<double> Ts, const std::string& time, const std::string& time_unit);

    /// The lines that load the file into `variable`.
    std::string loading(const std::string& variable) const;
    /// The call of iddata for outputs of the file that was loaded into `variable`.
    std::string data(const std::string& variable, const std::vector<std::string>& outputs) const;
    /// A unit instead of the one that the file gives to the signal.
    void set_unit(const std::string& name, const std::string& unit) { loaded_.units[signal(name).name] = unit; }
    void set_inter_sample(bool foh) { inter_sample_ = foh ? "InterSample = \"foh\", " : ""; }

  private:
    /// A signal's numbers, and what Lua reads it by behind the variable of the file: .y:col(2).
    struct Signal {
        Vector numbers;
        std::string access, name;
    };
    Signal signal(const std::string& name) const;
    std::optional<Signal> matrix_column(const std::string& name) const;
    std::optional<Signal> struct_member(const std::string& name) const;
    std::string time_of_struct() const;
    std::vector<std::string> signals() const;
    void find_sampling(std::optional<double> Ts, const std::string& time);
    void take_clock(const std::string& time);
    void take_struct_time(const std::string& time);
    void expect_one_clock(const std::string& time) const;
    std::string filled() const;
    std::string samples(const std::string& variable, const std::string& name) const;
    std::string channels(const std::string& variable, const std::vector<std::string>& names) const;
    std::string units(const char* option, const std::vector<std::string>& names) const;

    std::string name_;
    std::vector<std::string> inputs_, outputs_;
    ImportOptions options_;  ///< of the call of load
    LoadedData loaded_;
    std::string struct_time_;   ///< member that holds the instants; empty when no struct does
    std::string sampling_;      ///< third argument of iddata, in which {0} is replaced by the variable
    std::string instants_;      ///< of uneven sampling, alike; empty when it is even
    std::string inter_sample_;  ///< option of iddata; empty for held inputs
    std::string doubt_;         ///< a line that the script prints
};

}  // namespace dynlab::inline workflow
