// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/diagnose.h>

#include <filesystem>
#include <vector>

#include "gap/verdict/request.h"

namespace navcal::api {

/// A request for a diagnosis by the options of the interface, without its vehicle where that is a layout. Throws
/// Error of the kind bad_argument, and what the readers of its files throw.
[[nodiscard]] gap::Request request_of(const std::vector<std::filesystem::path>& missions,
                                      const DiagnoseOptions& options, bool is_of_layout = false);

}  // namespace navcal::api
