// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "analysis/import/import_sink.h"
#include "analysis/import/motor_channels.h"

namespace navcal::analysis {

/// Whether a file begins with a FMT record that describes FMT.
[[nodiscard]] bool is_dataflash(std::string_view head);

/// ArduPilot's DataFlash log (.bin), version of the self-describing records A3 95. Taken are IMU, MAG, BARO, GPS
/// (with the errors of GPA), ATT (with the error of the heading by XKV1), BAT and RCOU; columns, units and
/// multipliers by FMT, FMTU, UNIT and MULT. ArduPilot's body axes are those of navcal: forward, starboard, down.
/// `channels` become shaft and fins. docs/import.md has the table. `undoes_calibration`: takes the autopilot's own
/// calibration off the fields, by the offsets and motor field that each MAG states and by the COMPASS_ parameters
/// of the log.
[[nodiscard]] ImportFindings read_dataflash(std::string_view file, ImportSink& sink, MotorChannels& channels,
                                            bool undoes_calibration = true);

}  // namespace navcal::analysis
