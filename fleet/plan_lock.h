// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/descriptor.h"

namespace navcal::fleet {

/// Held by whoever extends a plan or submits its tasks: two of them would do the same work twice. Gone with its
/// process.
class PlanLock {
 public:
  /// Throws analysis::Failure when another process holds it, std::system_error when the file cannot be made.
  explicit PlanLock(const std::filesystem::path& plan);

 private:
  base::Descriptor file_;
};

}  // namespace navcal::fleet
