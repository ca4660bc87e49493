// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "base/gravity.h"
#include "sim/layout/assessment/parts.h"
#include "sim/layout/mass_matrix.h"

namespace navcal::sim::assessment {
namespace {

Vector6 eigenvalues_of(const Matrix6& matrix) {
  return Eigen::SelfAdjointEigenSolver<Matrix6>((matrix + matrix.transpose()) / 2, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

void check_inertia(const config::LayoutBody& body, std::vector<Oddity>& odd) {
  const std::string key = "body.inertia_kg_m2";
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia_matrix(body), Eigen::EigenvaluesOnly).eigenvalues();
  if (!(principal[0] > 0))
    odd.push_back({key, fmt::format("a principal moment is {:.4g} kg m2; no body has one that is not positive",
                                    principal[0])});
  // Triangle inequality: no principal moment exceeds the sum of the others.
  constexpr double kRounded = 1.001;
  if (principal[2] > kRounded * (principal[0] + principal[1]))
    odd.push_back({key, fmt::format("the largest principal moment, {:.4g} kg m2, exceeds the sum of the others, "
                                    "{:.4g}: no body has such moments",
                                    principal[2], principal[0] + principal[1])});
  const auto& [length, width, height] = body.size_m;
  if (!(length > 0 && width > 0 && height > 0)) return;
  // All mass at the corners of the box.
  const std::array<double, 3> most{(width * width + height * height) / 4, (length * length + height * height) / 4,
                                   (length * length + width * width) / 4};
  constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const double square = body.inertia_kg_m2[i] / body.mass_kg;
    if (square > most[i])
      odd.push_back({key, fmt::format("the radius of gyration about {} is {:.3g} m; with all mass at the corners "
                                      "of size_m it would be {:.3g} m",
                                      kAxes[i], std::sqrt(square), std::sqrt(most[i]))});
    if (square < 1e-3 * most[i])
      odd.push_back({key, fmt::format("the radius of gyration about {} is {:.3g} m in a body whose corners are "
                                      "{:.3g} m away: a unit off by a thousand?",
                                      kAxes[i], std::sqrt(std::max(square, 0.0)), std::sqrt(most[i]))});
  }
}

void check_floating(const config::Layout& layout, std::vector<Oddity>& odd) {
  double low_N = layout.body.buoyancy_N - layout.weight_N(), high_N = low_N;
  for (const auto& ballast : layout.ballasts) {
    low_N += ballast.low_N;
    high_N += ballast.high_N;
  }
  const double weight = layout.weight_N();
  const double ratio = layout.body.buoyancy_N / weight;
  constexpr double kMuch = 0.05, kUnits = 20;
  if (ratio > kUnits || ratio < 1 / kUnits) {
    odd.push_back({"body.buoyancy_N", fmt::format("buoyancy is {:.3g} times the weight of {:.4g} N: a unit off by "
                                                  "a thousand in mass, volume or buoyancy?",
                                                  ratio, weight)});
  } else if (high_N < -kMuch * weight) {
    odd.push_back({"body.buoyancy_N",
                   fmt::format("it cannot float: net buoyancy is {:.4g} N at most, {:.1f} % of the weight", high_N,
                               100 * high_N / weight)});
  } else if (low_N > kMuch * weight) {
    odd.push_back({"body.buoyancy_N",
                   fmt::format("it cannot sink: net buoyancy is {:.4g} N at least, {:.1f} % of the weight", low_N,
                               100 * low_N / weight)});
  }
}

void check_size(const config::Layout& layout, std::vector<Oddity>& odd) {
  const auto& [length, width, height] = layout.body.size_m;
  if (!(length > 0 && width > 0 && height > 0)) return;
  const double displaced_m3 = layout.body.buoyancy_N / (layout.water_density_kg_m3 * base::kGravity_m_s2);
  const double box_m3 = length * width * height;
  if (displaced_m3 > 1.05 * box_m3)
    odd.push_back({"body.size_m", fmt::format("a box of this size holds {:.4g} m3, but {:.4g} m3 are displaced",
                                              box_m3, displaced_m3)});
  if (displaced_m3 < 0.005 * box_m3)
    odd.push_back(
        {"body.size_m", fmt::format("{:.4g} m3 are displaced in a box of {:.4g} m3: a unit off by a thousand?",
                                    displaced_m3, box_m3)});
  const double reach_m = std::max({length, width, height});
  const auto check_place = [&](std::string_view kind, std::size_t i, const config::LayoutVector& place) {
    const double away_m = vector_of(place).norm();
    if (away_m > reach_m)
      odd.push_back(
          {fmt::format("{}[{}].place_m", kind, i + 1),
           fmt::format("{:.3g} m from the origin of a vehicle whose largest size is {:.3g} m", away_m, reach_m)});
  };
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i)
    check_place("thruster", i, layout.thrusters[i].place_m);
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i) check_place("surface", i, layout.surfaces[i].place_m);
}

void check_added_mass(const config::Layout& layout, std::vector<Oddity>& odd) {
  const Matrix6 added = added_mass(layout);
  const Matrix6 skewed = added - added.transpose();
  const double greatest = added.cwiseAbs().maxCoeff();
  if (skewed.cwiseAbs().maxCoeff() > 1e-6 * greatest)
    odd.push_back({"added_mass.matrix", fmt::format("it is not symmetric: elements differ by up to {:.4g}",
                                                    skewed.cwiseAbs().maxCoeff())});
  const double least = eigenvalues_of(added)[0];
  if (least < -1e-9 * std::max(greatest, 1e-9))
    odd.push_back({"added_mass.matrix", fmt::format("its smallest eigenvalue is {:.4g}: water would drive the "
                                                    "vehicle; the file wants -X_udot, which is positive",
                                                    least)});
  const double heaviest = added.diagonal().head<3>().maxCoeff();
  if (heaviest > 20 * layout.body.mass_kg)
    odd.push_back({"added_mass.matrix",
                   fmt::format("added mass of {:.4g} kg is {:.0f} times the mass: a unit off by a thousand?",
                               heaviest, heaviest / layout.body.mass_kg)});
}

void check_directions(const config::Layout& layout, std::vector<Oddity>& odd) {
  const auto check_unit = [&](std::string key, const config::LayoutVector& direction) {
    const double length = vector_of(direction).norm();
    // Rounded to two digits a unit vector is good to 0.01.
    constexpr double kRounded = 0.02;
    if (std::abs(length - 1) > kRounded)
      odd.push_back(
          {std::move(key), fmt::format("the vector's length is {:.4g}, not 1; its direction is taken", length)});
  };
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i)
    check_unit(fmt::format("thruster[{}].direction", i + 1), layout.thrusters[i].direction);
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i) {
    const config::LayoutSurface& surface = layout.surfaces[i];
    check_unit(fmt::format("surface[{}].normal", i + 1), surface.normal);
    check_unit(fmt::format("surface[{}].chord", i + 1), surface.chord);
    const double cosine = vector_of(surface.normal).normalized().dot(vector_of(surface.chord).normalized());
    if (std::abs(cosine) > 0.02)
      odd.push_back({fmt::format("surface[{}].normal", i + 1),
                     fmt::format("normal and chord are {:.1f} degrees apart, not 90",
                                 std::acos(cosine) * 180 / std::numbers::pi)});
  }
}

}  // namespace

std::string reason_not_to_simulate(const config::Layout& layout) {
  const Matrix6 mass =
      rigid_body_mass(layout, std::vector<double>(layout.moving_masses.size())) + added_mass(layout);
  if (!mass.allFinite()) return "the mass matrix has numbers that are not finite";
  const Vector6 values = eigenvalues_of(mass);
  if (values[0] > 1e-9 * values[5]) return {};
  return fmt::format(
      "the mass matrix, rigid body and water, is not positive definite: its smallest eigenvalue is {:.4g} "
      "(body.mass_kg, body.inertia_kg_m2, added_mass.matrix)",
      values[0]);
}

std::vector<Oddity> oddities_of_file(const config::Layout& layout) {
  std::vector<Oddity> odd;
  check_inertia(layout.body, odd);
  check_floating(layout, odd);
  check_size(layout, odd);
  check_added_mass(layout, odd);
  check_directions(layout, odd);
  return odd;
}

}  // namespace navcal::sim::assessment
