// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "analysis/import/log_readers.h"

namespace navcal::analysis {

/// Readers without a map of outputs.
inline ImportFindings read_dataflash(std::string_view file, ImportSink& sink) {
  MotorChannels none;
  return read_dataflash(file, sink, none);
}
inline ImportFindings read_ulog(std::string_view file, ImportSink& sink) {
  MotorChannels none;
  return read_ulog(file, sink, none);
}
inline ImportFindings read_ros_bag(std::string_view file, ImportSink& sink) {
  MotorChannels none;
  return read_ros_bag(file, sink, none);
}
inline ImportFindings read_mavlink_log(std::string_view file, ImportSink& sink) {
  MotorChannels none;
  return read_mavlink_log(file, sink, none);
}

}  // namespace navcal::analysis
