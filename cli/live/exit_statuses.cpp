// SPDX-License-Identifier: Apache-2.0
#include "cli/live/exit_statuses.h"

#include <stdexcept>

#include "config/error.h"
#include "record/byte_source.h"
#include "record/recording.h"

namespace navcal::cli {
namespace {

template <class... Errors>
bool is_one_of(const std::exception& error) {
  return (... || (dynamic_cast<const Errors*>(&error) != nullptr));
}

}  // namespace

base::Exit exit_status_of(const std::exception& error) {
  if (const auto* const failure = dynamic_cast<const base::Failure*>(&error)) return failure->status();
  const bool is_bad_input = is_one_of<record::BadRecording, config::Error, record::UnreadableFile>(error);
  return is_bad_input ? base::Exit::bad_input : base::Exit::failed;
}

void with_exit_statuses(const std::function<void()>& work, base::Exit of_arguments) {
  try {
    work();
  } catch (const std::invalid_argument& error) {
    throw base::Failure(of_arguments, error.what());
  }
}

}  // namespace navcal::cli
