// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "base/text_rows.h"
#include "calib/thesis/printed_tables.h"
#include "report/thesis_content.h"

namespace navcal::report {

const char* caption_rows();  // thesis_captions.txt
const char* errata_rows();   // thesis_errata.txt

namespace {

/// Least and largest of several numbers.
struct Spread {
  double least = INFINITY, most = -INFINITY;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

ThesisFinding gyro_finding(const analysis::ThesisResults& results) {
  Spread method, ours;
  for (const auto& path : results.gyro) {
    for (const Eigen::Index i : {0, 1}) {
      method.add(path.least_squares_rms[i] / path.bound[i]);
      ours.add(path.navcal_rms[i] / path.bound[i]);
    }
  }
  return {"gyro", fmt::format("With noise, least squares of the thesis errs by {:.1f} to {:.0f} times the bound, "
                              "navcal by {:.2f} to {:.2f} times (tables 3.1, 3.2).",
                              method.least, method.most, ours.least, ours.most)};
}

/// Number of paths on which a time is known.
template <class Get>
long paths_settled(const analysis::ThesisResults& results, Get get) {
  return std::ranges::count_if(results.gyro,
                               [&](const analysis::ThesisGyro& path) { return get(path).has_value(); });
}

ThesisFinding identifier_finding(const analysis::ThesisResults& results) {
  using Gyro = analysis::ThesisGyro;
  return {"identifier",
          fmt::format("The adaptive identifier comes to within 5 % on {} of 8 paths, with noise on {}; navcal's "
                      "recursive filter on {}, with noise on {} (table of convergence).",
                      paths_settled(results, [](const Gyro& path) { return path.adaptive_settled_s; }),
                      paths_settled(results, [](const Gyro& path) { return path.adaptive_noisy_settled_s; }),
                      paths_settled(results, [](const Gyro& path) { return path.navcal_settled_s; }),
                      paths_settled(results, [](const Gyro& path) { return path.navcal_noisy_settled_s; }))};
}

ThesisFinding compass_finding(const analysis::ThesisResults& results) {
  Spread printed, method, ours;
  for (std::size_t i = 0; i < results.compass.size(); ++i) {
    printed.add(calib::thesis::kTable4_1.at(i).largest_deg);
    method.add(results.compass.at(i).least_squares_noisy.largest_deg);
    ours.add(results.compass.at(i).navcal_noisy.largest_deg);
  }
  return {"compass", fmt::format("Largest error of heading: {:.1f} to {:.1f} degrees in table 4.1; with noise "
                                 "{:.1f} to {:.1f} by its method and {:.2f} to {:.2f} by navcal.",
                                 printed.least, printed.most, method.least, method.most, ours.least, ours.most)};
}

ThesisFinding metric_finding(const analysis::ThesisResults& results) {
  const auto& perfect = results.perfect_error;
  return {"metric",
          fmt::format("The metric of table 4.1 has a floor: with the true coefficients it reads mean {:.4f}, "
                      "largest {:.4f}, standard deviation {:.4f} degrees. Paths 2 and 8 are at this floor.",
                      perfect.mean_deg, perfect.largest_deg, perfect.std_deg)};
}

ThesisFinding field_finding(const analysis::ThesisResults& results) {
  Spread method, ours;
  for (const auto& figure : results.field_paths) {
    for (const auto& path : figure) {
      method.add(path.thesis_noisy_deg);
      ours.add(path.navcal_noisy_deg);
    }
  }
  return {"field", fmt::format("On the eight paths the magnetometer method of the thesis errs by {:.1f} to {:.0f} "
                               "degrees, navcal's ellipse by {:.2f} to {:.2f} degrees.",
                               method.least, method.most, ours.least, ours.most)};
}

}  // namespace

std::vector<ThesisFinding> thesis_findings(const analysis::ThesisResults& results) {
  return {gyro_finding(results), identifier_finding(results), compass_finding(results), metric_finding(results),
          field_finding(results)};
}

std::string thesis_caption(const std::string& id) {
  for (const auto& [of, caption] : base::text_rows(caption_rows(), " "))
    if (of == id) return std::string(caption);
  return {};
}

std::vector<std::vector<std::string>> thesis_errata() {
  std::vector<std::vector<std::string>> all;
  for (const auto& [place, text] : base::text_rows(errata_rows(), ": "))
    all.push_back({std::string(place), std::string(text)});
  return all;
}

}  // namespace navcal::report
