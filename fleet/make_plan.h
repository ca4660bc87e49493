// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "gap/verdict/request.h"

namespace navcal::fleet {

struct PlanRequest {
  std::filesystem::path recordings;             ///< folder
  std::filesystem::path plan;                   ///< folder; a plan that is there is extended
  std::filesystem::path vehicle;                ///< of all recordings; empty: vehicle.toml near each of them
  std::vector<std::filesystem::path> nominals;  ///< of a layout: its recordings without a gap
  std::filesystem::path config;                 ///< of all recordings; empty: their own
  std::vector<std::string> jobs{"gap"};
  int bank_missions = gap::Request{}.bank_missions;
  std::uint64_t bank_seed = gap::Request{}.bank_seed;
  unsigned threads = 1;
};

struct PlanSummary {
  std::size_t files = 0;       ///< recordings found in the folder
  std::size_t read = 0;        ///< of them, how many were read because they are new or changed
  std::size_t recordings = 0;  ///< of different content, in the plan
  std::size_t tasks = 0, banks = 0;
  std::size_t added = 0;  ///< tasks that the plan had not
  std::size_t gone = 0;   ///< files that an earlier plan had and that are not there any more
  std::vector<std::string> remarks;
};

/// Makes or extends a plan: finds recordings, hashes those that are new, finds out which null bank serves whom,
/// and lists the tasks. Whole or not at all. Throws base::Failure, config::Error, std::system_error.
[[nodiscard]] PlanSummary make_plan(const PlanRequest& request,
                                    const std::function<void(std::string_view what, double done)>& progress);

}  // namespace navcal::fleet
