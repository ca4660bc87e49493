// SPDX-License-Identifier: Apache-2.0
#include "cli/doctor_account.h"

#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

namespace navcal::cli {
namespace {

Account account_of(const passwd& entry) {
  Account account{entry.pw_name, entry.pw_uid, {}};
  int count = 64;
  account.groups.resize(static_cast<std::size_t>(count));
  if (::getgrouplist(entry.pw_name, entry.pw_gid, account.groups.data(), &count) < 0) {
    account.groups.resize(static_cast<std::size_t>(count));
    (void)::getgrouplist(entry.pw_name, entry.pw_gid, account.groups.data(), &count);
  }
  account.groups.resize(static_cast<std::size_t>(std::max(count, 0)));
  return account;
}

}  // namespace

Account own_account() {
  Account account{std::to_string(::geteuid()), ::geteuid(), {}};
  if (const passwd* entry = ::getpwuid(account.uid)) account.name = entry->pw_name;
  account.groups.resize(static_cast<std::size_t>(std::max(::getgroups(0, nullptr), 0)));
  const int count = ::getgroups(static_cast<int>(account.groups.size()), account.groups.data());
  account.groups.resize(static_cast<std::size_t>(std::max(count, 0)));
  account.groups.push_back(::getegid());
  return account;
}

Account service_account() {
  if (::geteuid() == 0) {
    if (const passwd* entry = ::getpwnam(kServiceUser)) return account_of(*entry);
  }
  return own_account();
}

bool may_read_and_write(const Account& account, uid_t owner, gid_t group, mode_t mode) {
  if (account.uid == 0) return true;
  constexpr mode_t kOwner = S_IRUSR | S_IWUSR, kGroup = S_IRGRP | S_IWGRP, kOthers = S_IROTH | S_IWOTH;
  // The first that applies decides, as in the kernel.
  if (account.uid == owner) return (mode & kOwner) == kOwner;
  const bool member = std::find(account.groups.begin(), account.groups.end(), group) != account.groups.end();
  return member ? (mode & kGroup) == kGroup : (mode & kOthers) == kOthers;
}

bool may_read_and_write(const Account& account, const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return false;
  return may_read_and_write(account, status.st_uid, status.st_gid, status.st_mode);
}

std::string group_of(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return {};
  const group* entry = ::getgrgid(status.st_gid);
  return entry != nullptr ? entry->gr_name : std::to_string(status.st_gid);
}

}  // namespace navcal::cli
