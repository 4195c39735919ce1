#pragma once
#include <map>
#include <optional>
#include <string>
#include <type_traits>

#include "base/reader.h"
#include "scripting/conversions/arguments.h"
#include "scripting/runtime/option_entry.h"

namespace dynlab::inline scripting {

template <class T>
struct MemberOf;
template <class Struct, class Value>
struct MemberOf<Value Struct::*> {
    using Owner = Struct;
    using Type = Value;
};

template <class Value>
constexpr ValueKind kind_of_member() {
    if constexpr (std::is_same_v<Value, bool> || std::is_same_v<Value, std::optional<bool>>)
        return ValueKind::kFlag;
    else if constexpr (std::is_integral_v<Value> || std::is_same_v<Value, std::optional<Index>>)
        return ValueKind::kCount;
    else if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>)
        return ValueKind::kNumber;
    else if constexpr (std::is_enum_v<Value>)
        return ValueKind::kChoice;
    else if constexpr (std::is_same_v<Value, std::string>)
        return ValueKind::kText;
    else if constexpr (std::is_same_v<Value, Vector>)
        return ValueKind::kVector;
    else
        return ValueKind::kTable;
}

/// Sets the member from the option, which is given.
template <auto kMember>
void read_member(const Options& options, const OptionEntry& entry, void* owner) {
    using Value = typename MemberOf<decltype(kMember)>::Type;
    Value& value = static_cast<typename MemberOf<decltype(kMember)>::Owner*>(owner)->*kMember;
    constexpr ValueKind kind = kind_of_member<Value>();
    if constexpr (kind == ValueKind::kFlag)
        value = options.flag(entry.name, false);
    else if constexpr (std::is_same_v<Value, Index> || std::is_same_v<Value, std::optional<Index>>)
        value = options.size(entry.name, 0);
    else if constexpr (kind == ValueKind::kCount)
        value = static_cast<Value>(options.whole(entry.name, 0));
    else if constexpr (kind == ValueKind::kNumber)
        value = options.number(entry.name, 0);
    else if constexpr (kind == ValueKind::kChoice)
        value = static_cast<Value>(options.choice(entry));
    else if constexpr (kind == ValueKind::kText)
        value = options.text(entry.name, "");
    else if constexpr (kind == ValueKind::kVector)
        value = options.vector(entry.name);
    else
        value = options.numbers_by_name(entry.name);
}

/// What the member is in a new struct, as a script writes it; empty for what has no value.
template <auto kMember>
std::string initial_of_member() {
    using Value = typename MemberOf<decltype(kMember)>::Type;
    const Value value = typename MemberOf<decltype(kMember)>::Owner{}.*kMember;
    if constexpr (std::is_same_v<Value, bool>)
        return value ? "true" : "false";
    else if constexpr (std::is_integral_v<Value>)
        return std::to_string(value);
    else if constexpr (std::is_same_v<Value, double>)
        return number_text(significant(value, 5));
    else
        return "";
}

/// The row of an option that is a member of an options struct: `option<&FitOptions::tolerance>("Tol", about("..."),
/// {.minimum = 0})`. Specify the default of a choice.
template <auto kMember>
constexpr OptionEntry option(const char* name, MessageId<> description, const OptionFacts& facts = {}) {
    using Of = MemberOf<decltype(kMember)>;
    return {name,
            kind_of_member<typename Of::Type>(),
            description,
            facts,
            read_member<kMember>,
            initial_of_member<kMember>,
            &options_tag<typename Of::Owner>};
}

}  // namespace dynlab::inline scripting
