// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace navcal::cli {

/// Under whose name navcald will run.
struct Account {
  std::string name;
  uid_t uid = 0;
  std::vector<gid_t> groups;
};

/// Of this process.
[[nodiscard]] Account own_account();
/// Of the service's user, `navcal`, for root where there is such a user; else our own.
[[nodiscard]] Account service_account();

/// Whether files of this owner and mode can be read and written by the account (root can always).
[[nodiscard]] bool may_read_and_write(const Account& account, uid_t owner, gid_t group, mode_t mode);
/// The same of a file; false when it is not there.
[[nodiscard]] bool may_read_and_write(const Account& account, const std::filesystem::path& file);
/// The name of the group that owns a file, or its number; empty when the file is not there.
[[nodiscard]] std::string group_of(const std::filesystem::path& file);

}  // namespace navcal::cli
