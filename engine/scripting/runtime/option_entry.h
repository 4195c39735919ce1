#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline scripting {

class Options;

/// What an option or an argument takes: how it is checked, completed, typed in stubs and shown as a field.
enum class ValueKind : std::uint8_t {
    kAny,  ///< read by the binding itself
    kNumber,
    kCount,   ///< a whole number from 0 on
    kFlag,    ///< true or false
    kChoice,  ///< one of several texts
    kText,
    kVector,  ///< a vector or a table of numbers
    kTable,   ///< a table {name = value}
    kData,    ///< a data object
    kModel,
    kOrders,   ///< a table of orders {nb, nf, nk}
    kProcess,  ///< the name of a process model, "P2DU"
};

/// Marks a description for xgettext.
constexpr MessageId<> about(MessageId<> description) {
    return description;
}

/// The properties of an option other than its name and description.
struct OptionFacts {
    const char* initial = "";  ///< the default as scripts write it; that of the member, where it is empty
    const char* unit = "";
    double minimum = -std::numeric_limits<double>::infinity(), maximum = std::numeric_limits<double>::infinity();
    std::span<const char* const> choices = {};  ///< of a text, or of an enumeration in its order
    const char* former = "";                    ///< another word for the first choice, which older scripts use
    const char* member = "";                    ///< numerics' name in its messages (OptionName), "max_iterations"
};

/// One option of a function: the only place that names it. Its reading, its errors, the signature, the help page,
/// completion, type stubs, lint and the workbench are made from it.
struct OptionEntry {
    const char* name;  ///< as scripts write it: "MaxIter"
    ValueKind kind;
    MessageId<> description;  ///< a noun phrase, without the default and the choices
    OptionFacts facts = {};
    /// Of an option that is a member of an options struct: sets it, for structs with this tag, and prints its default.
    void (*read)(const Options&, const OptionEntry&, void*) = nullptr;
    std::string (*initial)() = nullptr;
    const void* tag = nullptr;
};

/// The options of a family, or those of a function alone.
using OptionTable = std::span<const OptionEntry>;
/// All options of a function, the families' and its own.
using OptionTables = std::span<const OptionTable>;
inline constexpr OptionTables kNoOptions;

/// One argument of a function that is not an option, for help pages and forms.
struct ArgumentEntry {
    const char* name;  ///< as in the signature
    ValueKind kind;
    MessageId<> description;
};

/// The other accepted name of an option: its earlier name or British spelling, which older scripts use, or the first
/// letter in the other case, because MATLAB's options are a mixture, Lambda and lambda.
std::string other_spelling(std::string name);

/// The default as scripts write it; empty where there is none.
std::string initial_text(const OptionEntry& option);

/// The option with this name or with its other spelling; nullptr if there is none.
const OptionEntry* find_option(OptionTables tables, const std::string& name);
std::vector<std::string> option_names(OptionTables tables);

}  // namespace dynlab::inline scripting
