#pragma once
#include "scripting/conversions/object_type.h"

namespace dynlab::inline scripting {

/// What scripts can do with vectors, matrices and masks.
const ObjectType& vector_type();
const ObjectType& matrix_type();
const ObjectType& mask_type();

}  // namespace dynlab::inline scripting
