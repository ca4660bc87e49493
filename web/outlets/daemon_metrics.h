// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "web/outlets/exposition.h"
#include "web/outlets/members.h"

namespace navcal::web {

/// What messages of the log say, as metrics of navcald (docs/wires.md). Members that are absent or null give no
/// line; objects of another shape give fewer lines, never an error.

/// Each member of the object as a metric of its own.
void append_members(Exposition& out, const nlohmann::json& object, const Members& members);
/// `parts`: the lines of one HEALTH.
void append_health(Exposition& out, const std::vector<nlohmann::json>& parts);
/// `time`: the newest message of /time, null while there was none; HEALTH then tells of the clock.
void append_clock(Exposition& out, const nlohmann::json& time, const std::vector<nlohmann::json>& health_parts);
void append_navigation(Exposition& out, const nlohmann::json& nav);
/// One message of each device.
void append_batteries(Exposition& out, const std::vector<nlohmann::json>& batteries);
/// `parts`: the lines of one CALIB.
void append_calibration(Exposition& out, const std::vector<nlohmann::json>& parts);

}  // namespace navcal::web
