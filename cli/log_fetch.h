// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "cli/log_link.h"

namespace navcal::cli {

enum class Fetched { whole, was_there };

/// Downloads a finished log into a folder. NAME.part grows there; one that is left of an earlier attempt is
/// continued as far as its bytes are those of the log. It is renamed to NAME once every byte has been compared by
/// checksum. A file of that name is never overwritten. `progress` gets the bytes that are there. Throws
/// analysis::Failure, std::system_error and what LogLink throws; NAME.part then stays.
Fetched fetch_log(LogLink& link, const RemoteLog& log, const std::filesystem::path& folder,
                  const std::function<void(std::uint64_t bytes)>& progress);

}  // namespace navcal::cli
