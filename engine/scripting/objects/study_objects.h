#pragma once
#include "numerics/validation/arx_selection.h"
#include "numerics/validation/monte_carlo.h"
#include "numerics/validation/order_selection.h"
#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {

/// What srivcstruc gives: all candidates and the recommended one.
struct OrderTable {
    OrderSelection selection;
    OrderChoice choice;
};

template <>
struct Userdata<OrderTable> {
    static constexpr ObjectType type{"table of orders"};
    static std::size_t outside_bytes(const OrderTable& table);
};

/// What arxstruc gives.
template <>
struct Userdata<ArxSelection> {
    static constexpr ObjectType type{"table of ARX orders"};
    static std::size_t outside_bytes(const ArxSelection& table);
};

template <>
struct Userdata<MonteCarlo> {
    static constexpr ObjectType type{"Monte Carlo study"};
    static std::size_t outside_bytes(const MonteCarlo& study);
};

}  // namespace dynlab::inline scripting
