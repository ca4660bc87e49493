// SPDX-License-Identifier: Apache-2.0
#include "report/simulate_figures.h"

#include <array>
#include <cmath>

#include "base/angles.h"
#include "pipeline/nav_reading.h"
#include "report/heading_axis.h"
#include "report/simulate_plot.h"
#include "report/svg_plot.h"
#include "report/time_axis.h"
#include "sim/geodesy.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;
using sim::State;

constexpr std::array kSimulatedInks{Ink::first, Ink::second, Ink::third, Ink::fourth};

std::optional<double> degrees(const std::optional<double>& rad) {
  return rad ? std::optional(*rad * base::kDegreesPerRadian) : std::nullopt;
}

std::optional<double> axis(const std::optional<instruments::Vector3>& vector, std::size_t i) {
  return vector ? std::optional((*vector)[i]) : std::nullopt;
}

std::vector<Point> fixes_of(const analysis::SimulatedSeries& series, const sim::Origin& origin) {
  const auto corner = sim::geodetic(origin, {1000, 1000, 0});
  std::vector<Point> points;
  for (const auto& fix : series.gps) {
    if (!pipeline::has_position(fix.value)) continue;
    const double share_north = (*fix.value.latitude_rad * base::kDegreesPerRadian - origin.latitude_deg) /
                               (corner[0] - origin.latitude_deg);
    const double share_east =
        std::remainder(*fix.value.longitude_rad * base::kDegreesPerRadian - origin.longitude_deg, 360) /
        std::remainder(corner[1] - origin.longitude_deg, 360);
    points.push_back({1000 * share_east, 1000 * share_north});
  }
  return points;
}

/// Both axes have the same scale, a metre north as long as a metre east.
Figure track(const analysis::SimulatedSeries& series, const sim::Origin& origin) {
  constexpr double kTrackSide = 460, kLeastLength_m = 2;
  std::vector<Point> way;
  std::vector<double> easts, norths;
  for (const auto& state : series.states) {
    way.push_back({state.value.position_m[1], state.value.position_m[0]});
    easts.push_back(way.back().x);
    norths.push_back(way.back().y);
  }
  Range east = whole_range_of(easts), north = whole_range_of(norths);
  make_equally_long(east, north, kLeastLength_m);
  SvgPlot plot("Track", {"east, m", east}, {"north, m", north}, {kTrackSide, kTrackSide});
  const auto fixes = fixes_of(series, origin);
  plot.points(Ink::before, "GPS", fixes);
  plot.line(Ink::after, "truth", way);
  return {"Track", plot.svg(),
          fixes.empty() ? "True track; the receiver had no fix." : "True track, and the fixes of the receiver."};
}

Figure heading_figure(const analysis::SimulatedSeries& series) {
  std::vector<double> times_s, headings_deg;
  for (const auto& state : series.states) {
    times_s.push_back(state.time_s);
    headings_deg.push_back(state.value.euler_rad[2] * base::kDegreesPerRadian);
  }
  const TimeAxis time(times_s);
  const HeadingAxis heading(headings_deg);
  std::vector<Point> truth, compass;
  for (std::size_t i = 0; i < times_s.size(); ++i) truth.push_back({time(times_s[i]), heading(headings_deg[i])});
  for (const auto& word : series.compass) {
    if (word.value.heading_rad)
      compass.push_back({time(word.time_s), heading(*word.value.heading_rad * base::kDegreesPerRadian)});
  }
  SvgPlot plot("Heading", time.axis(), heading.axis("heading"));
  plot.points(Ink::before, "compass", compass);
  plot.points(Ink::after, "truth", truth);
  return {"Heading", plot.svg(), "True heading from true north, and the compass's, which is magnetic."};
}

}  // namespace

std::vector<Figure> motion_figures(const analysis::SimulatedSeries& series, const sim::Origin& origin) {
  const auto plot = [&] { return SimulatedPlot(series.states); };
  const auto& states = series.states;
  std::vector<Figure> figures{track(series, origin)};
  figures.push_back(heading_figure(series));
  figures.push_back({"Depth",
                     plot()
                         .dots(Ink::before, "card", series.imu, [](const auto& record) { return record.depth_m; })
                         .line(Ink::after, "truth", states, [](const State& state) { return state.position_m[2]; })
                         .svg("Depth", "m"),
                     "Depth of the origin."});
  figures.push_back({"Speed",
                     plot()
                         .dots(Ink::before, "GPS", series.gps, [](const auto& fix) { return fix.speed_m_s; })
                         .line(Ink::after, "ahead, through the water", states,
                               [](const State& state) { return state.velocity_body_m_s[0]; })
                         .svg("Speed", "m/s"),
                     "The receiver's speed is over ground, and zero while it has no fix."});
  auto fins = plot();
  constexpr std::array<const char*, 3> kFinNames{"1", "2", "3"};
  for (std::size_t i = 0; i < 3; ++i) {
    fins.line(kSimulatedInks[i], kFinNames[i], series.motor,
              [i](const auto& status) { return degrees(status.fins_rad[i]); });
  }
  figures.push_back(
      {"Fins", fins.svg("Fins", "degrees"), "Angles of the servo shafts, as the motor card reports them."});
  return figures;
}

std::vector<Figure> instrument_figures(const analysis::SimulatedSeries& series) {
  const auto plot = [&] { return SimulatedPlot(series.states); };
  constexpr std::array<const char*, 3> kAxes{"forward", "starboard", "down"};
  auto field = plot(), force = plot(), rates = plot(), tilt = plot();
  constexpr std::array<const char*, 3> kGyros{"A-x", "B-y", "A-z"};
  for (std::size_t i = 0; i < 3; ++i) {
    field.line(kSimulatedInks[i], kAxes[i], series.compass,
               [i](const auto& word) { return axis(word.field_body_uT, i); });
    force.line(kSimulatedInks[i], kAxes[i], series.imu,
               [i](const auto& record) { return axis(record.specific_force_m_s2, i); });
    rates.line(kSimulatedInks[i], kGyros[i], series.imu,
               [i](const auto& record) { return degrees(axis(record.rate_rad_s, i)); });
  }
  rates.line(kSimulatedInks[3], "B-z", series.imu,
             [](const auto& record) { return degrees(record.yaw_rate_b_rad_s); });
  tilt.line(kSimulatedInks[0], "roll", series.compass, [](const auto& word) { return degrees(word.roll_rad); })
      .line(kSimulatedInks[1], "pitch", series.compass, [](const auto& word) { return degrees(word.pitch_rad); });
  const auto shaft =
      plot().line(kSimulatedInks[0], "", series.motor, [](const auto& status) { return status.rpm; });
  const auto current =
      plot().line(kSimulatedInks[0], "", series.motor, [](const auto& status) { return status.current_A; });
  const auto warm =
      plot().line(kSimulatedInks[0], "", series.compass, [](const auto& word) { return word.temperature_C; });
  return {
      {"Field", field.svg("Compass: field", "uT"), "In body axes."},
      {"Tilt", tilt.svg("Compass: tilt", "degrees"), "Output of the inclinometer, whose fluid lags."},
      {"Temperature", warm.svg("Compass: temperature", "C"), "Temperature of the electronics."},
      {"Gyros", rates.svg("Inertial card: rates", "degrees a second"), "Including the biases of this power-on."},
      {"Accelerometers", force.svg("Inertial card: specific force", "m/s2"),
       "In body axes; level, \u22129.81 down."},
      {"Shaft", shaft.svg("Motor card: shaft", "rpm"), "As measured."},
      {"Current", current.svg("Motor card: current", "A"), "Current of the propulsion motor."}};
}

}  // namespace navcal::report
