# SPDX-License-Identifier: Apache-2.0
foreach(target foxglove_client record_line http_query control_admission)
  navcal_fuzz(fuzz_${target} SOURCES ${target}.cpp USES navcal::web nlohmann_json::nlohmann_json)
endforeach()
