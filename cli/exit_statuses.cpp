// SPDX-License-Identifier: Apache-2.0
#include "cli/exit_statuses.h"

#include <stdexcept>
#include <system_error>

#include "config/error.h"
#include "record/recording.h"

namespace navcal::cli {

void with_exit_statuses(const std::function<void()>& work, analysis::Exit of_arguments) {
  try {
    work();
  } catch (const record::BadRecording& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  } catch (const config::Error& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  } catch (const std::invalid_argument& error) {
    throw analysis::Failure(of_arguments, error.what());
  } catch (const std::system_error& error) {
    throw analysis::Failure(analysis::Exit::failed, error.what());
  }
}

}  // namespace navcal::cli
