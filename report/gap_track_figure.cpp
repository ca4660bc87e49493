// SPDX-License-Identifier: Apache-2.0
// Track of the vehicle, and track of the model.
#include <vector>

#include "report/gap_figures.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;

std::vector<Point> points_of(const gap::Track& track) {
  constexpr std::size_t kMost = 1500;
  std::vector<Point> points;
  for (std::size_t i = 0; i < track.time_s.size(); i += track.time_s.size() / kMost + 1)
    points.push_back({track.east_m[i], track.north_m[i]});
  return points;
}

}  // namespace

/// Both axes have the same scale, a metre north as long as a metre east.
std::optional<Figure> track_figure(const gap::Diagnosis& diagnosis) {
  if (!diagnosis.tracks || diagnosis.tracks->fixes.time_s.empty()) return std::nullopt;
  const gap::Tracks& tracks = *diagnosis.tracks;
  constexpr double kTrackSide = 460, kLeastLength_m = 2;
  std::vector<double> easts, norths;
  for (const gap::Track* track : {&tracks.fixes, &tracks.nominal, &tracks.improved}) {
    easts.insert(easts.end(), track->east_m.begin(), track->east_m.end());
    norths.insert(norths.end(), track->north_m.begin(), track->north_m.end());
  }
  Range east = whole_range_of(easts), north = whole_range_of(norths);
  make_equally_long(east, north, kLeastLength_m);
  constexpr double kHeight = kTrackSide - SvgPlot::kLeft - SvgPlot::kRight + SvgPlot::kTop + SvgPlot::kBottom;
  SvgPlot plot("Track", {"east, m", east}, {"north, m", north}, {kTrackSide, kHeight});
  plot.points(Ink::fit, "fixes", points_of(tracks.fixes));
  plot.line(Ink::before, "nominal model", points_of(tracks.nominal));
  const char* const after = diagnosis.effects.empty() ? "with the best candidates" : "with the effects found";
  if (!tracks.improved.time_s.empty()) plot.line(Ink::after, after, points_of(tracks.improved));
  return Figure{"Track", plot.svg(),
                "The fixes, and the path of the model from the first fix on, by the recorded shaft and the "
                "model's own compass and gyros, without any further fix. A current moves the fixes only."};
}

}  // namespace navcal::report
