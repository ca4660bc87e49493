// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace navcal::web {

/// A file of the page, which the build put into the program (web/page/embed.cmake).
struct PageFile {
  std::string_view name;
  std::string_view bytes;
};
[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace navcal::web
