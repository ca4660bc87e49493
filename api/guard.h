// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/error.h>
#include <navcal/progress.h>

#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/failure.h"
#include "config/error.h"
#include "record/byte_source.h"
#include "record/recording.h"

namespace navcal::api {

/// Ends a job from within its progress callback. Not a std::exception, so that no room takes it for an error of
/// its own.
struct Stopped {};

/// The caller's progress callback between the rooms and the caller.
class ProgressRelay {
 public:
  explicit ProgressRelay(const Progress& progress) : progress_(progress) {}

  /// Throws Stopped where the callback returns false or throws.
  void operator()(std::string_view step, double share) {
    if (!progress_) return;
    bool goes_on = false;
    try {
      goes_on = progress_(step, share);
    } catch (...) {
      thrown_ = std::current_exception();
    }
    if (!goes_on) throw Stopped{};
  }
  /// Throws on what the callback threw; else an Error that says that it ended the job.
  [[noreturn]] void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
    throw Error(ErrorKind::cancelled, "cancelled by the progress callback");
  }

 private:
  const Progress& progress_;
  std::exception_ptr thrown_;
};

[[nodiscard]] inline ErrorKind kind_of(const base::Failure& failure) {
  switch (failure.status()) {
    case base::Exit::usage: return ErrorKind::bad_argument;
    case base::Exit::bad_input: return ErrorKind::bad_input;
    case base::Exit::success:
    case base::Exit::failed: break;
  }
  return ErrorKind::failed;
}

/// Result of job(). Exceptions of the rooms become Error; std::bad_alloc and Stopped pass.
template <class Job>
auto guarded(Job&& job) -> decltype(job()) {
  try {
    return std::forward<Job>(job)();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const record::BadRecording& error) {
    throw Error(ErrorKind::bad_input, error.what());
  } catch (const config::Error& error) {
    throw Error(ErrorKind::bad_input, error.what());
  } catch (const record::UnreadableFile& error) {
    throw Error(ErrorKind::bad_input, error.what());
  } catch (const base::Failure& error) {
    throw Error(kind_of(error), error.what());
  } catch (const std::invalid_argument& error) {
    throw Error(ErrorKind::bad_argument, error.what());
  } catch (const std::exception& error) {
    throw Error(ErrorKind::failed, error.what());
  }
}

/// Result of job(relay), which tells the relay how far it is.
template <class Job>
auto guarded_with_progress(const Progress& progress, Job&& job) {
  ProgressRelay relay(progress);
  try {
    return guarded([&] { return std::forward<Job>(job)(relay); });
  } catch (const Stopped&) {
    relay.rethrow();
  }
}

}  // namespace navcal::api
