// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/ros_bag.h"
#include "tests/fuzz/import_sink.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  static_cast<void>(navcal::analysis::is_ros_bag(file));
  navcal::fuzz::CheckingSink sink;
  navcal::fuzz::require_within(navcal::analysis::read_ros_bag(file, sink), size);
  return 0;
}
