// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cli/remote_operator.h"

namespace navcal::cli {

/// The vehicle's logs as text, one a line: name and bytes. Throws analysis::Failure with the vehicle's words.
[[nodiscard]] std::string list_files(RemoteOperator& remote);

/// Copies a log. What has come is in `target`.part, from where the next call goes on; the file gets its name when
/// it is whole and its checksum is right. Throws analysis::Failure with the reason.
void get_file(RemoteOperator& remote, const std::string& name, const std::filesystem::path& target);

}  // namespace navcal::cli
