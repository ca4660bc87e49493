// SPDX-License-Identifier: Apache-2.0
#include "fleet/plan_lock.h"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <system_error>

#include "analysis/failure.h"

namespace navcal::fleet {

PlanLock::PlanLock(const std::filesystem::path& plan) {
  const std::filesystem::path path = plan / "lock";
  file_ = base::Descriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (!file_) throw std::system_error(base::last_error(), path.string());
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) == 0) return;
  if (errno != EWOULDBLOCK) throw std::system_error(base::last_error(), path.string());
  throw analysis::Failure(analysis::Exit::failed,
                          plan.string() + ": another navcal fleet plans or submits it at this moment");
}

}  // namespace navcal::fleet
