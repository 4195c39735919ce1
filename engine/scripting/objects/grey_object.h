#pragma once
#include <memory>

#include "numerics/estimators/grey_box/greyest.h"
#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {

/// A grey-box model as idgrey makes it.
template <>
struct Userdata<GreyModel> {
    static constexpr ObjectType type{"grey-box model"};
    static std::size_t outside_bytes(const GreyModel&) { return 4096; }
};

/// An estimated grey-box model as scripts hold it.
using GreyEstimate = std::shared_ptr<const GreyFit>;

template <>
struct Userdata<GreyEstimate> {
    static constexpr ObjectType type{"grey-box estimate"};
    static std::size_t outside_bytes(const GreyEstimate& estimate);
};

/// The estimate at a stack index, or the model there with its starts; nullptr for anything else.
GreyEstimate to_grey_box(const Call& call, int index);

/// All that is known of an estimate, in words.
std::string grey_presentation(const GreyFit& fit, const Reader& reader);

}  // namespace dynlab::inline scripting
