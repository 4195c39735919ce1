#pragma once
#include <optional>
#include <string>
#include <vector>

namespace dynlab::inline workflow {

/// A model wanted from a file: one for each output, from all inputs.
struct IdentifyRequest {
    std::string data;                  ///< a data file, or a data set's name
    std::vector<std::string> inputs;   ///< at least one
    std::vector<std::string> outputs;  ///< at least one
    std::optional<int> poles = 2;      ///< from each input; found among structures of up to four when empty
    std::optional<int> zeros = {};     ///< at most the number of poles; 0 when empty, or found with the poles
    std::optional<double> delay = 0;   ///< s; estimated when empty
    std::optional<double> Ts;          ///< s; else as the file states it, or from its column of time
    std::string time = {};             ///< name of that column; the most likely one when empty
    std::string time_unit = {};        ///< of that column, where the file does not say it
    bool moving_input = false;         ///< linear interpolation of the inputs (foh); else zero-order hold
    std::string validation = {};       ///< file with the same names; none when empty

    /// Throws InvalidArgument for names given twice and for orders, delay or Ts that make no sense.
    void validate() const;
};

/// The Lua script that identifies and reports (percent format, template "identify"). `dynlab identify` runs it, and a
/// user may run, change and weave it. The script contains file and variable names as escaped Lua texts, in which no
/// character has a special meaning. The function reads the files to learn their variables and sampling. Throws
/// EnvironmentError for a file that cannot be read, a missing name (listing the existing names), a variable that is not
/// a vector, an unknown sampling time; InvalidArgument as validate() does.
std::string identification_script(const IdentifyRequest& request);

}  // namespace dynlab::inline workflow
