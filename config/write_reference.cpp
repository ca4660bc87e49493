// SPDX-License-Identifier: Apache-2.0
// Writes config/navcald.toml, config/vehicle.toml and the tables of docs/configuration.md anew from the option
// tables.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "config/reference.h"
#include "config/vehicle_file.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: navcal-config-reference SOURCE_FOLDER\n";
    return 2;
  }
  const std::filesystem::path source = argv[1];
  const auto page = source / "docs" / "configuration.md";
  std::ostringstream old_page;
  old_page << std::ifstream(page).rdbuf();
  std::ofstream file(source / "config" / "navcald.toml");
  file << navcal::config::shipped_file();
  std::ofstream vehicle(source / "config" / "vehicle.toml");
  vehicle << navcal::config::vehicle_file({});
  std::ofstream new_page(page);
  new_page << navcal::config::with_option_tables(old_page.str());
  if (!file.flush() || !vehicle.flush() || !new_page.flush()) {
    std::cerr << "navcal-config-reference: cannot write below " << source << '\n';
    return 1;
  }
}
