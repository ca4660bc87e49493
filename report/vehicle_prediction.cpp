// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/angles.h"
#include "report/vehicle_report.h"

namespace navcal::report {
namespace {

using identify::kPredictors;
using identify::PredictionErrors;
using PredictionJson = nlohmann::ordered_json;

struct Quantity {
  std::string_view name, words, unit;
  PredictionErrors::Row PredictionErrors::*row;
  double per_unit = 1;
};
constexpr std::array<Quantity, 4> kQuantities{
    {{"position_m", "position", "m", &PredictionErrors::position_m},
     {"heading_deg", "heading", "deg", &PredictionErrors::heading_rad, base::kDegreesPerRadian},
     {"depth_m", "depth", "m", &PredictionErrors::depth_m},
     {"velocity_m_s", "velocity", "m/s", &PredictionErrors::velocity_m_s}}};

}  // namespace

std::string vehicle_prediction_text(const identify::Prediction& found) {
  std::string out = "root mean square errors of open-loop predictions from the measured state\n\n";
  out += fmt::format("{:>6} {:>7}  {:<14}", "after", "starts", "");
  for (const auto& name : kPredictors) out += fmt::format(" {:>10}", name);
  out += '\n';
  for (const PredictionErrors& errors : found.errors) {
    if (errors.starts == 0) {
      out += fmt::format("{:>4.0f} s {:>7}  no stretch is that long\n", errors.after_s, 0);
      continue;
    }
    for (const Quantity& quantity : kQuantities) {
      const auto& row = errors.*quantity.row;
      if (!row.front()) continue;
      out += fmt::format("{:>4.0f} s {:>7}  {:<14}", errors.after_s, errors.starts,
                         fmt::format("{}, {}", quantity.words, quantity.unit));
      for (const auto& value : row)
        out += value ? fmt::format(" {:>10.3g}", quantity.per_unit * *value) : fmt::format(" {:>10}", "-");
      out += '\n';
    }
  }
  out += '\n';
  if (!found.by_fixes) out += "Position is not measured: it is the integral of the measured velocity.\n";
  if (!found.errors[0].position_m.back()) out += "For the regressions, --fit names recordings of this vehicle.\n";
  if (found.diverged > 0)
    out += fmt::format("From {} starts the layout's vehicle leaves all bounds; its last state counts.\n",
                       found.diverged);
  if (found.is_steered)
    out +=
        "The vehicle is steered: standing still is not three times worse than holding or the regression. Errors "
        "after 10 and\n60 s judge its controller; those after 1 s judge the layout.\n";
  if (found.worse_than_linear) out += "The layout is worse than the linear regression.\n";
  if (found.worse_than_hold) out += "The layout is worse than holding the velocity.\n";
  return out;
}

std::string vehicle_prediction_json(const identify::Prediction& found) {
  PredictionJson horizons = PredictionJson::array();
  for (const PredictionErrors& errors : found.errors) {
    PredictionJson one{{"s", errors.after_s}, {"starts", errors.starts}};
    for (const Quantity& quantity : kQuantities) {
      PredictionJson& by = one[std::string(quantity.name)];
      for (std::size_t i = 0; i < kPredictors.size(); ++i) {
        const auto& value = (errors.*quantity.row)[i];
        by[std::string(kPredictors[i])] = value ? PredictionJson(quantity.per_unit * *value) : PredictionJson();
      }
    }
    horizons.push_back(std::move(one));
  }
  const PredictionJson all{{"horizons", horizons},
                           {"steered", found.is_steered},
                           {"worse_than_linear", found.worse_than_linear},
                           {"worse_than_hold", found.worse_than_hold},
                           {"diverged", found.diverged},
                           {"position_by_fixes", found.by_fixes}};
  return all.dump() + "\n";
}

}  // namespace navcal::report
