#pragma once
#include <span>
#include <string>
#include <vector>

#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// One entry of an order vector and what it means in messages.
struct OrderEntry {
    const char* name;
    const char* meaning;
};

/// The orders {2, 1, 1} of a model, or {2, {1, 2}, {1, 1}} with several inputs: a list for each entry. Throws
/// InvalidArgument that says what the entries mean for another number of them, a value that is not whole, or a negative
/// one.
std::vector<std::vector<int>> order_lists(const Call& call, int index, std::span<const OrderEntry> entries);

/// Throws InvalidArgument: what the entries of the orders at argument `index` mean, and what is wrong with these.
[[noreturn]] void refuse_orders(int index, std::span<const OrderEntry> entries, const std::string& wrong);

}  // namespace dynlab::inline scripting
