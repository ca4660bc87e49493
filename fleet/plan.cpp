// SPDX-License-Identifier: Apache-2.0
#include "fleet/plan.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "base/failure.h"
#include "fleet/catalogue.h"
#include "fleet/database.h"
#include "fleet/jobs.h"
#include "protocols/decimal.h"
#include "record/content_hash.h"

namespace navcal::fleet {

PlanLock::PlanLock(const std::filesystem::path& plan) {
  const std::filesystem::path path = plan / "lock";
  file_ = base::Descriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (!file_) throw std::system_error(base::last_error(), path.string());
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) == 0) return;
  if (errno != EWOULDBLOCK) throw std::system_error(base::last_error(), path.string());
  throw base::Failure(base::Exit::failed,
                      plan.string() + ": another navcal fleet plans or submits it at this moment");
}

namespace {

namespace fs = std::filesystem;

int number_in(std::string_view text, std::string_view all) {
  const int number = protocols::integer<int>(text).value_or(0);
  if (number < 1) {
    throw base::Failure(base::Exit::usage, fmt::format("{}: tasks are given as 7, as 3,5,7 or as 10-20", all));
  }
  return number;
}

void add_range(const Plan& plan, int from, int to, std::string_view text, std::vector<const Task*>& found) {
  const auto before = found.size();
  const auto first = std::ranges::lower_bound(plan.tasks, from, {}, &Task::number);
  for (auto at = first; at != plan.tasks.end() && at->number <= to; ++at) found.push_back(&*at);
  if (found.size() == before) {
    throw base::Failure(base::Exit::usage, fmt::format("{}: the plan has no such task (navcal fleet list {})",
                                                       text, plan.folder.string()));
  }
}

}  // namespace

bool Task::makes_bank() const { return job == kBankJob; }

const Task* Plan::task(int number) const {
  const auto at = std::ranges::lower_bound(tasks, number, {}, &Task::number);
  return at != tasks.end() && at->number == number ? &*at : nullptr;
}

const Task* Plan::maker_of(std::string_view bank) const {
  const auto at = std::ranges::find_if(tasks, [&](const Task& t) { return t.makes_bank() && t.bank == bank; });
  return at == tasks.end() ? nullptr : &*at;
}

fs::path Plan::bank_folder(std::string_view bank) const { return folder / "banks" / bank; }

std::string Plan::id() const {
  constexpr std::size_t kDigits = 10;
  return record::sha256_of(folder.string()).substr(0, kDigits);
}

fs::path catalogue_of(const fs::path& plan) { return plan / "plan.sqlite"; }

Plan load_plan(const fs::path& folder) {
  const fs::path file = catalogue_of(folder);
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    throw base::Failure(base::Exit::bad_input,
                        folder.string() + ": no plan of navcal fleet plan (no plan.sqlite)");
  }
  try {
    Database database(file, Database::Access::read);
    Plan plan;
    plan.folder = fs::canonical(folder);
    read_catalogue(database, file.string(), plan);
    return plan;
  } catch (const DatabaseError& error) {
    throw base::Failure(base::Exit::bad_input, error.what());
  }
}

std::vector<const Task*> tasks_named(const Plan& plan, std::string_view text) {
  std::vector<const Task*> found;
  for (std::string_view rest = text;;) {
    const auto comma = rest.find(',');
    const std::string_view part = rest.substr(0, comma);
    const auto dash = part.find('-');
    const int from = number_in(part.substr(0, dash), text);
    const int to = dash == std::string_view::npos ? from : number_in(part.substr(dash + 1), text);
    add_range(plan, from, to, text, found);
    if (comma == std::string_view::npos) return found;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace navcal::fleet
