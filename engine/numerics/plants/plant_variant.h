#pragma once
#include <cstdint>

#include "numerics/plants/crane.h"
#include "numerics/plants/drifting_process.h"
#include "numerics/plants/drive.h"
#include "numerics/plants/first_order_step.h"
#include "numerics/plants/heat_exchanger.h"
#include "numerics/plants/heat_transfer.h"
#include "numerics/plants/linear_system.h"
#include "numerics/plants/suspension.h"
#include "numerics/plants/thruster.h"
#include "numerics/plants/two_tanks.h"

namespace dynlab::inline numerics {

/// Variants of the course's plants, like several units of the same apparatus in a laboratory. The parameters that a
/// student estimates are multiplied by factors drawn uniformly from 1 - d to 1 + d, with d between 0.08 and 0.25 as set
/// in the source. Each part of the apparatus has one factor, which may affect several parameters. Variant 0 is the
/// plant described in the headers. Equal numbers give equal parameters on every machine.
CraneParameters crane_variant(std::uint32_t number);                       ///< cable, load, friction, trolley, motor
DriftingProcessParameters drifting_process_variant(std::uint32_t number);  ///< gain, time constant, growth of scale
DriveParameters drive_variant(std::uint32_t number);                       ///< motor constant, inertia, inductance
HeatExchangerParameters heat_exchanger_variant(std::uint32_t number);      ///< water, flow, power
HeatTransferParameters heat_transfer_variant(std::uint32_t number);        ///< capacities, power, dead time
LinearSystemParameters linear_system_variant(std::uint32_t number);        ///< gain, zero, poles
FirstOrderStepParameters step_response_variant(std::uint32_t number);      ///< gain, time constant
SuspensionParameters suspension_variant(std::uint32_t number);             ///< mass, spring, damper
ThrusterParameters thruster_variant(std::uint32_t number);                 ///< dead band, delay, propeller, load cell
TwoTanksParameters two_tanks_variant(std::uint32_t number);                ///< areas, outlets, pump, overflow

}  // namespace dynlab::inline numerics
