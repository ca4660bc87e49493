// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace navcal::fleet {

/// Who recorded and when: `vehicle_id`, `vehicle_name`, `began_utc_ns` (null: the recording tells no time), and
/// the serial numbers of the devices that measure turn rates (`gyro_serial`) and the field or heading
/// (`compass_serial`). Texts that the recording's configuration does not state are empty. Throws
/// record::BadRecording.
[[nodiscard]] nlohmann::ordered_json recording_identity(const std::filesystem::path& recording);

}  // namespace navcal::fleet
