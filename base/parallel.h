// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace navcal::base {

/// Threads that run at once on this machine, at least one. `wanted`: so many instead, unless it is 0.
[[nodiscard]] inline unsigned threads_or_cores(unsigned wanted = 0) {
  return wanted > 0 ? wanted : std::max(1U, std::thread::hardware_concurrency());
}

/// job(i) for i = 0 ... count - 1, on so many threads. The first exception ends it and is thrown on.
template <class Job>
void in_parallel(unsigned threads, std::size_t count, Job job) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr error;
  std::mutex error_mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        job(i);
      } catch (...) {
        const std::lock_guard lock(error_mutex);
        if (!error) error = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned t = 1; t < threads; ++t) others.emplace_back(work);
    work();
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace navcal::base
