// SPDX-License-Identifier: Apache-2.0
#include "cli/place_options.h"

namespace navcal::cli {

void add_place_and_field(CLI::App* command, analysis::PlaceArguments& arguments) {
  command
      ->add_option("--place", arguments.place,
                   "degrees north and east, metres above the ellipsoid; the Earth's field there is the World "
                   "Magnetic Model's")
      ->option_text("LAT,LON[,HEIGHT_M]");
  command->add_option("--field", arguments.field, "the Earth's field in uT: north, east and down of true north")
      ->option_text("N,E,D");
}

}  // namespace navcal::cli
