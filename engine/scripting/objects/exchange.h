#pragma once
#include "data_io/variable.h"
#include "numerics/signals/iddata.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {

/// Models and data as structs, for MAT and JSON files that other programs read.

/// A model with one channel has `kind` ("tf", or "idpoly" if it has separate polynomials), `num` and `den` (rows,
/// highest power first), `Ts` and `IODelay` (s), and, as idpoly of MATLAB takes them, the rows `A`, `B`, `C`, `D`, `F`:
/// with Ts = 0 in descending powers of s, else in ascending powers of q^-1, with the delay as leading zeros of B; then
/// `NoiseVariance`, `param`, `std`, `covariance` and `names` of an estimate. A model with several channels has
/// `inputs`, `outputs` and the list `channels` of such structs, output by output.
VariableTable struct_of(const Model& model);
VariableTable struct_of(const StateSpace& system);  ///< kind "ss", A, B, C, D, Ts
/// `y`, `u` (a column a signal), `t` (s), `Ts`, `InputName`, `OutputName`, units; of several experiments the list
/// `experiments` of such structs.
VariableTable struct_of(const IdData& data);

}  // namespace dynlab::inline scripting
