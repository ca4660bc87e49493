// SPDX-License-Identifier: Apache-2.0
// Errors of navcal identify on simulated recordings against its stated errors, and the agreement of fits of the
// whole, of three minutes and of one minute.
//
// usage: identify_coverage VEHICLE MINUTES CASES [FIRST_SEED]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "identify/fit/estimate.h"
#include "tests/identify/identification_case.h"

namespace {

using namespace navcal::identify;

Estimate fit(const VehicleCase& of, const std::vector<RecordedMotion>& recordings) {
  PredictionErrorProblem problem(of.prior, uncertain_parameters(of.prior), recordings, {});
  return estimate(problem, [](auto, auto) {});
}

double share(const std::vector<double>& values, double within) {
  const auto n = std::count_if(values.begin(), values.end(), [&](double v) { return std::abs(v) <= within; });
  return 100.0 * static_cast<double>(n) / static_cast<double>(values.size());
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return std::fprintf(stderr, "usage: identify_coverage VEHICLE MINUTES CASES [FIRST_SEED]\n"), 2;
  const VehicleCase of = vehicle_case(argv[1]);
  const double seconds = 60 * std::atof(argv[2]);
  const auto first = static_cast<std::uint64_t>(argc > 4 ? std::atol(argv[4]) : 1);
  const auto parameters = uncertain_parameters(of.prior);
  std::vector<double> errors, differences, sums, told;
  std::vector<std::vector<double>> each(parameters.size()), reduced(parameters.size());
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(std::atol(argv[3])); ++seed) {
    const DrawnVehicle drawn = draw_vehicle(of, seed);
    const RecordedMotion whole = draw_recording(of, drawn.layout, seconds, 1000 + seed);
    std::vector<Estimate> fits{fit(of, {whole})};
    for (const double part_s : {180.0, 60.0})
      if (part_s < seconds) fits.push_back(fit(of, {part_of(whole, 0, part_s)}));
    std::printf("seed %lu: %.0f s, %d iterations%s, model error %.2f\n", static_cast<unsigned long>(seed),
                whole.duration_s, fits[0].iterations, fits[0].converged ? "" : " (not settled)",
                fits[0].model_error);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      const double error = (fits[0].unknowns[at] - drawn.truth[at]) / fits[0].stds[at];
      errors.push_back(error);
      each[i].push_back(error);
      reduced[i].push_back(fits[0].stds[at] / parameters[i].prior_std);
      if (reduced[i].back() < 0.5) told.push_back(error);
      for (std::size_t a = 0; a < fits.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          const double apart = fits[a].unknowns[at] - fits[b].unknowns[at];
          differences.push_back(apart / std::hypot(fits[a].stds[at], fits[b].stds[at]));
          sums.push_back(apart / std::max(fits[a].stds[at], fits[b].stds[at]));
        }
      }
    }
    std::printf(
        "  so far: within two %.1f %% of %zu, rms %.3f; agreement within 1.2 joint errors %.1f %%, of the larger "
        "%.1f %%\n",
        share(errors, 2), errors.size(), rms(errors), share(differences, 1.2), share(sums, 1.2));
    std::fflush(stdout);
  }
  for (std::size_t i = 0; i < parameters.size(); ++i)
    std::printf("%-36s std/prior %.3f  error/std rms %.2f\n", parameters[i].name.c_str(), rms(reduced[i]),
                rms(each[i]));
  std::printf("errors within two stated errors: %.1f %% of %zu; rms %.3f\n", share(errors, 2), errors.size(),
              rms(errors));
  if (!told.empty())
    std::printf("of numbers that the recording tells: %.1f %% of %zu; rms %.3f\n", share(told, 2), told.size(),
                rms(told));
  if (!differences.empty())
    std::printf(
        "fits of whole, 3 min, 1 min within 1.2 joint stated errors: %.1f %%; within 1.2 of the larger: %.1f %%\n",
        share(differences, 1.2), share(sums, 1.2));
  return 0;
}
