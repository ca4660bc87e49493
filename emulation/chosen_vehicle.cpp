// SPDX-License-Identifier: Apache-2.0
#include "emulation/chosen_vehicle.h"

#include <fmt/format.h>

#include <cmath>

#include "config/complaints.h"
#include "config/layout/layout_file.h"
#include "config/mission_file.h"
#include "config/vehicle_file.h"
#include "sim/instruments/actuator_outputs.h"
#include "sim/layout/assessment/parts.h"
#include "sim/layout/control/layout_mission_helm.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/pulses.h"

namespace navcal::emulation {
namespace {

/// Why a layout has no equations of motion; empty: it has.
std::string reason_against(const config::Layout& layout) {
  if (!(layout.body.mass_kg > 0)) return fmt::format("its mass is {:g} kg", layout.body.mass_kg);
  if (!(layout.body.buoyancy_N >= 0)) return fmt::format("its buoyancy is {:g} N", layout.body.buoyancy_N);
  return sim::assessment::reason_not_to_simulate(layout);
}

}  // namespace

ChosenVehicle load_chosen_vehicle(const std::filesystem::path& file) {
  if (file.empty()) return config::VehicleSettings{};
  const std::string toml = config::content_of(file);
  if (config::is_layout(toml)) return config::parse_layout(toml, file.native());
  return config::parse_vehicle(toml, file.native());
}

std::optional<config::Layout> layout_in(const std::filesystem::path& file) {
  ChosenVehicle vehicle = load_chosen_vehicle(file);
  auto* const layout = std::get_if<config::Layout>(&vehicle);
  return layout != nullptr ? std::optional(std::move(*layout)) : std::nullopt;
}

std::optional<config::Layout> layout_to_diagnose(const std::filesystem::path& file,
                                                 bool has_nominals_or_is_steady) {
  auto layout = layout_in(file);
  if (!layout && has_nominals_or_is_steady)
    layout = sim::layout_of(std::get<config::VehicleSettings>(load_chosen_vehicle(file)));
  return layout;
}

void expect_simulable(const config::Layout& layout, const std::filesystem::path& file,
                      sim::VehicleInfluencer* effects) {
  const std::string why = reason_against(layout);
  if (!why.empty())
    throw base::Failure(base::Exit::bad_input, fmt::format("{}: cannot be simulated: {}", file.string(), why));
  const std::size_t outputs = sim::outputs_of(layout);
  if (outputs > sim::kMostOutputs)
    throw base::Failure(base::Exit::bad_input, fmt::format("{}: {} actuators; a recording has {} outputs",
                                                           file.string(), outputs, sim::kMostOutputs));
  if (effects == nullptr) return;
  for (double time_s = 0; std::isfinite(time_s); time_s = effects->next_layout_change_s(time_s)) {
    config::Layout changed = layout;
    effects->change_layout(time_s, changed);
    const std::string against = reason_against(changed);
    if (!against.empty())
      throw base::Failure(
          base::Exit::bad_input,
          fmt::format("{}: cannot be simulated with its effects at {:g} s: {}", file.string(), time_s, against));
  }
}

MotionOnMission motion_on_mission(const ChosenVehicle& vehicle, const std::filesystem::path& file,
                                  const std::string& mission, const sim::MotionOptions& options) {
  if (const auto* three_fins = std::get_if<config::VehicleSettings>(&vehicle)) {
    auto helm = std::make_unique<sim::MissionHelm>(*three_fins, config::load_mission(mission));
    return {std::make_unique<sim::SimulatedMotion>(*three_fins, std::move(helm), options), {}};
  }
  const auto& layout = std::get<config::Layout>(vehicle);
  expect_simulable(layout, file, options.influencer);
  try {
    auto helm = std::make_unique<sim::LayoutMissionHelm>(layout, config::load_mission(mission));
    std::string remark = helm->remark();
    return {std::make_unique<sim::SimulatedMotion>(layout, std::move(helm), options), std::move(remark)};
  } catch (const sim::UnfitLayout& error) {
    throw base::Failure(base::Exit::bad_input, fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace navcal::emulation
