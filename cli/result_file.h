#pragma once

#include <filesystem>
#include <string_view>

namespace navcal::cli {

/// Before the work is done rather than after it. Throws Failure when the folder of a file to be written is not
/// there or may not be written to.
void expect_folder_of(const std::filesystem::path& file);

/// Whole or not at all. Throws std::system_error.
void write_result(const std::filesystem::path& file, std::string_view content);

}  // namespace navcal::cli
