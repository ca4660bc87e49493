// SPDX-License-Identifier: Apache-2.0
#include "bench/calibration/tables.h"

#include <array>

#include "bench/calibration/gps_delay_tables.h"
#include "bench/calibration/magnetometer.h"
#include "bench/calibration/missions.h"
#include "bench/calibration/turn_tables.h"

namespace navcal::bench {

std::span<const Table> tables() {
  static constexpr std::array kTables{
      Table{"gyro", "Gyro against an errorless compass (THESIS 11.1)", print_gyro},
      Table{"compass", "Compass with a calibrated gyro (THESIS 11.2)", print_compass},
      Table{"joint", "Compass and gyro together (THESIS 11.3)", print_joint},
      Table{"drift", "A drifting gyro (THESIS 11.6, item 7)", print_drift},
      Table{"missions", "Gyro and compass on nominal missions, by the programs' pipeline", print_missions},
      Table{"cost", "Cost of one update", print_cost},
      Table{"magnetometer", "Magnetometer: distortions of figures 4.11 and 4.12 on the eight paths",
            print_magnetometer},
      Table{"magyc", "Magnetometer: the recipe of MAGYC", print_magyc},
      Table{"magnetometer-real", "Magnetometer: recordings of others", print_magnetometer_real},
      Table{"steps", "Magnetometer: a magnet that comes and goes, and a walk past iron", print_steps},
      Table{"gps", "A..E by GPS (THESIS 11.5)", print_gps},
      Table{"delay", "Delay of the compass", print_delay},
  };
  return kTables;
}

}  // namespace navcal::bench
