// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "daemon/control_request.h"

namespace navcal::daemon {

/// The line that answers log.list, log.read or log.sum. Waits for the disk, and may run on any thread.
[[nodiscard]] std::string answer_from_disk(const std::filesystem::path& folder, const ControlRequest& request);

}  // namespace navcal::daemon
