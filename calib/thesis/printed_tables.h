// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

/// Numbers as printed in the tables of the thesis (Mach 2003), for paths 1 to 8.
namespace navcal::calib::thesis {

/// Row of table 3.1 or 3.2. Percentages are 100 (estimate - true) / |true|.
struct PrintedGyro {
  double scale, bias_rad_s;
  double scale_percent, bias_percent;
};
/// Table 3.1: least squares.
inline constexpr std::array<PrintedGyro, 8> kTable3_1{{{1.0897, -0.1017, -1.93, 8.46},
                                                       {1.1165, -0.1119, 0.49, -0.72},
                                                       {1.1163, -0.1118, 0.47, -0.63},
                                                       {1.1183, -0.1121, 0.65, -0.90},
                                                       {1.1518, -0.1149, 3.66, -3.42},
                                                       {1.1404, -0.1139, 2.64, -2.52},
                                                       {1.0733, -0.0729, -3.40, 34.38},
                                                       {1.0880, -0.1060, -2.08, 4.59}}};
/// Table 3.2: adaptive identifier.
inline constexpr std::array<PrintedGyro, 8> kTable3_2{{{-0.3332, 0.4871, -129.99, 538.43},
                                                       {1.0921, -0.1090, -1.71, 1.89},
                                                       {1.0973, -0.1089, -1.24, 1.98},
                                                       {1.1003, -0.1132, -0.97, -1.89},
                                                       {1.1888, -0.1142, 6.99, -2.79},
                                                       {1.1534, -0.1121, 3.81, -0.90},
                                                       {-0.0583, 0.7867, -105.25, 808.10},
                                                       {-0.3777, 0.2193, -133.99, 297.39}}};

/// Row of table 4.1. Percentages are 100 (estimate - true) / true, with the sign of the true value.
struct PrintedCompass {
  std::array<double, 4> deviation_deg;  ///< B, C, D, E
  std::array<double, 4> percent;
  double mean_deg, largest_deg, std_deg;  ///< of the heading error
};
inline constexpr std::array<PrintedCompass, 8> kTable4_1{
    {{{5.1142, -4.3445, 1.9421, 2.2769}, {2.28, -13.11, -2.90, 13.85}, 0.0689, 1.8617, 0.8831},
     {{4.6495, -5.4340, 1.8485, 2.0434}, {-7.01, 8.68, -7.58, 2.17}, -0.0064, 1.0727, 0.5958},
     {{5.8101, -4.9039, 2.0189, 2.1420}, {16.20, -1.92, 0.94, 7.10}, 0.0685, 1.9642, 0.7963},
     {{6.6407, -4.9079, 1.8975, 2.6514}, {32.81, -1.84, -5.13, 32.57}, 0.1270, 3.3002, 1.4047},
     {{6.9860, -2.8462, 0.5875, 5.4550}, {39.72, -43.08, -70.63, 172.75}, 0.3684, 6.9324, 3.6300},
     {{7.7090, -3.4602, 3.7559, 3.7009}, {54.18, -30.80, 87.80, 85.05}, 0.2272, 5.5741, 3.0193},
     {{6.3478, 1.1154, 2.3701, 7.5394}, {26.96, -122.31, 18.51, 276.97}, 0.5424, 12.2204, 6.4064},
     {{5.0407, -4.9553, 2.0288, 1.7872}, {0.81, -0.89, 1.44, -10.64}, 0.0187, 0.8956, 0.4312}}};

/// Row of table 4.2, with the axis limits of the figure's raw and residual heading errors, degrees.
struct PrintedCircle {
  std::string_view figure;
  double shift_x_uT, shift_y_uT;
  double eccentricity, axis_deg;
  bool noise;
  std::array<double, 2> raw_axis_deg;  ///< 0, 0: nothing is on record
  double residual_axis_deg;            ///< plus and minus
};
inline constexpr std::array<PrintedCircle, 5> kTable4_2{{{"4.8", 0, 0, 0, 0, false, {0, 0}, 0.08},
                                                         {"4.9", 2, 2, 0, 0, false, {-10, 10}, 0.08},
                                                         {"4.10", 0, 0, 0.5, 120, false, {-5, 5}, 0.08},
                                                         {"4.11", 2, 2, 0.5, 120, false, {-15, 15}, 0.08},
                                                         {"4.12", 2, -4, 0.8, 10, true, {-40, 30}, 1.5}}};

}  // namespace navcal::calib::thesis
