// SPDX-License-Identifier: Apache-2.0
#include "cli/place_options.h"

#include "cli/option_kinds.h"

namespace navcal::cli {

void add_place_and_field(CLI::App* command, analysis::PlaceArguments& arguments) {
  add_valued(command, "--place", "LAT,LON[,HEIGHT_M]", arguments.place,
             "degrees north and east, metres above the ellipsoid; the Earth's field there is the World "
             "Magnetic Model's");
  add_valued(command, "--field", "N,E,D", arguments.field,
             "the Earth's field in uT: north, east and down of true north");
}

}  // namespace navcal::cli
