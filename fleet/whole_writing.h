// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

// Files that several processes and machines share. A file has its name only when it is whole and on the disk; of
// two writers the later one replaces the earlier one's. All throw std::system_error, which names the file.
namespace navcal::fleet {

/// A name beside `file` that no other process of any machine uses.
[[nodiscard]] std::filesystem::path part_of(const std::filesystem::path& file);

/// Writes a file under a name of its own, syncs it and renames it. What is left half-way by a signal or a power
/// cut keeps the other name.
void write_whole(const std::filesystem::path& file, std::string_view content);

/// Syncs a file or folder that is complete, and renames it. False: `to` is a folder that is there already, and
/// `from` was removed.
bool rename_whole(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes what processes of this machine left half-way in a folder and ended.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace navcal::fleet
