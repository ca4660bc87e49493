// SPDX-License-Identifier: Apache-2.0
#include "cli/effect_options.h"

#include <fmt/format.h>

#include <cstdio>

namespace navcal::cli {

void add_effect_options(CLI::App* command, std::vector<std::string>& effects, std::filesystem::path& file) {
  command
      ->add_option("--effect", effects,
                   "departure from the nominal model, in typical strengths (default: 1); its direction comes from "
                   "the seed;\nrepeatable. Of a part of a layout: thrust_scale@thruster.2=1. navcal simulate "
                   "--list-effects names all")
      ->option_text("NAME[@OF][=STRENGTH]")
      ->each([](const std::string& text) {
        if (text.find('=') == std::string::npos)
          fmt::print(stderr, "navcal: --effect {0}: strength 1, the typical one; half of it: --effect {0}=0.5\n",
                     text);
      });
  command
      ->add_option(
          "--effects", file,
          "departures with exact parameters: one table [NAME] for each, which may have from_s and until_s")
      ->option_text("FILE.toml");
}

}  // namespace navcal::cli
