#include "gap/noise_score.h"

#include <optional>

#include "gap/null_mission.h"
#include "gap/parallel.h"
#include "sim/vehicle/vehicle.h"

namespace navcal::gap {
namespace {

/// Apart from those of the bank's other missions.
constexpr std::uint64_t kSeeds = 800'000;

}  // namespace

Eigen::VectorXd noise_score(const Replay& recorded, const Course10Hz& course,
                            const config::VehicleSettings& vehicle, const Library& library,
                            const Whitening& whitening, const BankOptions& options) {
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
  std::vector<std::optional<Eigen::VectorXd>> scores(static_cast<std::size_t>(options.missions));
  in_parallel(options.threads, scores.size(), [&](std::size_t i) {
    try {
      const Mission mission =
          null_mission(recorded, course, vehicle, sim::EffectSet(), options.seed * 1'000'003 + kSeeds + i);
      scores[i] = linearise(Replay(mission, vehicle), library, whitening, nothing, 1).score;
    } catch (const sim::UnstableVehicle&) {
      // As in the null bank: those that could follow are looked at.
    }
  });
  Eigen::VectorXd sum = nothing;
  int count = 0;
  for (const auto& score : scores) {
    if (!score) continue;
    sum += *score;
    ++count;
  }
  return count > 0 ? Eigen::VectorXd(sum / count) : nothing;
}

}  // namespace navcal::gap
