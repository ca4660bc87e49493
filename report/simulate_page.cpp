// SPDX-License-Identifier: Apache-2.0
#include "report/simulate_page.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/angles.h"
#include "pipeline/readings.h"
#include "report/html_page.h"
#include "report/plot_axes.h"
#include "report/svg_plot.h"
#include "sim/geodesy.h"

namespace navcal::report {
namespace {

/// Curves over the time of a mission; dots are drawn below lines.
class SimulatedPlot {
 public:
  explicit SimulatedPlot(const std::vector<emulation::Timed<sim::State>>& states) : time_(times_of(states)) {}

  /// A value of each element; absent ones are left out.
  template <class Value, class Get>
  SimulatedPlot& dots(SvgPlot::Ink ink, const char* name, const std::vector<emulation::Timed<Value>>& list,
                      Get get) {
    dots_.push_back({ink, name, points_of(list, get)});
    return *this;
  }
  template <class Value, class Get>
  SimulatedPlot& line(SvgPlot::Ink ink, const char* name, const std::vector<emulation::Timed<Value>>& list,
                      Get get) {
    lines_.push_back({ink, name, points_of(list, get)});
    return *this;
  }

  /// Empty without values.
  [[nodiscard]] std::string svg(const char* title, const char* unit) const {
    std::vector<double> values;
    for (const auto* curves : {&dots_, &lines_}) {
      for (const Curve& curve : *curves) {
        for (const Point& point : curve.points) values.push_back(point.y);
      }
    }
    if (values.empty()) return {};
    SvgPlot plot(title, time_.axis(), {unit, whole_range_of(values)});
    for (const Curve& curve : dots_) plot.points(curve.ink, curve.name, curve.points);
    for (const Curve& curve : lines_) plot.line(curve.ink, curve.name, curve.points);
    return plot.svg();
  }

 private:
  struct Curve {
    SvgPlot::Ink ink;
    const char* name;
    std::vector<Point> points;
  };
  static std::vector<double> times_of(const std::vector<emulation::Timed<sim::State>>& states) {
    if (states.empty()) return {};
    return {states.front().time_s, states.back().time_s};
  }
  template <class Value, class Get>
  std::vector<Point> points_of(const std::vector<emulation::Timed<Value>>& list, Get get) const {
    std::vector<Point> points;
    for (const emulation::Timed<Value>& element : list) {
      const std::optional<double> value = get(element.value);
      if (value) points.push_back({time_(element.time_s), *value});
    }
    return points;
  }

  TimeAxis time_;
  std::vector<Curve> dots_, lines_;
};

using Ink = SvgPlot::Ink;
using sim::State;

constexpr std::array kSimulatedInks{Ink::first, Ink::second, Ink::third, Ink::fourth};

std::optional<double> degrees(const std::optional<double>& rad) {
  return rad ? std::optional(*rad * base::kDegreesPerRadian) : std::nullopt;
}

std::optional<double> axis(const std::optional<instruments::Vector3>& vector, std::size_t i) {
  return vector ? std::optional((*vector)[i]) : std::nullopt;
}

std::vector<Point> fixes_of(const emulation::SimulatedSeries& series, const sim::Origin& origin) {
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
Figure track(const emulation::SimulatedSeries& series, const sim::Origin& origin) {
  constexpr double kTrackSide = 460, kLeastLength_m = 2;
  std::vector<Point> way;
  for (const auto& state : series.states) way.push_back({state.value.position_m[1], state.value.position_m[0]});
  Range east = whole_range_of(coordinates(&Point::x, way)), north = whole_range_of(coordinates(&Point::y, way));
  make_equally_long(east, north, kLeastLength_m);
  SvgPlot plot("Track", {"east, m", east}, {"north, m", north}, {kTrackSide, kTrackSide});
  const auto fixes = fixes_of(series, origin);
  plot.points(Ink::before, "GPS", fixes);
  plot.line(Ink::after, "truth", way);
  return {"Track", plot.svg(),
          fixes.empty() ? "True track; the receiver had no fix." : "True track, and the fixes of the receiver."};
}

Figure heading_figure(const emulation::SimulatedSeries& series) {
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

/// Track and motion of the vehicle, with the output of the instruments.
std::vector<Figure> motion_figures(const emulation::SimulatedSeries& series, const sim::Origin& origin) {
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

/// Instrument outputs that are no motion: rates, forces, field, tilt, shaft, current, temperature.
std::vector<Figure> instrument_figures(const emulation::SimulatedSeries& series) {
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

std::string effect_interval_text(const sim::Interval& when) {
  if (!std::isfinite(when.from_s) && !std::isfinite(when.until_s)) return "throughout";
  if (!std::isfinite(when.until_s)) return fmt::format("from {:g} s", when.from_s);
  if (!std::isfinite(when.from_s)) return fmt::format("until {:g} s", when.until_s);
  return fmt::format("{:g} to {:g} s", when.from_s, when.until_s);
}

/// Instruments with a figure; one sentence names the others.
void append_figures(HtmlPage& page, std::vector<Figure> figures) {
  std::string missing;
  for (const Figure& figure : figures) {
    if (figure.html.empty()) missing += (missing.empty() ? "" : ", ") + figure.title;
  }
  std::erase_if(figures, [](const Figure& figure) { return figure.html.empty(); });
  if (!figures.empty()) page.figures(figures);
  if (!missing.empty()) page.paragraph("No readings in the recording: " + missing + ".");
}

void append_effects(HtmlPage& page, const sim::EffectSet& effects) {
  page.section("Effects");
  if (effects.size() == 0 && effects.layout_members().empty()) return page.paragraph("None: the nominal model.");
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](std::string name, const auto& about, const auto& values, const sim::Interval& interval) {
    std::string equation(about.equation), when = effect_interval_text(interval);
    for (std::size_t k = 0; k < values.size(); ++k) {
      rows.push_back(
          {name, std::string(about.parameters[k].name), fmt::format("{:.4g}", values[k]), equation, when});
      for (auto* once : {&name, &equation, &when}) once->clear();
    }
  };
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const auto& about = effects[i].description();
    add(std::string(about.name), about, effects[i].parameters(), effects.interval(i));
  }
  for (const auto& [effect, when] : effects.layout_members()) {
    const std::string of = effect.of.empty() ? "" : " of " + effect.of;
    add(std::string(effect.about->name) + of, *effect.about, effect.values, when);
  }
  page.table({"Effect", "Parameter", "Value", "Equation", "When"}, rows);
}

void append_source(HtmlPage& page, const emulation::SimulateArguments& arguments,
                   const emulation::SimulatedRun& run) {
  const std::string motion = !arguments.path.empty()    ? "path " + arguments.path.string()
                             : !arguments.drive.empty() ? "drive " + arguments.drive.string()
                                                        : "mission " + arguments.mission;
  page.section("Made from");
  page.table({"", ""},
             {{"Motion", motion},
              {"Vehicle", arguments.vehicle.empty() ? "the reference vehicle" : arguments.vehicle.string()},
              {"Place", fmt::format("{:.4f}, {:.4f}", arguments.place.origin.latitude_deg,
                                    arguments.place.origin.longitude_deg)},
              {"Field of the Earth", emulation::field_text(arguments.place.field_world_uT)},
              {"Duration", fmt::format("{:g} s", run.duration_s)},
              {"Seed", std::to_string(arguments.seed)},
              {"Noise", arguments.no_noise ? "none" : "as specified"},
              {"Recording", arguments.capture.string()},
              {"Program", "navcal " NAVCAL_VERSION}});
}

}  // namespace

std::string simulate_page(const emulation::SimulateHistory& history, const emulation::SimulateArguments& arguments,
                          const emulation::SimulatedRun& run, const sim::EffectSet& effects) {
  HtmlPage page("Simulation: " + arguments.capture.filename().string());
  page.section("Motion");
  append_figures(page, motion_figures(history.series(), arguments.place.origin));
  page.section("Instruments");
  append_figures(page, instrument_figures(history.series()));
  append_effects(page, effects);
  append_source(page, arguments, run);
  return std::move(page).finish();
}

}  // namespace navcal::report
