// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace navcal::cli {

inline constexpr const char* kServiceUser = "navcal";

/// Account under which navcald will run.
struct Account {
  std::string name;
  uid_t uid = 0;
  std::vector<gid_t> groups;
};

/// Account of this process.
[[nodiscard]] Account own_account();
/// Account of the service's user, `navcal`, when root calls and that user exists; else that of this process.
[[nodiscard]] Account service_account();

/// True when the account can read and write files of this owner and mode (root always can).
[[nodiscard]] bool may_read_and_write(const Account& account, uid_t owner, gid_t group, mode_t mode);
/// The same for a file; false when it does not exist.
[[nodiscard]] bool may_read_and_write(const Account& account, const std::filesystem::path& file);
/// The name of the group that owns a file, or its number; empty when the file is not there.
[[nodiscard]] std::string group_of(const std::filesystem::path& file);

}  // namespace navcal::cli
