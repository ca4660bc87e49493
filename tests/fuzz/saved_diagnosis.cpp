// SPDX-License-Identifier: Apache-2.0
// Any bytes as a saved diagnosis, or a good one in which some are changed: refused with a message, or files for
// all simulators whose every line of parameters is a name and a number.
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "report/gap_report.h"
#include "report/simulators/transfer.h"
#include "tests/fuzz/source.h"
#include "tests/fuzz/target.h"
#include "tests/report/gap_samples.h"

namespace navcal::fuzz::saved_diagnosis_target {

using namespace navcal::report;

void use(std::string_view json) {
  CorrectedModel model;
  try {
    model.diagnosis = gap_from_json(json, "saved.json");
  } catch (const BadDiagnosis&) {
    return;
  }
  std::istringstream sitl(simulator_file(Simulator::sitl, model).text);
  for (std::string line; std::getline(sitl, line);) {
    if (line.size() >= 98) std::abort();
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    std::string name, rest;
    double value = 0;
    if (!(words >> name >> value) || words >> rest || name.rfind("SIM_", 0) != 0) std::abort();
  }
  if (!nlohmann::json::accept(simulator_file(Simulator::holoocean, model).text)) std::abort();
  if (!simulator_file(Simulator::stonefish, model).text.ends_with("</scenario>\n")) std::abort();
}

NAVCAL_FUZZ(saved_diagnosis) {
  static const std::string kGood = gap_json(navcal::cli::test::explained_gap());
  use({reinterpret_cast<const char*>(data), size});
  navcal::fuzz::Source source({data, size});
  std::string text = kGood;
  for (int changes = source.take<std::uint8_t>() % 8; changes > 0; --changes)
    text[source.take<std::uint32_t>() % text.size()] = static_cast<char>(source.take<std::uint8_t>());
  use(text);
  return 0;
}

}  // namespace navcal::fuzz::saved_diagnosis_target
